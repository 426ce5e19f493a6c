// Operations of all ranks of a communicator on one file.
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "parallel/tile_set.hpp"

namespace peterka::parallel {

[[nodiscard]] int rank_in(MPI_Comm communicator);

// A contiguous range of tiles, this rank's share of a pass over the file; the shares of all ranks cover each
// tile once.
struct Share {
    std::int64_t first = 0;
    std::int64_t end = 0;
};
[[nodiscard]] Share share_of(std::int64_t tiles, MPI_Comm communicator);

// Collective. Runs `task` on every rank; if it throws on any (Stopped included), all ranks throw the failure of
// the lowest such rank, so that none waits forever. A task that is itself collective must fail on all ranks or
// before its first exchange.
void together(MPI_Comm communicator, const std::function<void()>& task);

// Collective. The same with a task for rank 0 alone; the others wait until it ends.
void on_first_rank(MPI_Comm communicator, const std::function<void()>& task);

// Collective. Every rank gets the union of all ranks' sets, which have equal numbers of tiles.
void unite(parallel::TileSet& tiles, MPI_Comm communicator);

[[nodiscard]] std::vector<std::byte> gather_bytes(std::span<const std::byte> mine, MPI_Comm communicator);

// Collective. The items of all ranks, on all ranks, in rank order.
template <class Item>
[[nodiscard]] std::vector<Item> gather(std::span<const Item> mine, MPI_Comm communicator) {
    static_assert(std::is_trivially_copyable_v<Item>);
    const std::vector<std::byte> bytes = gather_bytes(std::as_bytes(mine), communicator);
    std::vector<Item> all(bytes.size() / sizeof(Item));
    std::ranges::copy(bytes, std::as_writable_bytes(std::span(all)).begin());
    return all;
}

}  // namespace peterka::parallel
