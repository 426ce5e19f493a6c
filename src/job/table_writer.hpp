// Writes a job as TOML, table by table, for a person (every key with its meaning and unit) or for comparison
// (without them).
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "job/axis_key.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/origins.hpp"
#include "job/range.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {

enum class Style { for_people, for_identity };

class TableWriter {
  public:
    // With the job's origins, each value is annotated, for people, with where it came from, and ratios in a
    // job in SI units with what they are there.
    TableWriter(std::string& text, Style style, const Job* job = nullptr, const Origins* origins = nullptr)
        : TableWriter(text, style, job, origins, "", "") {}

    void number(const Key& key, double value, const Range<double>&) {
        if (!is_left_to_an_axis(key)) line(key, toml_text(value));
    }
    void integer(const Key& key, std::int64_t value, const Range<std::int64_t>&) {
        line(key, toml_text(value));
    }
    void count_or_all(const Key& key, std::int64_t value, const Range<std::int64_t>&) {
        line(key, value == every_cell ? toml_text("all") : toml_text(value));
    }
    void numbers(const Key& key, const std::vector<double>& values, const Range<double>&) { list(key, values); }
    void integers(const Key& key, const std::vector<std::int64_t>& values, const Range<std::int64_t>&) {
        list(key, values);
    }
    // These are written only if given.
    void optional_number(const Key& key, const std::optional<double>& value, const Range<double>&) {
        if (value) line(key, toml_text(*value));
    }
    void words(const Key& key, const std::vector<std::string>& values) { list(key, values); }
    void rows(const Key& key, const std::vector<std::vector<double>>& values, const Range<double>&);
    void text(const Key& key, const std::string& value) { line(key, toml_text(value)); }
    void flag(const Key& key, bool value) { line(key, value ? "true" : "false"); }
    void either(const Alternative& first, const Alternative& second, std::string_view why);
    void either_list(const ListAlternative& first, const ListAlternative& second, std::string_view) {
        const ListAlternative& given = second.values.empty() ? first : second;
        list(given.key, given.values, in_other_unit(given.key, given.values, true));
    }

    template <typename Choice>
    bool choice(const Key& key, Choice value) {
        line(key, toml_text(name(value)));
        return true;
    }

    template <typename Choice>
    void choices(const Key& key, const std::vector<Choice>& values) {
        std::string list;
        for (const Choice value : values) list += (list.empty() ? "" : ", ") + toml_text(name(value));
        line(key, "[" + list + "]");
    }

    template <typename Write>
    void table(const Key& key, Write write) {
        if (!is_written(key)) return;
        TableWriter inner(text_, style_, job_, origins_,
                          path_.empty() ? std::string(key.name) : path_ + "." + std::string(key.name),
                          key.meaning);
        inner.left_to_axes_ = left_to_axes_;
        write(inner);
    }

    // Keys that an axis varies are not written: their tables have its first value (settle.hpp).
    void leave_to_axes(const Job& job);

    template <typename Note>
    void note(Note note) {
        if (style_ == Style::for_people) text_ += note();
    }

    // Relevant only to reading.
    template <typename Complaint>
    void rule(std::initializer_list<std::string_view>, Complaint) {}
    void refuse(std::string_view, std::string_view) {}
    void skip(std::initializer_list<std::string_view>) {}
    [[nodiscard]] bool has(std::string_view) const { return true; }
    [[nodiscard]] static std::size_t count_faults() { return 0; }
    ChosenAxes choose_axes(const Job&) { return {}; }
    void choose_axes_of_basin(const Job&) {}

  private:
    TableWriter(std::string& text, Style style, const Job* job, const Origins* origins, std::string path,
                std::string_view meaning)
        : text_(text),
          style_(style),
          job_(job),
          origins_(origins),
          path_(std::move(path)),
          meaning_(meaning),
          has_header_(path_.empty()) {}

    [[nodiscard]] bool is_written(const Key& key) const {
        return key.is_written && (style_ == Style::for_people || key.is_identity);
    }
    template <typename Number>
    void list(const Key& key, const std::vector<Number>& values, const std::string& remark = "") {
        if (values.empty()) return;  // a list that the job does not have
        std::string text;
        for (const Number& value : values) text += (text.empty() ? "" : ", ") + toml_text(value);
        line(key, "[" + text + "]", remark);
    }
    void line(const Key& key, const std::string& value, const std::string& remark = "");
    // A ratio in a job in SI units as it would be given there, such as ", or displacement_m = 0"; "" for
    // others.
    [[nodiscard]] std::string in_other_unit(const Key& key, const std::vector<double>& values,
                                            bool is_list) const;
    [[nodiscard]] bool is_left_to_an_axis(const Key& key) const;
    [[nodiscard]] std::string origin_of(const Key& key) const;
    void header();  // before the first key: a table of tables alone needs none

    std::string& text_;
    Style style_;
    const Job* job_;
    const Origins* origins_;
    std::string path_;
    std::string_view meaning_;
    bool has_header_;
    std::vector<std::string> left_to_axes_;
};

}  // namespace peterka::job
