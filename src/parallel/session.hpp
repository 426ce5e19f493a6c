// The lifetime of MPI in this program, and how its ranks end together.
//
// A rank that works alone when it fails cannot wait for the others, and they would wait for it forever. So
// there are two ways to end: all ranks know of the failure (on_root) and leave in an orderly way, or the failed
// rank reports the reason and ends all the others at once (MPI_Abort).
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

#include "support/errors.hpp"

namespace peterka::parallel {

class Session {
  public:
    Session(int& argc, char**& argv);  // MPI_Init_thread; also works without mpirun, as the only rank
    ~Session();                        // MPI_Finalize: waits for all ranks
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] bool is_root() const { return rank_ == 0; }
    [[nodiscard]] MPI_Comm communicator() const { return MPI_COMM_WORLD; }

  private:
    int rank_ = 0;
    int size_ = 1;
};

// Collective. Runs `task` on rank 0 alone; if it throws, all ranks leave together, and rank 0 reports the
// reason.
void on_root(const Session& session, const std::function<void()>& task);

// Runs `task`, in which ranks may do different things; if it throws, this rank reports the reason and ends all
// ranks at once. The failure is handled before anything outside `task` is destroyed, since destructors might
// wait for other ranks.
void failing_ends_all(const Session& session, const std::function<void()>& task);

// The whole program: starts MPI, runs `program` on every rank and returns the exit code. Failures become a
// message on stderr, printed once.
[[nodiscard]] int run_in_session(int argc, char** argv, const std::function<ExitCode(const Session&)>& program);

}  // namespace peterka::parallel
