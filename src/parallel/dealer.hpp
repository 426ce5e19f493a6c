// Rank 0's part in the dealing. Not for use outside it.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "parallel/deal_messages.hpp"
#include "parallel/deal_order.hpp"
#include "parallel/dealing.hpp"
#include "parallel/tile_pool.hpp"

namespace peterka::parallel {

class Dealer : private TileSource {
  public:
    Dealer(const Session& session, const Tiling& tiling, TilePool pool, const DealtWork& work);

    // Returns whether all tiles were solved.
    [[nodiscard]] bool run();

  private:
    struct Remote {
        std::int64_t orders_wanted = 0;
        std::int64_t tiles_owed = 0;  // sent, but not yet solved
        bool has_left = false;
    };

    // Rank 0's own share: one tile at a time. A run would save it nothing, and could keep it busy after all
    // others.
    std::optional<Tile> next() override;
    [[nodiscard]] bool ended() const override { return pool_.remaining() == 0; }
    void solved(const Tile& tile) override;
    bool carry_on() override;

    void serve_until_solved();
    void dismiss_all();

    void serve();
    [[nodiscard]] bool take_report();
    void send_order(int rank, const Order& order);
    void count_solved(std::int64_t tiles, std::int64_t cells);
    [[nodiscard]] bool anyone_computes() const;
    [[nodiscard]] bool all_have_left() const;
    [[nodiscard]] Remote& remote_of(int rank) { return remotes_[static_cast<std::size_t>(rank - 1)]; }

    const Session& session_;
    const Tiling& tiling_;
    TilePool pool_;
    const DealtWork& work_;
    std::vector<Remote> remotes_;  // by rank, beginning with rank 1
    std::deque<int> waiting_;      // ranks that want a run, first come, first served
    std::int64_t tiles_missing_;
    bool stopping_ = false;
    std::int64_t tiles_in_hand_ = 0;
    LookOut look_out_{0.5e-3};  // short, since others may be waiting
};

}  // namespace peterka::parallel
