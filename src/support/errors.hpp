// The kinds of failure that end a program, and the exit code of each.
//
// Three kinds of failure are never mixed: faults of a job or of arguments (all listed before anything is
// computed), broken library calls (name of the call and the library's own text), and numerical outcomes, which
// are data of a cell and never an exception.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace peterka {

enum class ExitCode : int {
    done = 0,
    bad_job = 2,            // bad or unreadable job or arguments
    output = 3,             // output file or disk
    too_many_failures = 4,  // finished, but more cells failed than the job allows
    stopped_early = 5,      // stopped by a limit or a signal; the same command resumes
    internal = 70,
};

// A problem that ends the program with a message made for its user: what, where, why, what to do.
class Failure : public std::runtime_error {
  public:
    Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

// Converts an exception of any kind that ends the program into a Failure with a message.
[[nodiscard]] inline Failure as_failure(const std::exception& error) {
    if (const auto* const failure = dynamic_cast<const Failure*>(&error)) return *failure;
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) {
        return {ExitCode::internal,
                "out of memory. Use fewer ranks on this machine, or one that has more; a run that was begun "
                "goes on "
                "by the same command."};
    }
    return {ExitCode::internal, std::string("internal error: ") + error.what() +
                                    ". This is a fault of the program; please report it with the job file."};
}

}  // namespace peterka
