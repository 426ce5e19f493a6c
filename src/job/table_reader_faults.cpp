// A table reader's messages about keys that are unknown, misplaced or of a wrong type.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "job/axis_quantity.hpp"
#include "job/meant.hpp"
#include "job/misspelt_tables.hpp"
#include "job/table_reader.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {

void TableReader::refuse(std::string_view name, std::string_view text) {
    refused_.emplace(name);
    for (const Entry& entry : table_.entries) {
        if (entry.name != name) continue;
        const bool is_table = entry.value.as<Table>() != nullptr;
        fault(name, is_table ? entry.value.where : entry.where,
              fmt::format("{0}{1}{2} {3}", is_table ? "[" : "", full_name(name), is_table ? "]" : "", text));
    }
}

void TableReader::skip(std::initializer_list<std::string_view> names) {
    for (const auto name : names) known_.push_back(name);
}

void TableReader::finish() {
    for (const Entry& entry : table_.entries) {
        const std::string_view name = entry.name;
        if (refused_.contains(name) || std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
        const bool is_table = entry.value.as<Table>() != nullptr;
        const Meant meant = meant_by(name, known_);
        const std::string what =
            is_table ? fmt::format("unknown table [{}]", full_name(name))
                     : fmt::format("unknown key {}{}", toml_key(name),
                                   path_.empty() ? " at the top level" : fmt::format(" in [{}]", path_));
        fault(name, is_table ? entry.value.where : entry.where,
              fmt::format("{}; it would have no effect; {}", what, suggestion(meant, is_table)));
        if (is_table && meant.found() && is_misspelt(name, meant.key))
            faults_.back().misspelt = {full_name(name), full_name(meant.key)};
    }
}

bool TableReader::sound(std::initializer_list<std::string_view> keys) const {
    return std::none_of(keys.begin(), keys.end(), [&](auto key) { return faulty_.contains(key); });
}

std::string TableReader::full_name(std::string_view name) const {
    const bool is_path = name.find('.') != std::string_view::npos && find_quantity(name) != nullptr;
    const std::string key = is_path ? std::string(name) : toml_key(name);
    return path_.empty() ? key : path_ + "." + key;
}

std::string TableReader::place_to_add() const {
    return path_.empty() ? "at the top of the file" : fmt::format("under [{}]", path_);
}

std::string TableReader::suggestion(const Meant& meant, bool is_table) const {
    if (meant.found())
        return is_table ? meant.question(path_.empty() ? "[" : fmt::format("[{}.", path_), "]")
                        : meant.question();
    return fmt::format("{} takes {}", path_.empty() ? "the top level" : fmt::format("[{}]", path_),
                       fmt::join(known_, ", "));
}

void TableReader::fault(std::string_view key, const Location& where, std::string text) {
    faulty_.emplace(key);
    faults_.push_back({where, std::move(text)});
}

void TableReader::fault_of_rule(std::initializer_list<std::string_view> keys, const std::string& text) {
    // The last of the given keys; those from a rig, which other jobs share, come before those of the job
    // itself.
    const auto order = [](const Value* given) { return std::pair(given->where.file == 0, given->where); };
    const Value* last = nullptr;
    for (const auto key : keys) {
        const Value* given = table_.find(key);
        if (given != nullptr && (last == nullptr || order(given) > order(last))) last = given;
        faulty_.emplace(key);
    }
    const Location where = last == nullptr ? where_ : last->where;
    fault(*keys.begin(), where, text);
}

void TableReader::wrong_type(const Key& key, const Value& value, std::string_view wanted,
                             std::string_view example) {
    fault(key.name, value.where,
          fmt::format("{} = {} is {}; it must be {} ({}); write it like {} = {}", full_name(key.name),
                      value.text(), value.type_in_words(), wanted, key.meaning, key.name,
                      key.is_required() ? example_of(key) : example));
}

}  // namespace peterka::job
