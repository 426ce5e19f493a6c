// Tiles for one process alone, in the order of a list.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "parallel/dealing.hpp"

namespace peterka::parallel {

class ListedTiles : public TileSource {
  public:
    explicit ListedTiles(std::vector<Tile> tiles) : tiles_(std::move(tiles)) {}

    std::optional<Tile> next() override {
        if (ended()) return std::nullopt;
        return tiles_[next_++];
    }
    [[nodiscard]] bool ended() const override { return next_ == tiles_.size(); }
    void solved(const Tile& /*tile*/) override {}
    bool carry_on() override { return true; }

  private:
    std::vector<Tile> tiles_;
    std::size_t next_ = 0;
};

}  // namespace peterka::parallel
