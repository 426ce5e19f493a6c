// peterka: maps of a hammer that strikes a stop inside a vibrating cart. See README.md.
#include <optional>

#include "hdf5/checked.hpp"
#include "parallel/session.hpp"
#include "run/command_line.hpp"
#include "run/commands.hpp"
#include "run/require_memory.hpp"
#include "run/run_plan.hpp"
#include "support/print.hpp"

int main(int argc, char** argv) {
    using namespace peterka;
    hdf5::leave_open_files_alone();
    return parallel::run_in_session(argc, argv, [&](const parallel::Session& session) {
        std::optional<RunPlan> plan;
        parallel::on_root(session, [&] {
            const Request request = read_command_line(argc, argv);
            if (request.command == Command::print) print(request.text);
            if (request.command == Command::check) print(check_job(request));
            if (request.command == Command::run) plan = plan_run(request);
        });
        share(session, plan);
        if (!plan) return ExitCode::done;
        require_memory(session, *plan);
        if (plan->job.kind == job::Kind::study) return run_study(session, *plan);
        if (plan->job.kind == job::Kind::trace) return run_trace(session, *plan);
        if (plan->job.kind == job::Kind::curves) return run_curves(session, *plan);
        return run_job(session, *plan);
    });
}
