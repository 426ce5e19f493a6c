// The part of all ranks other than 0 in the dealing. Not for use outside it.
#pragma once

#include <cstdint>
#include <deque>

#include "parallel/deal_messages.hpp"
#include "parallel/deal_order.hpp"
#include "parallel/dealing.hpp"
#include "support/stopwatch.hpp"

namespace peterka::parallel {

class Worker : private TileSource {
  public:
    Worker(const Session& session, const Tiling& tiling, const DealtWork& work);
    // After a failure an order may still arrive; its receive is cancelled before the buffer goes.
    ~Worker() override;
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    Worker(Worker&&) = delete;
    Worker& operator=(Worker&&) = delete;

    // Solves the tiles that rank 0 deals until it says that there are no more, or to stop.
    void run();

  private:
    std::optional<Tile> next() override;
    [[nodiscard]] bool ended() const override { return dismissed_; }
    void solved(const Tile& tile) override;
    bool carry_on() override;

    void await_dismissal();
    void want_next_run();
    void report();

    void expect_order();
    void take_orders();

    const Session& session_;
    const Tiling& tiling_;
    DealOrder order_;
    const DealtWork& work_;

    Order arriving_;                          // receive buffer of the next order
    MPI_Request receive_ = MPI_REQUEST_NULL;  // null once dismissed
    std::deque<TurnRange> runs_;              // the remaining runs
    std::int64_t tiles_in_hand_ = 0;
    bool dismissed_ = false;
    LookOut look_out_{2e-3};

    Report report_;
    Stopwatch since_start_;
    double next_report_seconds_ = 0;
};

}  // namespace peterka::parallel
