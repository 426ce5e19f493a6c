// The part of every rank but 0 in the dealing. Not for use outside it.
#pragma once

#include <cstdint>
#include <deque>

#include "parallel/deal_messages.hpp"
#include "parallel/dealing.hpp"
#include "support/stopwatch.hpp"

namespace peterka::parallel {

class Worker {
  public:
    Worker(const Session& session, const Tiling& tiling, const DealtWork& work);

    // Solves what rank 0 deals until it says that there is no more, or to stop.
    void run();

  private:
    void await_order();
    void solve_run(const TileRange& tiles);
    void want_next_run();
    void report_now_and_then();
    void report();

    void expect_order();
    void take_orders();
    [[nodiscard]] bool carry_on();

    const Session& session_;
    const Tiling& tiling_;
    const DealtWork& work_;

    Order arriving_;                          // where MPI writes the next order
    MPI_Request receive_ = MPI_REQUEST_NULL;  // null once dismissed
    std::deque<TileRange> runs_;
    bool dismissed_ = false;

    Report report_;
    Stopwatch since_start_;
    double next_report_seconds_ = 0;
};

}  // namespace peterka::parallel
