#include "job/table_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "job/choose.hpp"
#include "job/toml_text.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

// For "table.key", the value of that key in that table.
const Value* find_inside(const Table& table, std::string_view name) {
    const std::size_t dot = name.find('.');
    const Value* value = table.find(name.substr(0, dot));
    if (dot == std::string_view::npos || value == nullptr) return value;
    const auto* inner = value->as<Table>();
    return inner == nullptr ? nullptr : find_inside(*inner, name.substr(dot + 1));
}

void add_names(const Table& table, std::vector<std::string_view>& names) {
    for (const Entry& entry : table.entries) {
        names.emplace_back(entry.name);
        if (const auto* inner = entry.value.as<Table>()) add_names(*inner, names);
    }
}

// Whether a document gives coordinates in SI units: a frequency or gap, or, without either, a start.
bool gives_si(const Table& document) {
    std::vector<std::string_view> names;
    add_names(document, names);
    const auto is_of_place = [](std::string_view name) { return is_frequency(name) || is_gap(name); };
    const bool has_place = std::ranges::any_of(names, is_of_place);
    return std::ranges::any_of(
        names, [&](std::string_view name) { return is_in_si(name) && (!has_place || is_of_place(name)); });
}

}  // namespace

TableReader::TableReader(const Value& value, std::string path, std::vector<Fault>& faults)
    : table_(*value.as<Table>()),
      where_(value.where),
      path_(std::move(path)),
      leads_in_si_(gives_si(table_)),
      faults_(faults) {}

void TableReader::number(const Key& key, double& value, const Range<double>& range) {
    if (const Value* given = ask(key)) read_number(key, *given, value, range);
}

void TableReader::read_number(const Key& key, const Value& value, double& number, const Range<double>& range) {
    const std::string standard = toml_text(number);
    if (const auto* given = value.as<double>()) {
        number = *given;
    } else if (const auto* integer = value.as<std::int64_t>()) {
        number = static_cast<double>(*integer);
    } else {
        return wrong_type(key, value, "a number", standard);
    }
    check_range(key, value, number, range);
}

void TableReader::integer(const Key& key, std::int64_t& value, const Range<std::int64_t>& range) {
    if (const Value* given = ask(key)) read_integer(key, *given, value, range);
}

void TableReader::read_integer(const Key& key, const Value& value, std::int64_t& number,
                               const Range<std::int64_t>& range) {
    const auto* integer = value.as<std::int64_t>();
    if (integer == nullptr) return wrong_type(key, value, "an integer", toml_text(number));
    number = *integer;
    check_range(key, value, number, range);
}

void TableReader::count_or_all(const Key& key, std::int64_t& value, const Range<std::int64_t>& range) {
    const Value* given = ask(key);
    if (given == nullptr) return;
    const auto* text = given->as<std::string>();
    const auto* word = given->as<BareWord>();
    if ((text != nullptr && *text == "all") || (word != nullptr && word->text == "all")) {
        value = every_cell;
    } else if (given->as<std::int64_t>() == nullptr) {
        wrong_type(key, *given, "an integer or \"all\"", "\"all\"");
    } else {
        read_integer(key, *given, value, range);
    }
}

template <typename Number, typename ReadElement>
void TableReader::read_list(const Key& key, std::vector<Number>& values, ReadElement read_element) {
    constexpr std::size_t most = 100;
    const Value* given = ask(key);
    if (given == nullptr) return;
    const Number standard = values.empty() ? Number{} : values.front();
    const auto* list = given->as<Array>();
    if (list == nullptr) return wrong_type(key, *given, "a list", fmt::format("[{}]", toml_text(standard)));
    const std::size_t size = list->values.size();
    if (size == 0 || size > most) {
        return fault(
            key.name, given->where,
            fmt::format("{} has {} values; it takes from 1 to {} of them ({}); {}", full_name(key.name), size,
                        most, key.meaning, size == 0 ? "add one" : "remove some"));
    }
    std::vector<Number> read;
    for (const Value& element : list->values) {
        Number number = standard;
        read_element(element, number);
        read.push_back(number);
    }
    values = read;
}

void TableReader::numbers(const Key& key, std::vector<double>& values, const Range<double>& range) {
    read_list(key, values,
              [&](const Value& element, double& number) { read_number(key, element, number, range); });
}

void TableReader::integers(const Key& key, std::vector<std::int64_t>& values,
                           const Range<std::int64_t>& range) {
    read_list(key, values,
              [&](const Value& element, std::int64_t& number) { read_integer(key, element, number, range); });
}

void TableReader::text(const Key& key, std::string& value) {
    const Value* given = ask(key);
    if (given == nullptr) return;
    if (const auto* text = given->as<std::string>()) {
        value = *text;
    } else if (const auto* word = given->as<BareWord>()) {
        value = word->text;
    } else {
        wrong_type(key, *given, "text", R"("...")");
    }
}

void TableReader::flag(const Key& key, bool& value) {
    const Value* given = ask(key);
    if (given == nullptr) return;
    if (const auto* flag = given->as<bool>()) {
        value = *flag;
    } else {
        wrong_type(key, *given, "true or false", "true");
    }
}

void TableReader::either(const Alternative& first, const Alternative& second, std::string_view why) {
    if (is_left_to_an_axis(first.key.name) || is_left_to_an_axis(second.key.name)) {
        return skip({first.key.name, second.key.name});
    }
    read_alternative(first);
    read_alternative(second);
    require_one_of(first.key, second.key, why);
}

void TableReader::either_list(const ListAlternative& first, const ListAlternative& second,
                              std::string_view why) {
    const bool is_second = table_.find(second.key.name) != nullptr;
    const auto read = [&](const ListAlternative& list) {
        const bool is_given = table_.find(list.key.name) != nullptr;  // neither of the two is missing by itself
        numbers(is_given ? list.key : Key{list.key.name, list.key.meaning}, list.values, list.range);
    };
    read(first);
    read(second);
    if (is_second) first.values.clear();
    require_one_of(first.key, second.key, why);
}

void TableReader::require_one_of(const Key& first, const Key& second, std::string_view why) {
    const Value* one = table_.find(first.name);
    const Value* other = table_.find(second.name);
    if (one != nullptr && other != nullptr) {
        fault(second.name, std::max(one->where, other->where),
              fmt::format("{} and {} are both given; {}; remove one of them", full_name(first.name),
                          second.name, why));
    }
    if (one == nullptr && other == nullptr && first.is_required()) {
        const auto& [shown, other_one] = leads_in_si_ ? std::pair(second, first) : std::pair(first, second);
        fault(
            first.name, where_,
            fmt::format("{} or {} is missing; {}; add one of them, such as {} = {}, {}", full_name(shown.name),
                        other_one.name, why, shown.name, shown.example, place_to_add()));
    }
}

void TableReader::read_alternative(const Alternative& alternative) {
    known_.push_back(alternative.key.name);
    const Value* given = table_.find(alternative.key.name);
    if (given == nullptr) return;
    double number = 0;
    read_number(alternative.key, *given, number, alternative.range);
    alternative.value = number;
}

std::optional<std::size_t> TableReader::choose(const Key& key, const Words& names, std::string_view standard) {
    const Value* given = ask(key);
    if (given == nullptr) return std::nullopt;
    const auto word = word_of(*given);
    if (!word) {
        wrong_type(key, *given, "text", toml_text(standard));
        return std::nullopt;
    }
    const auto index = index_of(*word, names);
    if (!index) {
        const std::string what = fmt::format("{} = {}", full_name(key.name), toml_text(*word));
        fault(key.name, given->where, complain_about_choice(what, *word, names));
    }
    return index;
}

std::vector<std::size_t> TableReader::choose_several(const Key& key, const Words& names) {
    std::set<std::size_t> chosen;
    const Value* given = ask(key);
    if (given == nullptr) return {};
    const auto* list = given->as<Array>();
    if (list == nullptr) {
        wrong_type(key, *given, "a list", fmt::format("[{}]", toml_text(names.front())));
        return {};
    }
    for (const Value& element : list->values) {
        const auto* word = element.as<std::string>();
        const auto index = word != nullptr ? index_of(*word, names) : std::nullopt;
        const std::string what = fmt::format("{} in {}", element.text(), full_name(key.name));
        if (word == nullptr) {
            fault(key.name, element.where,
                  fmt::format("{} is {}; the list takes text; choose from {}", what, element.type_in_words(),
                              quoted_list(names)));
        } else if (!index) {
            fault(key.name, element.where, complain_about_choice(what, *word, names));
        } else if (!chosen.insert(*index).second) {
            fault(key.name, element.where,
                  fmt::format("{} stands there twice; a field is stored once; remove one", what));
        }
    }
    return {chosen.begin(), chosen.end()};
}

const Value* TableReader::ask(const Key& key) {
    known_.push_back(key.name);
    if (is_left_to_an_axis(key.name)) return nullptr;
    const Value* given = table_.find(key.name);
    if (given == nullptr && key.is_required()) {
        fault(key.name, where_,
              fmt::format("{} is missing; it has no default ({}); add {} = {} {}", full_name(key.name),
                          key.meaning, key.name, example_of(key), place_to_add()));
    }
    return given;
}

std::optional<TableReader> TableReader::open(const Key& key) {
    known_.push_back(key.name);
    const std::string name = full_name(key.name);
    const Value* given = find_inside(table_, key.name);
    if (given == nullptr && has_key_left_to_an_axis(name)) {
        static const Value nothing_else{{}, Table{}};
        given = &nothing_else;
    }
    if (given == nullptr) {
        if (key.is_required()) {
            fault(key.name, where_,
                  fmt::format(
                      "the table [{}] is missing; it has no default ({}); add it with its keys, such as {}",
                      name, key.meaning, example_of(key)));
        }
        return std::nullopt;
    }
    if (given->as<Table>() == nullptr) {
        fault(
            key.name, given->where,
            fmt::format("{} is {}; it must be a table ({}); write [{}] on a line of its own and its keys below",
                        name, given->type_in_words(), key.meaning, name));
        return std::nullopt;
    }
    TableReader inner(*given, name, faults_);
    inner.left_to_axes_ = left_to_axes_;
    inner.leads_in_si_ = leads_in_si_;
    return inner;
}

bool TableReader::has_key_left_to_an_axis(const std::string& table) const {
    return std::ranges::any_of(left_to_axes_,
                               [&](const std::string& key) { return key.starts_with(table + "."); });
}

bool TableReader::is_left_to_an_axis(std::string_view key) const {
    return std::ranges::find(left_to_axes_, full_name(key)) != left_to_axes_.end();
}

template <typename Number>
void TableReader::check_range(const Key& key, const Value& value, Number number, const Range<Number>& range) {
    if (range.contains(number)) return;
    const bool finite = std::isfinite(static_cast<double>(number));
    fault(key.name, value.where,
          fmt::format("{} = {} is {}; {}; give {}", full_name(key.name), value.text(),
                      finite ? "out of range" : "not a finite number", range.reason, range.text()));
}

}  // namespace peterka::job
