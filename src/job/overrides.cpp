#include "job/overrides.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "job/toml_text.hpp"

namespace peterka::job {
namespace {

constexpr std::size_t deepest_key = 8;  // the job file needs 3; far deeper tables would exhaust the stack

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::invalid_argument not_an_assignment(std::string_view text, std::string_view why) {
    return std::invalid_argument(
        fmt::format("{} {}; an override sets one key of one table; write it like "
                    "--set hammer.mass_kg=0.3",
                    toml_text(text), why));
}

std::vector<std::string_view> split_path(std::string_view path) {
    std::vector<std::string_view> names;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        names.push_back(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return names;
}

void apply(Value& document, std::string_view text, const Location& where) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) throw not_an_assignment(text, "has no '='");
    const std::string_view value = trimmed(text.substr(equals + 1));
    if (value.empty()) throw not_an_assignment(text, "has no value behind '='");

    const auto names = split_path(trimmed(text.substr(0, equals)));
    const bool all_bare =
        std::all_of(names.begin(), names.end(), [](auto name) { return toml_key(name) == name; });
    if (!all_bare || names.size() > deepest_key) throw not_an_assignment(text, "does not name a key");

    Value parsed = parse_value(value, where);
    Value* place = &document;
    for (const std::string_view name : names) {
        if (place->as<Table>() == nullptr) *place = Value{where, Table{}};
        Entry& entry = std::get<Table>(place->content).entry(name, where);
        place = &entry.value;
    }
    *place = std::move(parsed);
}

}  // namespace

void apply_overrides(Value& document, std::span<const std::string> overrides, std::vector<Fault>& faults) {
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        const Location where{i + 1, 1, 1};
        try {
            apply(document, overrides[i], where);
        } catch (const std::invalid_argument& complaint) {
            faults.push_back({where, complaint.what()});
        }
    }
}

}  // namespace peterka::job
