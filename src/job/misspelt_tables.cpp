#include "job/misspelt_tables.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "job/nearest.hpp"

namespace peterka::job {
namespace {

bool has_two_letters_swapped(std::string_view word, std::string_view meant) {
    if (word.size() != meant.size()) return false;
    const auto [first, of_meant] = std::ranges::mismatch(word, meant);
    const auto i = static_cast<std::size_t>(first - word.begin());
    return i + 1 < word.size() && word[i] == meant[i + 1] && word[i + 1] == meant[i] &&
           word.substr(i + 2) == meant.substr(i + 2);
}

Table* table_in(Table& table, std::string_view name) {
    const auto entry = std::ranges::find(table.entries, name, &Entry::name);
    return entry == table.entries.end() ? nullptr : std::get_if<Table>(&entry->value.content);
}

void rename(Table& table, std::string_view written, std::string_view meant) {
    const auto entry = std::ranges::find(table.entries, written, &Entry::name);
    Table* there = table_in(table, meant);
    if (there == nullptr) {
        entry->name = meant;
        return;
    }
    const Table more = *table_in(table, written);
    table.entries.erase(entry);
    there = table_in(table, meant);
    for (const Entry& each : more.entries) {
        if (there->find(each.name) == nullptr) there->entries.push_back(each);
    }
}

std::pair<std::string_view, std::string_view> first_and_rest(std::string_view path) {
    const std::size_t dot = path.find('.');
    return {path.substr(0, dot), dot == std::string_view::npos ? "" : path.substr(dot + 1)};
}

// Names of different tables on the way differ at one level or more.
bool rename(Value& document, std::string_view written, std::string_view meant) {
    Table* table = std::get_if<Table>(&document.content);
    while (table != nullptr && !written.empty() && !meant.empty()) {
        const auto [name, inside] = first_and_rest(written);
        const auto [right_name, right_inside] = first_and_rest(meant);
        if (table_in(*table, name) == nullptr) return false;
        if (name != right_name) rename(*table, name, right_name);
        table = table_in(*table, right_name);
        written = inside;
        meant = right_inside;
    }
    return written.empty() && meant.empty();
}

}  // namespace

bool is_misspelt(std::string_view word, std::string_view meant) {
    constexpr std::size_t is_long = 8;
    const std::size_t letters = word.size() < is_long ? 1 : 2;
    return edit_distance(word, meant) <= letters || has_two_letters_swapped(word, meant);
}

std::vector<Fault> rename_misspelt_tables(Value& document, const std::vector<Fault>& faults) {
    std::vector<Fault> renamed;
    for (const Fault& fault : faults) {
        if (fault.misspelt && rename(document, fault.misspelt->written, fault.misspelt->meant))
            renamed.push_back(fault);
    }
    return renamed;
}

}  // namespace peterka::job
