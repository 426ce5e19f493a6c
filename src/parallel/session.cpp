#include "parallel/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "parallel/checked.hpp"
#include "support/tell.hpp"

namespace peterka::parallel {
namespace {

// A failure that every rank knows of; the message is rank 0's, the others carry only the code.
class AgreedFailure : public Failure {
  public:
    using Failure::Failure;
};

void say(const std::string& message) {
    std::fflush(stdout);
    tell("peterka: {}\n", message);
    std::fflush(stderr);
}

// Where several ranks fail for the same reason, one should say so. Rank 0 speaks at once; the others give the
// ranks before them the time to speak and to end everybody, which takes MPI_Abort some milliseconds.
void wait_for_lower_ranks(int rank) {
    constexpr int most_ranks_waited_for = 100;
    if (rank == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(300 + 20 * std::min(rank, most_ranks_waited_for)));
}

[[noreturn]] void end_all(const Session& session, ExitCode code, const std::string& message) {
    wait_for_lower_ranks(session.rank());
    say(message);
    MPI_Abort(session.communicator(), static_cast<int>(code));
    std::_Exit(static_cast<int>(code));
}

std::string as_internal(const std::exception& error) {
    return fmt::format(
        "internal error: {}. This is a fault of the program; please report it with the job file.",
        error.what());
}

// Runs `task`; gives what it threw to `handle`, with the exit code and message that belong to it.
void catching(const std::function<void()>& task,
              const std::function<void(ExitCode, const std::string&)>& handle) {
    try {
        task();
    } catch (const AgreedFailure&) {
        throw;
    } catch (const Failure& failure) {
        handle(failure.code(), failure.what());
    } catch (const std::bad_alloc&) {
        handle(ExitCode::internal, "out of memory. Use fewer ranks on this machine.");
    } catch (const std::exception& error) {
        handle(ExitCode::internal, as_internal(error));
    }
}

}  // namespace

Session::Session(int& argc, char**& argv) {
    int provided = MPI_THREAD_SINGLE;
    checked("MPI_Init_thread", MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided));
    checked("MPI_Comm_set_errhandler", MPI_Comm_set_errhandler(communicator(), MPI_ERRORS_RETURN));
    checked("MPI_Comm_rank", MPI_Comm_rank(communicator(), &rank_));
    checked("MPI_Comm_size", MPI_Comm_size(communicator(), &size_));
}

Session::~Session() {
    MPI_Finalize();
}

void on_root(const Session& session, const std::function<void()>& task) {
    int code = static_cast<int>(ExitCode::done);
    std::string message;
    if (session.is_root()) {
        catching(task, [&](ExitCode failed_with, const std::string& why) {
            code = static_cast<int>(failed_with);
            message = why;
        });
    }
    checked("MPI_Bcast", MPI_Bcast(&code, 1, MPI_INT, 0, session.communicator()));
    if (code != static_cast<int>(ExitCode::done)) throw AgreedFailure(static_cast<ExitCode>(code), message);
}

void failing_ends_all(const Session& session, const std::function<void()>& task) {
    catching(task, [&](ExitCode code, const std::string& why) { end_all(session, code, why); });
}

int run_in_session(int argc, char** argv, const std::function<ExitCode(const Session&)>& program) {
    const Session session(argc, argv);
    ExitCode code = ExitCode::done;
    try {
        failing_ends_all(session, [&] { code = program(session); });
    } catch (const AgreedFailure& failure) {
        if (session.is_root()) say(failure.what());
        code = failure.code();
    }
    return static_cast<int>(code);
}

}  // namespace peterka::parallel
