// Reads one table of a job into its struct. It records the keys it was asked for, which reveals unknown keys;
// every fault is added to the list and reading goes on with the default.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "job/axis_key.hpp"
#include "job/document.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/meant.hpp"
#include "job/names.hpp"
#include "job/range.hpp"

namespace peterka::job {

using Words = std::vector<std::string_view>;

class TableReader {
  public:
    // `path` is empty for the file's own level. `value` is a table and outlives the reader.
    TableReader(const Value& value, std::string path, std::vector<Fault>& faults);

    void number(const Key& key, double& value, const Range<double>& range);
    void integer(const Key& key, std::int64_t& value, const Range<std::int64_t>& range);
    // A count, or the word "all", which stands for the largest representable number.
    void count_or_all(const Key& key, std::int64_t& value, const Range<std::int64_t>& range);
    // Lists of at least one number; a given list replaces the default.
    void numbers(const Key& key, std::vector<double>& values, const Range<double>& range);
    void integers(const Key& key, std::vector<std::int64_t>& values, const Range<std::int64_t>& range);
    // Words that name what only a rule can tell.
    void words(const Key& key, std::vector<std::string>& values);
    // A list of lists.
    void rows(const Key& key, std::vector<std::vector<double>>& values, const Range<double>& range);
    void optional_number(const Key& key, std::optional<double>& value, const Range<double>& range);
    void text(const Key& key, std::string& value);
    void flag(const Key& key, bool& value);
    void either(const Alternative& first, const Alternative& second, std::string_view why);
    void either_list(const ListAlternative& first, const ListAlternative& second, std::string_view why);

    // Returns whether the choice is known, so that what depends on it can be read.
    template <typename Choice>
    bool choice(const Key& key, Choice& value) {
        if (const auto i = choose(key, all_names<Choice>(), name(value))) {
            value = Names<Choice>::all[*i].value;
        }
        return !faulty_.contains(key.name);
    }

    template <typename Choice>
    void choices(const Key& key, std::vector<Choice>& values) {
        for (const std::size_t i : choose_several(key, all_names<Choice>())) {
            values.push_back(Names<Choice>::all[i].value);
        }
    }

    // An inner table; `read` is not called if the file has none, so that all its defaults hold.
    template <typename Read>
    void table(const Key& key, Read read) {
        if (auto inner = open(key)) {
            read(*inner);
            inner->finish();
        }
    }

    // Whether the file has a table or key.
    [[nodiscard]] bool has(std::string_view name) const { return table_.find(name) != nullptr; }

    // From now on, keys that an axis of this file varies are left to it: they count as given, and values for
    // them in the tables have no effect.
    void leave_to_axes(const Job& job);

    // For the table [axes]: which two numbers of the job, or which one of a sweep, it varies, in the order of
    // the file.
    ChosenAxes choose_axes(Job& job);
    // For a basin: the unit of each of its starts.
    void choose_axes_of_basin(Job& job);

    // A rule over several keys, checked only if all of them are valid. `complaint` returns what is wrong, or
    // "".
    template <typename Complaint>
    void rule(std::initializer_list<std::string_view> keys, Complaint complaint) {
        if (!sound(keys)) return;
        if (const std::string text = complaint(); !text.empty()) fault_of_rule(keys, text);
    }

    // A table or key that other jobs have and this one cannot; `text` says why and what to do.
    void refuse(std::string_view name, std::string_view text);

    // Of the whole document, so far.
    [[nodiscard]] std::size_t count_faults() const { return faults_.size(); }

    // Known, but not read, because what they depend on is faulty.
    void skip(std::initializer_list<std::string_view> names);

    template <typename Note>
    void note(Note) {}  // for the writer

    void finish();  // every key that was not requested is a fault

  private:
    const Value* ask(const Key& key);  // nullptr if it is not given; a fault if it is required
    std::optional<TableReader> open(const Key& key);
    [[nodiscard]] bool has_key_left_to_an_axis(const std::string& table) const;
    [[nodiscard]] bool is_left_to_an_axis(std::string_view key) const;
    void read_number(const Key& key, const Value& value, double& number, const Range<double>& range);
    void read_integer(const Key& key, const Value& value, std::int64_t& number,
                      const Range<std::int64_t>& range);
    template <typename Number, typename ReadElement>
    void read_list(const Key& key, std::vector<Number>& values, ReadElement read_element);
    void read_alternative(const Alternative& alternative);
    // A fault if both are given, or neither and there is no default.
    void require_one_of(const Key& first, const Key& second, std::string_view why);
    std::optional<std::size_t> choose(const Key& key, const Words& names, std::string_view standard);
    std::vector<std::size_t> choose_several(const Key& key, const Words& names);

    [[nodiscard]] bool sound(std::initializer_list<std::string_view> keys) const;
    [[nodiscard]] std::string full_name(std::string_view name) const;
    [[nodiscard]] std::string place_to_add() const;
    [[nodiscard]] std::string_view example_of(const Key& key) const {
        return leads_in_si_ && !key.example_in_si.empty() ? key.example_in_si : key.example;
    }
    [[nodiscard]] std::string suggestion(const Meant& meant, bool is_table) const;

    void fault(std::string_view key, const Location& where, std::string text);
    void fault_of_rule(std::initializer_list<std::string_view> keys, const std::string& text);
    void wrong_type(const Key& key, const Value& value, std::string_view wanted, std::string_view example);

    template <typename Number>
    void check_range(const Key& key, const Value& value, Number number, const Range<Number>& range);

    const Table& table_;
    Location where_;
    std::string path_;
    bool leads_in_si_;  // the document, so that examples do, too
    std::vector<std::string> left_to_axes_;
    std::vector<Fault>& faults_;
    Words known_;  // names to suggest
    std::set<std::string, std::less<>> refused_;
    std::set<std::string, std::less<>> faulty_;
};

}  // namespace peterka::job
