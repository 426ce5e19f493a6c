#include "job/table_writer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "job/twins.hpp"

namespace peterka::job {

void TableWriter::either(const Alternative& first, const Alternative& second, std::string_view) {
    if (is_left_to_an_axis(first.key) || is_left_to_an_axis(second.key)) return;
    const Alternative& given = first.value ? first : second;
    const double value = given.value.value();
    line(given.key, toml_text(value), in_other_unit(given.key, {value}, false));
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

void TableWriter::line(const Key& key, const std::string& value, const std::string& remark) {
    if (!is_written(key)) return;
    header();
    const std::string assignment = fmt::format("{} = {}", key.name, value);
    text_ += style_ == Style::for_people
                 ? fmt::format("{:<39} # {}{}{}\n", assignment, key.meaning, origin_of(key), remark)
                 : assignment + "\n";
}

std::string TableWriter::in_other_unit(const Key& key, const std::vector<double>& values, bool is_list) const {
    if (job_ == nullptr || !leads_in_si(*job_) || is_in_si(key.name)) return "";
    const std::optional<Twin> twin = shared_twin(*job_, key.name);
    if (!twin) return "";  // another number in each cell
    std::string text;
    for (const double value : values)
        text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", twin->value(value));
    return fmt::format(", or {} = {}", twin->key, is_list ? "[" + text + "]" : text);
}

std::string TableWriter::origin_of(const Key& key) const {
    if (origins_ == nullptr) return "";
    const auto origin =
        origins_->find(path_.empty() ? std::string(key.name) : fmt::format("{}.{}", path_, key.name));
    return fmt::format(" ({})", origin == origins_->end() ? "default" : origin->second);
}

}  // namespace peterka::job
