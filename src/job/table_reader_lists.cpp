// Reads lists of words, lists of lists, and numbers that need not be given.
#include <string>
#include <vector>

#include <fmt/format.h>

#include "job/table_reader.hpp"

namespace peterka::job {

void TableReader::words(const Key& key, std::vector<std::string>& values) {
    const Value* given = ask(key);
    if (given == nullptr) return;
    const auto* list = given->as<Array>();
    if (list == nullptr) return wrong_type(key, *given, "a list of texts", key.example);
    values.clear();
    for (const Value& element : list->values) {
        const auto* word = element.as<std::string>();
        if (word == nullptr) return wrong_type(key, element, "text", key.example);
        values.push_back(*word);
    }
}

void TableReader::rows(const Key& key, std::vector<std::vector<double>>& values, const Range<double>& range) {
    const Value* given = ask(key);
    if (given == nullptr) return;
    const auto* list = given->as<Array>();
    if (list == nullptr) return wrong_type(key, *given, "a list of rows", key.example);
    values.clear();
    for (const Value& row : list->values) {
        const auto* numbers = row.as<Array>();
        if (numbers == nullptr) return wrong_type(key, row, "a row, itself a list", key.example);
        std::vector<double>& read = values.emplace_back();
        for (const Value& element : numbers->values) read_number(key, element, read.emplace_back(), range);
    }
}

void TableReader::optional_number(const Key& key, std::optional<double>& value, const Range<double>& range) {
    const Value* given = ask(key);
    if (given == nullptr) return;
    double number = 0;
    read_number(key, *given, number, range);
    value = number;
}

}  // namespace peterka::job
