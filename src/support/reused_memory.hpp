// Memory reuse: a freed block waits in a free list of its size class for the next request. For objects created
// and destroyed by the thousand a second, in recurring sizes. Each thread has its own lists.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <utility>

namespace peterka {

class ReusedMemory {
  public:
    [[nodiscard]] static void* take(std::size_t bytes) {
        const std::size_t size = size_class(bytes);
        if (size >= classes) return ::operator new(bytes);
        Waiting*& first = waiting().first[size];
        if (first == nullptr) return ::operator new((size + 1) * unit);
        return std::exchange(first, first->next);
    }
    // bytes: as many as were requested.
    static void give_back(void* block, std::size_t bytes) noexcept {
        const std::size_t size = size_class(bytes);
        if (size >= classes) return ::operator delete(block);
        Waiting*& first = waiting().first[size];
        first = new (block) Waiting{first};
    }

  private:
    static constexpr std::size_t unit = 64;
#ifdef __SANITIZE_ADDRESS__
    static constexpr std::size_t classes = 0;  // else it would miss uses of freed blocks
#else
    static constexpr std::size_t classes = 128;  // larger blocks are few
#endif
    static constexpr std::size_t size_class(std::size_t bytes) {
        return (bytes + unit - 1) / unit - 1;
    }

    struct Waiting {
        Waiting* next;
    };
    struct AllWaiting {
        AllWaiting() = default;
        AllWaiting(const AllWaiting&) = delete;
        AllWaiting& operator=(const AllWaiting&) = delete;
#ifndef __wasm__  // the engine in a page has one thread, which never ends
        ~AllWaiting() {
            for (Waiting* next : first) {
                while (next != nullptr) ::operator delete(std::exchange(next, next->next));
            }
        }
#endif
        std::array<Waiting*, classes + 1> first{};
    };
    static AllWaiting& waiting() {
        static thread_local AllWaiting of_this_thread;
        return of_this_thread;
    }
};

// For a class whose objects come and go: class Thing : public Reused {...}, or a coroutine's promise.
struct Reused {
    // NOLINTNEXTLINE(misc-new-delete-overloads): the sized operator delete below is its match.
    [[nodiscard]] static void* operator new(std::size_t bytes) { return ReusedMemory::take(bytes); }
    static void operator delete(void* block, std::size_t bytes) noexcept {
        ReusedMemory::give_back(block, bytes);
    }
};

// For a container in such an object.
template <class T>
struct ReusingAllocator {
    using value_type = T;
    ReusingAllocator() = default;
    template <class Other>
    explicit ReusingAllocator(const ReusingAllocator<Other>& /*other*/) {}
    [[nodiscard]] T* allocate(std::size_t count) {
        return static_cast<T*>(ReusedMemory::take(count * sizeof(T)));
    }
    void deallocate(T* block, std::size_t count) noexcept { ReusedMemory::give_back(block, count * sizeof(T)); }
    friend bool operator==(const ReusingAllocator&, const ReusingAllocator&) = default;
};

}  // namespace peterka
