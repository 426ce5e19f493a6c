#include "run/run_plan.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <string>
#include <system_error>

#include "job/read.hpp"
#include "job/remarks.hpp"
#include "job/write.hpp"
#include "map_file/map_size.hpp"
#include "parallel/broadcast.hpp"
#include "run/traced_cell.hpp"
#include "support/errors.hpp"
#include "support/tell.hpp"

namespace peterka {

std::filesystem::path map_file_of(const Request& request) {
    if (request.output) return *request.output;
    return request.job_file.stem().concat(".h5");
}

namespace {

// The link's target, so that its folder is the one in which locks and new files are made.
std::filesystem::path behind_links(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) return path;
    std::filesystem::path target = std::filesystem::canonical(path, error);
    if (!error) return target;
    throw Failure(ExitCode::output,
                  fmt::format("{}: is a link that can't be followed: {}. Remove it, or choose "
                              "another name with --output.",
                              path.string(), error.message()));
}

void tell_lacking_locks(const RunPlan& plan) {
    // where no file can be made, making it reports so
    if (plan.existing == map_file::Existing::absent &&
        ::access(map_file::folder_of(plan.file).c_str(), W_OK) != 0)
        return;
    const std::string& lacking =
        plan.lock->lacking().empty() ? plan.file_lock->lacking() : plan.lock->lacking();
    if (!lacking.empty()) tell("peterka: {}\n", lacking);
}

void tell_remarks(const job::Job& job) {
    for (const std::string& remark : job::remarks(job)) tell("peterka: note: {}\n", remark);
}

}  // namespace

RunPlan plan_run(const Request& request) {
    RunPlan plan;
    const TracedCell traced = find_traced_cell(job::read_job_file(request.job_file, request.overrides));
    plan.job = traced.job;
    plan.job_file = request.job_file.string();
    plan.map_cell = traced.map;
    plan.file = behind_links(map_file_of(request));
    plan.lock.emplace(plan.file);
    plan.file_lock.emplace(plan.file);
    if (!request.fresh) plan.existing = map_file::inspect(plan.file, plan.job);
    if (plan.existing != map_file::Existing::complete) {
        tell_lacking_locks(plan);
        if (!request.quiet) tell_remarks(plan.job);
    }
    plan.max_wall_seconds = request.max_wall_seconds;
    plan.fresh = request.fresh;
    plan.quiet = request.quiet;
    return plan;
}

void share(const parallel::Session& session, std::optional<RunPlan>& plan) {
    std::int64_t there_is_one = plan ? 1 : 0;
    parallel::broadcast(session, there_is_one);
    if (there_is_one == 0) return;

    if (!plan) plan.emplace();
    std::string job = session.is_root() ? job::resolved_text(plan->job) : "";
    std::string file = plan->file.string();
    auto existing = static_cast<std::int64_t>(plan->existing);
    parallel::broadcast(session, job);
    parallel::broadcast(session, file);
    parallel::broadcast(session, existing);
    parallel::broadcast(session, plan->max_wall_seconds);
    plan->job = job::read_job_text(job, "the job of rank 0");
    plan->file = file;
    plan->existing = static_cast<map_file::Existing>(existing);
}

}  // namespace peterka
