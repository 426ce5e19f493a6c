// A library to be loaded before all others (LD_PRELOAD): one allocation of the program fails, as where memory
// has run out.
//
// * FAULTY_MEMORY_OF: whose allocations are counted: "program" (its own, by operator new or in its own code),
// or a part of the name of the library that asks, as in "libhdf5"
// * FAULTY_MEMORY_AT: the number, from 1, of the one that fails
// * FAULTY_MEMORY_PLACES: a file that at the end gets a line "FIRST LAST" for each place, a stack of calls,
// that allocates: the numbers of its first and of its last allocation
//
// Only a program of the name peterka is meddled with, and not what MPI starts beside it.
#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

extern "C" {
void* __libc_malloc(size_t size);                      // NOLINT: glibc's
void* __libc_calloc(size_t count, size_t size);        // NOLINT
void* __libc_realloc(void* old, size_t size);          // NOLINT
void* __libc_memalign(size_t alignment, size_t size);  // NOLINT
extern char* program_invocation_short_name;            // NOLINT
}

namespace {

constexpr int frames = 24;  // of a stack, by which places are told

struct Place {
    std::uint64_t stack = 0;  // a hash; 0: none
    long first = 0;
    long last = 0;
};

// No constructor of this file may be needed before the first allocation, and none here may allocate.
struct Settings {
    bool active = false;
    bool of_program = false;
    const char* library = "";
    const char* places = nullptr;
    long at = 0;
};
Settings settings;
std::atomic<long> calls = 0;
std::array<Place, 1 << 16> places;  // by hash; only the main thread's run is recorded
thread_local bool is_looking = false;

struct FromLoad {
    FromLoad() {
        const char* const of = std::getenv("FAULTY_MEMORY_OF");
        const char* const at = std::getenv("FAULTY_MEMORY_AT");
        settings.places = std::getenv("FAULTY_MEMORY_PLACES");
        settings.library = of == nullptr ? "" : of;
        settings.of_program = std::string_view(settings.library) == "program";
        settings.at = at == nullptr ? 0 : std::atol(at);
        std::array<void*, frames> room{};
        backtrace(room.data(), frames);  // loads what it needs, which allocates
        settings.active = of != nullptr && std::string_view(program_invocation_short_name) == "peterka";
    }
} const from_load;

bool concerns(void* caller) {
    Dl_info object{};
    if (dladdr(caller, &object) == 0 || object.dli_fname == nullptr) return false;
    const std::string_view path = object.dli_fname;
    const std::string_view name = path.substr(path.rfind('/') + 1);
    if (settings.of_program)
        return name == program_invocation_short_name || name.find("libstdc++") != std::string_view::npos;
    return name.find(settings.library) != std::string_view::npos;
}

void record(long number) {
    std::array<void*, frames> stack{};
    const int depth = backtrace(stack.data(), frames);
    std::uint64_t hash = 1469598103934665603U;  // FNV-1a
    for (int i = 2; i < depth; ++i) hash = (hash ^ reinterpret_cast<std::uintptr_t>(stack[i])) * 1099511628211U;
    for (std::size_t at = hash % places.size();; at = (at + 1) % places.size()) {
        Place& place = places[at];
        if (place.stack == 0) place = {hash, number, number};
        if (place.stack != hash) continue;
        place.last = std::max(place.last, number);
        return;
    }
}

// Whether this allocation is the one that fails.
bool fails(void* caller) {
    if (!settings.active || is_looking) return false;
    is_looking = true;
    bool the_one = false;
    if (concerns(caller)) {
        const long number = ++calls;
        if (settings.places != nullptr) record(number);
        the_one = number == settings.at;
    }
    is_looking = false;
    if (the_one) errno = ENOMEM;
    return the_one;
}

struct ToExit {
    ~ToExit() {
        if (!settings.active || settings.places == nullptr) return;
        settings.active = false;
        std::FILE* const file = std::fopen(settings.places, "w");
        if (file == nullptr) return;
        for (const Place& place : places) {
            if (place.stack != 0) std::fprintf(file, "%ld %ld\n", place.first, place.last);
        }
        std::fclose(file);
    }
} const to_exit;

}  // namespace

extern "C" {

void* malloc(size_t size) {
    return fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
    return fails(__builtin_return_address(0)) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
    return fails(__builtin_return_address(0)) ? nullptr : __libc_realloc(old, size);
}
void* memalign(size_t alignment, size_t size) {
    return fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
    return fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** result, size_t alignment, size_t size) {
    if (fails(__builtin_return_address(0))) return ENOMEM;
    *result = __libc_memalign(alignment, size);
    return *result == nullptr ? ENOMEM : 0;
}
}
