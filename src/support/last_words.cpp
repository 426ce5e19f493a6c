#include "support/last_words.hpp"

#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "support/errors.hpp"

namespace peterka {
namespace {

bool exit_is_own = true;

// Nothing here may allocate memory.
[[noreturn]] void end(std::string_view words) {
    static_cast<void>(!::write(STDERR_FILENO, words.data(), words.size()));
    std::_Exit(static_cast<int>(ExitCode::internal));
}

[[noreturn]] void end_uncaught() {
    try {
        if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::bad_alloc&) {
        end("peterka: out of memory. Run the same command again where there is more; it goes on from what is "
            "finished.\n");
    } catch (...) {
        end("peterka: internal error: an exception that nobody catches. This is a fault of the program; please "
            "report it with the job file.\n");
    }
    end("peterka: internal error: std::terminate. This is a fault of the program; please report it with the "
        "job "
        "file.\n");
}

void end_by_library() {
    if (exit_is_own) return;
    end("peterka: a library ended the program, as HDF5 does where memory runs out. Run the same command again "
        "where there is more; it goes on from what is finished.\n");
}

// Runs before the first constructor of a library's header that allocates.
[[gnu::constructor(101)]] void begin() {
    std::set_terminate(end_uncaught);
}

}  // namespace

LastWords::LastWords() {
    exit_is_own = std::atexit(end_by_library) != 0;
}

void LastWords::are_said() {
    exit_is_own = true;
}

}  // namespace peterka
