// Memory for what comes and goes by the thousand in a few sizes, as the pieces of searches do: kept for the
// next ones.
#pragma once

#include <memory_resource>

namespace peterka {

// For one thread; whatever comes from it must go before the thread ends.
inline std::pmr::memory_resource& pool() {
    static thread_local std::pmr::unsynchronized_pool_resource pool(
        {.max_blocks_per_chunk = 0, .largest_required_pool_block = 16384});
    return pool;
}

}  // namespace peterka
