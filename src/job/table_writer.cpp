#include "job/table_writer.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace peterka::job {

void TableWriter::either(const Alternative& first, const Alternative& second, std::string_view) {
    if (is_left_to_an_axis(first.key) || is_left_to_an_axis(second.key)) return;
    const Alternative& given = first.value ? first : second;
    line(given.key, toml_text(given.value.value()));
}

void TableWriter::rows(const Key& key, const std::vector<std::vector<double>>& values, const Range<double>&) {
    std::string text;
    for (const std::vector<double>& row : values) {
        std::string numbers;
        for (const double value : row) numbers += (numbers.empty() ? "" : ", ") + toml_text(value);
        text += (text.empty() ? "[" : ", [") + numbers + "]";
    }
    if (!values.empty()) line(key, "[" + text + "]");
}

void TableWriter::leave_to_axes(const Job& job) {
    left_to_axes_ = {job.columns.over, job.rows.over};
}

bool TableWriter::is_left_to_an_axis(const Key& key) const {
    const std::string name = fmt::format("{}.{}", path_, key.name);
    return std::ranges::find(left_to_axes_, name) != left_to_axes_.end();
}

void TableWriter::header() {
    if (has_header_) return;
    has_header_ = true;
    text_ += style_ == Style::for_people ? fmt::format("\n# {}\n[{}]\n", meaning_, path_)
                                         : fmt::format("[{}]\n", path_);
}

void TableWriter::line(const Key& key, const std::string& value) {
    if (!is_written(key)) return;
    header();
    const std::string assignment = fmt::format("{} = {}", key.name, value);
    text_ += style_ == Style::for_people
                 ? fmt::format("{:<39} # {}{}\n", assignment, key.meaning, origin_of(key))
                 : assignment + "\n";
}

std::string TableWriter::origin_of(const Key& key) const {
    if (origins_ == nullptr) return "";
    const auto origin =
        origins_->find(path_.empty() ? std::string(key.name) : fmt::format("{}.{}", path_, key.name));
    return fmt::format(" ({})", origin == origins_->end() ? "default" : origin->second);
}

}  // namespace peterka::job
