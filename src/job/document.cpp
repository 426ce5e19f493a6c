#include "job/document.hpp"

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "job/toml_text.hpp"
#include "support/whole_letters.hpp"

namespace peterka::job {
namespace {

// Gives every value its location in the file, or that of the override that all of them come from.
class Converter {
  public:
    explicit Converter(std::uint32_t file) : file_(file) {}
    explicit Converter(const Location& fixed) : fixed_(fixed) {}

    Value convert(const toml::node& node) const { return {place(node.source()), content(node)}; }

  private:
    Location place(const toml::source_region& source) const {
        if (fixed_) return *fixed_;
        // The root table of a file has no location of its own.
        return {0, std::max(source.begin.line, 1U), std::max(source.begin.column, 1U), file_};
    }

    decltype(Value::content) content(const toml::node& node) const {
        if (const auto* table = node.as_table()) return convert_table(*table);
        if (const auto* array = node.as_array()) return convert_array(*array);
        if (const auto* text = node.as_string()) return text->get();
        if (const auto* integer = node.as_integer()) return integer->get();
        if (const auto* number = node.as_floating_point()) return number->get();
        if (const auto* boolean = node.as_boolean()) return boolean->get();
        std::ostringstream date;
        date << toml::node_view(node);
        return DateOrTime{date.str()};
    }

    Table convert_table(const toml::table& table) const {
        Table converted;
        for (const auto& [key, value] : table) {
            converted.entries.push_back({std::string(key.str()), place(key.source()), convert(value)});
        }
        return converted;
    }

    Array convert_array(const toml::array& array) const {
        Array converted;
        for (const auto& value : array) converted.values.push_back(convert(value));
        return converted;
    }

    std::uint32_t file_ = 0;
    std::optional<Location> fixed_;
};

std::string complaint(const toml::parse_error& error) {
    std::string description(error.description());
    constexpr std::string_view preamble = "Error while parsing ";
    if (description.starts_with(preamble)) description.erase(0, preamble.size());
    if (!description.empty()) {
        description[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(description[0])));
    }
    const bool is_twice = description.find("cannot redefine") != std::string::npos;
    return fmt::format("TOML syntax, {}; nothing behind this place can be read; {}, then check the job again",
                       description, is_twice ? "give each key and each table only once" : "mend this line");
}

std::optional<Value> as_toml(const std::string& right_hand_side, const Location& where) {
    try {
        const toml::table table = toml::parse("value = " + right_hand_side + "\n");
        if (table.size() != 1) return std::nullopt;  // a line break has introduced a second key
        return Converter(where).convert(*table.get("value"));
    } catch (const toml::parse_error&) {
        return std::nullopt;
    }
}

std::string shortened(std::string text) {
    constexpr std::size_t longest = 60;
    if (text.size() <= longest) return text;
    return text.substr(0, whole_letters(text, longest)) + "...";
}

}  // namespace

const Value* Table::find(std::string_view name) const {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == name; });
    return found == entries.end() ? nullptr : &found->value;
}

Entry& Table::entry(std::string_view name, const Location& where) {
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == name; });
    if (found != entries.end()) return *found;
    return entries.emplace_back(Entry{std::string(name), where, Value{where, Table{}}});
}

std::string Value::text() const {
    if (const auto* text = as<std::string>()) return shortened(toml_text(*text));
    if (const auto* word = as<BareWord>()) return shortened(word->text);
    if (const auto* integer = as<std::int64_t>()) return toml_text(*integer);
    if (const auto* number = as<double>()) return toml_text(*number);
    if (const auto* boolean = as<bool>()) return *boolean ? "true" : "false";
    if (const auto* date = as<DateOrTime>()) return date->text;
    return as<Table>() != nullptr ? "{...}" : "[...]";
}

std::string_view Value::type_in_words() const {
    constexpr std::string_view words[] = {"a table",       "a list",        "text",
                                          "no TOML value", "an integer",    "a floating-point number",
                                          "true or false", "a date or time"};
    return words[content.index()];
}

Value parse_document(std::string_view text, const std::string& file, std::uint32_t number) {
    try {
        return Converter(number).convert(toml::parse(text));
    } catch (const toml::parse_error& error) {
        const auto& place = error.source().begin;
        throw JobFaults(file, {Fault{{0, place.line, place.column}, complaint(error)}});
    }
}

Value parse_value(std::string_view text, const Location& where) {
    if (text.size() > longest_line) {
        throw std::invalid_argument(
            fmt::format("the value is {} bytes long; a value of a job has at most {}; shorten it", text.size(),
                        longest_line));
    }
    if (auto value = as_toml(std::string(text), where)) return *std::move(value);
    if (!as_toml(toml_text(text), where)) {
        throw std::invalid_argument("the value is not UTF-8; a job is UTF-8 text; write the value in UTF-8");
    }
    return {where, BareWord{std::string(text)}};
}

}  // namespace peterka::job
