#include "job/faults.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace peterka::job {
namespace {

std::string line(const std::string& file, const Fault& fault) {
    const Location& where = fault.where;
    if (where.override_number > 0) return fmt::format("--set {}: {}", where.override_number, fault.text);
    return fmt::format("{}:{}:{}: {}", file, where.line, where.column, fault.text);
}

std::string message(const std::string& file, const std::vector<Fault>& unsorted) {
    std::vector<Fault> faults = unsorted;
    std::ranges::stable_sort(faults, {}, &Fault::where);
    std::string text;
    for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + line(file, fault);
    return text;
}

}  // namespace

JobFaults::JobFaults(const std::string& file, const std::vector<Fault>& faults)
    : Failure(ExitCode::bad_job, message(file, faults)), count_(faults.size()) {}

JobFaults::JobFaults(const std::string& file, const std::string& text)
    : Failure(ExitCode::bad_job, file + ": " + text), count_(1) {}

}  // namespace peterka::job
