#include "job/faults.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace peterka::job {
namespace {

std::string line(const std::vector<std::string>& files, const Fault& fault) {
    const Location& where = fault.where;
    if (where.override_number > 0) return fmt::format("--set {}: {}", where.override_number, fault.text);
    return fmt::format("{}:{}:{}: {}", files.at(where.file), where.line, where.column, fault.text);
}

std::string message(const std::vector<std::string>& files, const std::vector<Fault>& unsorted) {
    std::vector<Fault> faults = unsorted;
    std::ranges::stable_sort(faults, {}, &Fault::where);
    std::string text;
    for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + line(files, fault);
    return text;
}

}  // namespace

JobFaults::JobFaults(const std::string& file, const std::vector<Fault>& faults)
    : JobFaults(std::vector{file}, faults) {}

JobFaults::JobFaults(const std::vector<std::string>& files, const std::vector<Fault>& faults)
    : Failure(ExitCode::bad_job, message(files, faults)), count_(faults.size()) {}

JobFaults::JobFaults(const std::string& file, const std::string& text)
    : Failure(ExitCode::bad_job, file + ": " + text), count_(1) {}

}  // namespace peterka::job
