// Memory for what comes and goes by the thousand in a few sizes, as the pieces of searches do: kept for the
// next ones.
#pragma once

#include <memory_resource>

namespace peterka {

// For one thread; whatever comes from it must go before the thread ends. PETERKA_PLAIN_MEMORY: for sanitizers,
// which then see each piece come and go.
inline std::pmr::memory_resource& pool() {
#ifdef PETERKA_PLAIN_MEMORY
    return *std::pmr::new_delete_resource();
#else
    static thread_local std::pmr::unsynchronized_pool_resource pool(
        {.max_blocks_per_chunk = 0, .largest_required_pool_block = 16384});
    return pool;
#endif
}

}  // namespace peterka
