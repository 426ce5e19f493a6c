#include "run/require_memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <vector>

#include "parallel/collective.hpp"
#include "parallel/hosts.hpp"
#include "run/memory_left.hpp"
#include "run/price.hpp"
#include "support/errors.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

bool takes_little(const job::Job& job) {
    using enum job::Kind;
    return job.kind != map && job.kind != basin && job.kind != sweep && job.kind != curves;
}

// With ranks - 1 others like this one on the machine.
std::optional<Lack> lack_of_memory(const job::Job& job, std::int64_t ranks, const MemoryLeft& left_to_all) {
    if (takes_little(job)) return std::nullopt;
    const std::int64_t needed = memory_per_rank(job) - resident_bytes();
    const MemoryLeft own = memory_left_to_one();
    if (needed > own.bytes) return Lack{needed, 1, own};
    if (needed > left_to_all.bytes / ranks) return Lack{needed, ranks, left_to_all};
    return std::nullopt;
}

const char* words_of(MemoryLimit limit) {
    switch (limit) {
        case MemoryLimit::machine:
            return "this machine";
        case MemoryLimit::control_group:
            return "the control group of this container or batch job";
        case MemoryLimit::process:
            return "a limit of this process (ulimit -v)";
    }
    return "";
}

std::string ways_out(const job::Job& job, std::int64_t ranks) {
    std::string ways = ranks > 1 ? "fewer ranks on a machine, fewer points" : "fewer points";
    if (job.starts.count > 0) ways += ", a smaller starts.count or starts.attractors";
    if (job.uncertainty.rigs > 0) ways += ", a smaller uncertainty.rigs";
    if (job.kind == job::Kind::sweep) ways += ", a smaller sweep.samples";
    return ways;
}

// several: whether there are several machines.
[[noreturn]] void refuse_for_memory(const std::string& where, const job::Job& job, const Lack& lack,
                                    bool several) {
    const std::string host = several ? fmt::format(" on {}", lack.host.data()) : "";
    const std::string together = lack.ranks > 1 ? fmt::format(", {} ranks{} {}", lack.ranks, host,
                                                              readable_bytes(lack.ranks * lack.needed_by_each))
                                                : "";
    throw Failure(
        ExitCode::bad_job,
        fmt::format("{}: a rank needs {} of memory{}, and {} leaves {}; nothing was created. Give {}, or "
                    "compute it where there is more.",
                    where, readable_bytes(lack.needed_by_each), together, words_of(lack.left.by),
                    readable_bytes(lack.left.bytes), ways_out(job, lack.ranks)));
}

}  // namespace

std::optional<Lack> lack_of_memory(const job::Job& job, MPI_Comm communicator, const MemoryLeft& left_to_all) {
    std::vector<Lack> mine;
    if (auto lack = lack_of_memory(job, parallel::ranks_of_host(communicator), left_to_all)) {
        gethostname(lack->host.data(), lack->host.size() - 1);
        mine.push_back(*lack);
    }
    const std::vector<Lack> all = parallel::gather<Lack>(mine, communicator);
    return all.empty() ? std::nullopt : std::optional(all.front());
}

void require_memory(const std::string& where, const job::Job& job) {
    if (const auto lack = lack_of_memory(job, 1, memory_left_to_all()))
        refuse_for_memory(where, job, *lack, false);
}

void require_memory(const parallel::Session& session, const RunPlan& plan) {
    if (plan.existing == map_file::Existing::complete) return;
    const auto lack = lack_of_memory(plan.job, session.communicator(), memory_left_to_all());
    if (!lack) return;
    parallel::on_root(session,
                      [&] { refuse_for_memory(plan.job_file, plan.job, *lack, lack->ranks < session.size()); });
}

}  // namespace peterka
