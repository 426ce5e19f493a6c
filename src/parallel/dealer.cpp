#include "parallel/dealer.hpp"

#include <algorithm>
#include <utility>

#include "parallel/checked.hpp"
#include "support/expect.hpp"

namespace peterka::parallel {

Dealer::Dealer(const Session& session, const Tiling& tiling, TilePool pool, const DealtWork& work)
    : session_(session),
      tiling_(tiling),
      pool_(std::move(pool)),
      work_(work),
      remotes_(static_cast<std::size_t>(session.size() - 1)),
      tiles_missing_(pool_.remaining()) {}

bool Dealer::run() {
    work_.solve(*this);
    serve_until_solved();
    dismiss_all();
    return tiles_missing_ == 0;
}

std::optional<Tile> Dealer::next() {
    const TurnRange mine = pool_.take(1);
    if (mine.size() == 0) return std::nullopt;
    ++tiles_in_hand_;
    return tiling_.tile(pool_.order().tile(mine.first).value());
}

void Dealer::solved(const Tile& tile) {
    PETERKA_EXPECT(tiles_in_hand_ > 0);
    --tiles_in_hand_;
    count_solved(1, tile.size());
}

bool Dealer::carry_on() {
    if (tiles_in_hand_ == 0 || look_out_.is_due()) serve();
    stopping_ = stopping_ || work_.stop_requested();
    return !stopping_;
}

void Dealer::serve_until_solved() {
    while (!stopping_ && anyone_computes()) {
        serve();
        rest();
    }
}

void Dealer::dismiss_all() {
    for (int rank = 1; rank < session_.size(); ++rank) send_order(rank, Order{});
    while (!all_have_left()) {
        if (!take_report()) rest();
    }
}

// Takes all reports that have arrived, then sends every requested run.
void Dealer::serve() {
    while (take_report()) {
    }
    stopping_ = stopping_ || work_.stop_requested();
    while (!waiting_.empty() && pool_.remaining() > 0 && !stopping_) {
        const TurnRange run = pool_.take(deal_size(pool_.remaining(), pool_.all(), session_.size()));
        send_order(waiting_.front(), {run});
        remote_of(waiting_.front()).tiles_owed += run.size();
        waiting_.pop_front();
    }
}

bool Dealer::take_report() {
    if (session_.size() == 1) return false;  // besides, polling would yield the core to other processes
    int arrived = 0;
    MPI_Status status{};
    MPI_Comm communicator = session_.communicator();
    checked("MPI_Iprobe", MPI_Iprobe(MPI_ANY_SOURCE, report_tag, communicator, &arrived, &status));
    if (arrived == 0) return false;

    Report report;
    checked("MPI_Recv", MPI_Recv(&report, words<Report>, MPI_INT64_T, status.MPI_SOURCE, report_tag,
                                 communicator, MPI_STATUS_IGNORE));
    Remote& remote = remote_of(status.MPI_SOURCE);
    PETERKA_EXPECT(!remote.has_left);
    PETERKA_EXPECT(0 <= report.tiles_done && report.tiles_done <= remote.tiles_owed);
    PETERKA_EXPECT(report.cells_done >= report.tiles_done && report.orders_wanted >= remote.orders_wanted);
    for (; remote.orders_wanted < report.orders_wanted; ++remote.orders_wanted) {
        waiting_.push_back(status.MPI_SOURCE);
    }
    remote.tiles_owed -= report.tiles_done;
    remote.has_left = report.has_left != 0;
    stopping_ = stopping_ || report.wants_stop != 0;
    count_solved(report.tiles_done, report.cells_done);
    return true;
}

void Dealer::send_order(int rank, const Order& order) {
    checked("MPI_Send", MPI_Send(&order, words<Order>, MPI_INT64_T, rank, order_tag, session_.communicator()));
}

void Dealer::count_solved(std::int64_t tiles, std::int64_t cells) {
    PETERKA_EXPECT(tiles <= tiles_missing_);
    tiles_missing_ -= tiles;
    if (cells > 0) work_.on_progress(cells);
}

bool Dealer::anyone_computes() const {
    return std::ranges::any_of(remotes_, [](const Remote& remote) { return remote.tiles_owed > 0; });
}

bool Dealer::all_have_left() const {
    return std::ranges::all_of(remotes_, [](const Remote& remote) { return remote.has_left; });
}

}  // namespace peterka::parallel
