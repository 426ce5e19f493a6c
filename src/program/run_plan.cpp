#include "program/run_plan.hpp"

#include <string>

#include "job/read.hpp"
#include "job/write.hpp"
#include "parallel/broadcast.hpp"
#include "program/traced_cell.hpp"

namespace peterka {

std::filesystem::path map_file_of(const Request& request) {
    if (request.output) return *request.output;
    return request.job_file.stem().concat(".h5");
}

RunPlan plan_run(const Request& request) {
    RunPlan plan;
    const TracedCell traced = find_traced_cell(job::read_job_file(request.job_file, request.overrides));
    plan.job = traced.job;
    plan.map_cell = traced.map;
    plan.file = map_file_of(request);
    plan.lock.emplace(plan.file);
    if (!request.fresh) plan.existing = output::inspect(plan.file, plan.job);
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
    plan->existing = static_cast<output::Existing>(existing);
}

}  // namespace peterka
