#include "job/origins.hpp"

#include <fmt/format.h>

namespace peterka::job {
namespace {

std::string in_words(const Location& where, const std::vector<std::string>& files) {
    if (where.override_number > 0) return fmt::format("--set {}", where.override_number);
    if (where.file == 0) return fmt::format("line {}", where.line);
    return fmt::format("{}:{}", files.at(where.file), where.line);
}

void collect(const Table& table, const std::string& path, const std::vector<std::string>& files,
             Origins& origins) {
    for (const Entry& entry : table.entries) {
        const std::string name = path.empty() ? entry.name : path + "." + entry.name;
        if (const auto* inner = entry.value.as<Table>()) {
            collect(*inner, name, files, origins);
        } else {
            origins[name] = in_words(entry.value.where, files);
        }
    }
}

}  // namespace

Origins origins_of(const Value& document, const std::vector<std::string>& files) {
    Origins origins;
    if (const auto* table = document.as<Table>()) collect(*table, "", files, origins);
    return origins;
}

}  // namespace peterka::job
