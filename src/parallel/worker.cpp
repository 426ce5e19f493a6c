#include "parallel/worker.hpp"

#include <algorithm>

#include "parallel/checked.hpp"

namespace peterka::parallel {
namespace {

// Often enough for a live progress bar; together the workers send rank 0 no more than 5000 reports a second.
double report_interval_seconds(const Session& session) {
    return std::max(0.2, session.size() / 5000.0);
}

}  // namespace

Worker::Worker(const Session& session, const Tiling& tiling, const DealtWork& work)
    : session_(session), tiling_(tiling), order_(tiling, session.size()), work_(work) {}

Worker::~Worker() {
    if (receive_ == MPI_REQUEST_NULL) return;
    MPI_Cancel(&receive_);
    MPI_Wait(&receive_, MPI_STATUS_IGNORE);
}

void Worker::run() {
    expect_order();
    want_next_run();
    work_.solve(*this);
    await_dismissal();
    report_.has_left = 1;
    report();
}

// Rank 0 ends the work, also after a request to stop.
void Worker::await_dismissal() {
    while (!dismissed_) {
        carry_on();
        rest();
    }
}

std::optional<Tile> Worker::next() {
    if (dismissed_ || runs_.empty()) return std::nullopt;
    TurnRange& run = runs_.front();
    const Tile tile = tiling_.tile(order_.tile(run.first++).value());
    if (run.size() == 0) runs_.pop_front();
    ++tiles_in_hand_;
    // Early enough that the next run is here when this one is done; no earlier, so that no rank hoards tiles.
    if (runs_.empty()) want_next_run();
    return tile;
}

void Worker::solved(const Tile& tile) {
    --tiles_in_hand_;
    ++report_.tiles_done;
    report_.cells_done += tile.size();
    const bool all_done = tiles_in_hand_ == 0 && runs_.empty();
    if (all_done || since_start_.seconds() >= next_report_seconds_) report();
}

void Worker::want_next_run() {
    ++report_.orders_wanted;
    report();
}

// Keeps taking orders while the report is in transit: rank 0 may be sending one at the same time.
void Worker::report() {
    MPI_Request send = MPI_REQUEST_NULL;
    checked("MPI_Isend",
            MPI_Isend(&report_, words<Report>, MPI_INT64_T, 0, report_tag, session_.communicator(), &send));
    for (int sent = 0; sent == 0;) {
        take_orders();
        checked("MPI_Test", MPI_Test(&send, &sent, MPI_STATUS_IGNORE));
    }
    report_.tiles_done = 0;
    report_.cells_done = 0;
    next_report_seconds_ = since_start_.seconds() + report_interval_seconds(session_);
}

void Worker::expect_order() {
    checked("MPI_Irecv",
            MPI_Irecv(&arriving_, words<Order>, MPI_INT64_T, 0, order_tag, session_.communicator(), &receive_));
}

void Worker::take_orders() {
    while (!dismissed_) {
        int arrived = 0;
        checked("MPI_Test", MPI_Test(&receive_, &arrived, MPI_STATUS_IGNORE));
        if (arrived == 0) return;
        if (arriving_.turns.size() == 0) {
            dismissed_ = true;
        } else {
            runs_.push_back(arriving_.turns);
            expect_order();
        }
    }
}

bool Worker::carry_on() {
    const bool is_idle = tiles_in_hand_ == 0 && runs_.empty();
    if (is_idle || look_out_.is_due()) take_orders();
    if (dismissed_) return false;
    if (!work_.stop_requested()) return true;
    if (report_.wants_stop == 0) {
        report_.wants_stop = 1;
        report();
    }
    return false;
}

}  // namespace peterka::parallel
