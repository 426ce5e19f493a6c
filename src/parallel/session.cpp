#include "parallel/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "parallel/checked.hpp"
#include "support/last_words.hpp"
#include "support/print.hpp"
#include "support/stopwatch.hpp"
#include "support/tell.hpp"

namespace peterka::parallel {
namespace {

// A failure known to every rank; rank 0 has the message, the others carry only the code.
class AgreedFailure : public Failure {
  public:
    using Failure::Failure;
};

void say(const std::string& message) {
    std::fflush(stdout);
    tell("peterka: {}\n", message);
    std::fflush(stderr);
}

// Open MPI guards a file pointer shared by all ranks, which no run needs, with a semaphore named after the file
// without its folder: runs into files of the same name wait for each other, and a run killed in between leaves
// all later ones waiting forever. Its next choice, a file beside ours, waits forever on a full disk. The
// remaining components create files only when used. A choice made by the user is kept.
void do_without_shared_file_pointers() {
    ::setenv("OMPI_MCA_sharedfp", "^sm,lockedfile", 0);
}

constexpr int speaking_tag = 3;
constexpr int most_ranks_told = 100;

// Sent without waiting for anyone, and received only by ranks that also fail.
void tell_ranks_after(const Session& session) {
    for (int rank = session.rank() + 1; rank < session.size() && rank <= session.rank() + most_ranks_told;
         ++rank) {
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Isend(nullptr, 0, MPI_BYTE, rank, speaking_tag, session.communicator(), &request);
        if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
    }
}

// Waits to see whether a lower rank reports. Where several ranks fail for the same reason, one should report
// it: rank 0 at once, the others after giving lower ranks time, and MPI some polls to deliver their message.
bool somebody_speaks(const Session& session) {
    constexpr int fewest_looks = 20;
    if (session.is_root()) return false;
    const Stopwatch since_failure;
    const double patience = 0.3 + 0.1 * std::min(session.rank(), 20);
    int arrived = 0;
    for (int looks = 0; looks < fewest_looks || since_failure.seconds() < patience; ++looks) {
        MPI_Iprobe(MPI_ANY_SOURCE, speaking_tag, session.communicator(), &arrived, MPI_STATUS_IGNORE);
        if (arrived != 0) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

[[noreturn]] void end_all(const Session& session, ExitCode code, const std::string& message) {
    if (somebody_speaks(session)) {
        std::this_thread::sleep_for(
            std::chrono::seconds(5));  // that rank ends all ranks, and its message comes first
    } else {
        tell_ranks_after(session);
        say(message);
        // Open MPI 5 forwards output of ranks only until one of them aborts, and drops what it has not read by
        // then.
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    LastWords::are_said();
    MPI_Abort(session.communicator(), static_cast<int>(code));
    std::_Exit(static_cast<int>(code));
}

// Runs `task`; passes what it threw to `handle`, with the corresponding exit code and message.
void catching(const std::function<void()>& task,
              const std::function<void(ExitCode, const std::string&)>& handle) {
    try {
        task();
    } catch (const AgreedFailure&) {
        throw;
    } catch (const std::exception& error) {
        const Failure failure = as_failure(error);
        handle(failure.code(), failure.what());
    }
}

}  // namespace

Session::Session(int& argc, char**& argv) {
    int provided = MPI_THREAD_SINGLE;
    occupy_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a write beyond a file size limit (ulimit -f) fails, and is reported
    std::signal(SIGPIPE, SIG_IGN);  // so does a write to a pipe without a reader
    do_without_shared_file_pointers();
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
    const LastWords last_words;
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
