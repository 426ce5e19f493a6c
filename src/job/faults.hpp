// Faults of a job: where each is, what is wrong, why, and what to do; all end the program together.
//
// A fault in the file reads `file:line:column: what; why; what to do`, one in an override `--set 2: what; ...`.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "support/errors.hpp"

namespace peterka::job {

// A location in the job file or one of its rig files, or the override that gave the value. In reading order.
struct Location {
    std::size_t override_number = 0;  // 0: a file
    std::uint32_t line = 1;           // from 1, of the file
    std::uint32_t column = 1;         // from 1, in characters
    std::uint32_t file = 0;           // 0: the job itself; others by their index in the list of files
    friend bool operator==(const Location&, const Location&) = default;
    friend auto operator<=>(const Location& a, const Location& b) {
        return std::tie(a.override_number, a.file, a.line, a.column) <=>
               std::tie(b.override_number, b.file, b.line, b.column);
    }
};

// A table under a wrong name, by paths of the same depth: [uncertainty.contcat] for [uncertainty.contact].
struct MisspeltTable {
    std::string written;
    std::string meant;
};

struct Fault {
    Location where;
    std::string text;  // what; why; what to do
    std::optional<MisspeltTable> misspelt = {};
};

class JobFaults : public Failure {
  public:
    // `file` as the user named it. The message lists the faults one per line, ordered by location.
    JobFaults(const std::string& file, const std::vector<Fault>& faults);
    // The same for a job made of several files, indexed by Location::file.
    JobFaults(const std::vector<std::string>& files, const std::vector<Fault>& faults);
    // The file as a whole cannot be read as a job.
    JobFaults(const std::string& file, const std::string& text);

    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    std::size_t count_;
};

}  // namespace peterka::job
