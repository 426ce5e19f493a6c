#include "run/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "map_file/provenance.hpp"
#include "support/errors.hpp"

namespace peterka {
namespace {

constexpr const char* description =
    R"(Maps of a hammer that strikes a stop inside a vibrating cart: which regime it settles
into (no impact, z = p impacts in q forcing cycles, chaos) and how hard it hits, for each
excitation frequency and gap, or for each start.)";

constexpr const char* examples = R"(Examples:
  peterka check jobs/smoke.toml                       what the job means and how large it is
  mpirun -n 4 peterka run jobs/smoke.toml             compute it on 4 ranks, into smoke.h5
  peterka run jobs/smoke.toml --set axes.gap_ratio.points=64 --output small.h5
  postprocess/draw.py smoke.h5                        draw the pictures

The same run command resumes an interrupted file. A run stops early, and keeps what it has,
on --max-wall, SIGUSR1, SIGTERM or Ctrl-C.

Exit codes:
   0  done
   2  the job or the command line is wrong, or the job cannot be read
   3  the output file or the disk does not allow it
   4  finished, but more cells failed than the job allows (limits.failed_cells)
   5  stopped early; the same command goes on
  70  internal error

Next: README.md explains the maps, jobs/*.toml are complete jobs to begin with, and
`peterka check JOB.toml` prints every setting of a job with its unit and default.)";

std::string version_text() {
    const map_file::Provenance made_by = map_file::collect_provenance();
    return fmt::format("peterka {} (commit {})\nHDF5 {}\nMPI {}\nSUNDIALS {}\nEigen {}\nfmt {}\narithmetic {}",
                       made_by.program_version, made_by.git_commit, made_by.hdf5, made_by.mpi, made_by.sundials,
                       made_by.eigen, made_by.fmt, made_by.arithmetic);
}

void add_job_options(CLI::App& command, Request& request) {
    command.add_option("JOB", request.job_file, "job file (TOML)")->required()->type_name("JOB.toml");
    // One value each, so that a job file after it is not taken for another override.
    command.add_option("--set", request.overrides, "replace one value of the job; may be repeated")
        ->type_name("table.key=value")
        ->allow_extra_args(false);
}

void add_run_options(CLI::App& command, Request& request) {
    const auto seconds = [](const std::string& text) {
        double value = 0;
        const bool positive = CLI::detail::lexical_cast(text, value) && value > 0;
        return positive ? std::string() : fmt::format("needs a positive number of seconds, not '{}'", text);
    };
    command
        .add_option("--output", request.output, "map file; default: the job's name with .h5, in this folder")
        ->type_name("FILE.h5")
        ->check(CLI::Validator(
            [](const std::string& text) { return text.empty() ? "needs the name of a file" : std::string(); },
            ""));
    command.add_flag("--fresh", request.fresh, "start over, even if the file holds results of this job");
    command.add_option("--max-wall", request.max_wall_seconds, "stop, resumable, after this time")
        ->type_name("SECONDS")
        ->check(CLI::Validator(seconds, ""));
    command.add_flag("--quiet", request.quiet, "print nothing but errors");
}

}  // namespace

Request read_command_line(int argc, const char* const* argv) {
    Request request;
    CLI::App app(description, "peterka");
    app.footer(examples);
    app.require_subcommand(0, 1);
    app.set_version_flag("--version", version_text, "print program, commit and library versions");

    CLI::App* run = app.add_subcommand("run", "start or resume a job");
    run->callback([&] { request.command = Command::run; });
    add_job_options(*run, request);
    add_run_options(*run, request);

    CLI::App* check =
        app.add_subcommand("check", "print the resolved job and, from a sample of its cells, what it costs");
    check->callback([&] { request.command = Command::check; });
    add_job_options(*check, request);

    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty()) throw CLI::RequiredError("a command, run or check,");
    } catch (const CLI::Success& help_or_version) {
        std::ostringstream text;
        app.exit(help_or_version, text, text);
        request.command = Command::print;
        request.text = text.str();
    } catch (const CLI::ParseError& error) {
        throw Failure(ExitCode::bad_job, fmt::format("{}. See peterka --help.", error.what()));
    }
    return request;
}

}  // namespace peterka
