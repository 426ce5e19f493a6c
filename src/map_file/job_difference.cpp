#include "map_file/job_difference.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "support/escape_untrusted.hpp"

namespace peterka::map_file {

namespace {

// "table.key" -> value, of a text that has each key on a line of its own.
std::map<std::string, std::string> values_of(const std::string& text) {
    std::map<std::string, std::string> values;
    std::istringstream lines(text);
    std::string table;
    for (std::string line; std::getline(lines, line);) {
        const auto equals = line.find(" = ");
        if (equals != std::string::npos) {
            values[table + line.substr(0, equals)] = line.substr(equals + 3);
        } else if (line.starts_with('[') && line.ends_with(']')) {
            table = line.substr(1, line.size() - 2) + ".";
        }
    }
    return values;
}

std::string value_or_absent(const std::map<std::string, std::string>& values, const std::string& key) {
    const auto found = values.find(key);
    return found == values.end() ? "not given" : found->second;
}

}  // namespace

std::string job_difference(const std::string& in_file, const std::string& in_job) {
    const auto file_values = values_of(in_file);
    const auto job_values = values_of(in_job);
    std::set<std::string> keys;
    for (const auto& [key, value] : file_values) keys.insert(key);
    for (const auto& [key, value] : job_values) keys.insert(key);
    constexpr int most_lines = 50;
    int differ = 0;
    std::string lines;
    for (const std::string& key : keys) {
        const std::string in_the_file = value_or_absent(file_values, key);
        const std::string in_the_job = value_or_absent(job_values, key);
        if (in_the_file == in_the_job || ++differ > most_lines) continue;
        lines += fmt::format("\n  {}: {} in the file, {} in the job", escape_untrusted(key),
                             escape_untrusted(in_the_file), escape_untrusted(in_the_job));
    }
    if (differ > most_lines) lines += fmt::format("\n  and {} more keys", differ - most_lines);
    return lines;
}

}  // namespace peterka::map_file
