// The messages between rank 0 and the other ranks while tiles are dealt. Not for use outside the dealing.
//
// A worker reports when it wants a run, when it has nothing left to do, and from time to time in between. Rank
// 0 answers a request with an order the next time it checks and has a run, and ends with one order without
// tiles; the worker's last report says that it has left. A worker always has a receive posted for the next
// order, so a send by rank 0 never waits for a worker's computation.
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <thread>
#include <type_traits>

#include "parallel/deal_order.hpp"
#include "support/stopwatch.hpp"

namespace peterka::parallel {

inline constexpr int report_tag = 1;
inline constexpr int order_tag = 2;

struct Report {
    std::int64_t orders_wanted = 0;  // since the start; rank 0 owes one order for each
    std::int64_t tiles_done = 0;     // since the last report
    std::int64_t cells_done = 0;     // since the last report
    std::int64_t wants_stop = 0;     // 1: this rank was asked to stop
    std::int64_t has_left = 0;       // 1: the last report
};

struct Order {
    TurnRange turns;  // none: leave
};

// Both travel as plain 64-bit integers.
template <class Message>
inline constexpr int words = [] {
    static_assert(std::is_trivially_copyable_v<Message> && sizeof(Message) % sizeof(std::int64_t) == 0);
    return static_cast<int>(sizeof(Message) / sizeof(std::int64_t));
}();

// A rank that waits in MPI_Recv keeps its core busy. One that polls and sleeps leaves the core to a computing
// rank; 200 us are short compared with a tile.
inline void rest() {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
}

// When a computing rank polls for messages. Not at every opportunity: where ranks outnumber cores, MPI yields
// the core at each poll, and the rank finds its caches cold afterwards.
class LookOut {
  public:
    explicit LookOut(double interval_seconds) : interval_seconds_(interval_seconds) {}
    [[nodiscard]] bool is_due() {
        if (since_.seconds() < interval_seconds_) return false;
        since_ = {};
        return true;
    }

  private:
    double interval_seconds_;
    Stopwatch since_;
};

}  // namespace peterka::parallel
