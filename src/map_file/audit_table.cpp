#include "map_file/audit_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "hdf5/block.hpp"

namespace peterka::map_file {

namespace {

constexpr double not_audited = regime::regime_not_computed;
constexpr const char* agrees = "agrees";
constexpr const char* of_force = "force_error";
constexpr const char* sensitivity = "sensitivity";
constexpr const char* starts = "starts";
constexpr const char* rigs = "rigs";
constexpr const char* ended_elsewhere = "_elsewhere";
constexpr const char* decided_by_rounding = "_decided_by_rounding";
constexpr const char* seconds_path = "/run/audit_seconds";
constexpr const char* agreeing_names[] = {"differs", "agrees"};

// clang-format off
constexpr hdf5::Variable audited{"sample", hdf5::Number::int32, -1, "1", "number of the audited cell"};
constexpr hdf5::Variable columns[] = {
    {"cell", hdf5::Number::int64, -1, "1", "number of the cell in the map, row by row"},
    {"row", hdf5::Number::int32, -1, "1", "its row"},
    {"column", hdf5::Number::int32, -1, "1", "its column"},
    {"regime", hdf5::Number::int8, not_audited, "", "regime by the independent engine", cell::regime_names},
    {"status", hdf5::Number::int8, not_audited, "", "why that is unresolved or failed", cell::status_names},
    {"engine", hdf5::Number::int8, not_audited, "", "the independent engine", cell::engine_names},
    {"impacts", hdf5::Number::int32, -1, "1", "impacts p of z = p/q by it"},
    {"period", hdf5::Number::int32, -1, "1", "period q of z = p/q by it in forcing cycles"},
    {"peak_force_ratio", hdf5::Number::float64, regime::unknown, "1", "peak impact force over hammer weight by it, F/(m g0)"},
    {of_force, hdf5::Number::float64, regime::unknown, "1", "relative error of the map's peak force against it; NaN where there is nothing to compare, as in filled cells"},
    {sensitivity, hdf5::Number::float64, regime::unknown, "1", "where labels differ: ln of the largest growth of a perturbation in either run; above about 20 the label depends on rounding; NaN where they agree"},
    {agrees, hdf5::Number::int8, not_audited, "", "whether regime and p/q of the map are the same", agreeing_names},
};
constexpr hdf5::Variable start_columns[] = {
    {starts, hdf5::Number::int32, -1, "1", "starts of the cell solved again, each in full, by the independent engine"},
    {"starts_elsewhere", hdf5::Number::int32, -1, "1", "of these, how many end on another attractor than the map says"},
    {"starts_decided_by_rounding", hdf5::Number::int32, -1, "1", "of these, in how many a perturbation grew by e^20 or more, so that rounding decides"},
};
constexpr hdf5::Variable rig_columns[] = {
    {rigs, hdf5::Number::int32, -1, "1", "rigs drawn for the cell and solved again by the independent engine"},
    {"rigs_elsewhere", hdf5::Number::int32, -1, "1", "of these, how many have another outcome than the map says"},
    {"rigs_decided_by_rounding", hdf5::Number::int32, -1, "1", "of these, in how many a perturbation grew by e^20 or more, so that rounding decides"},
};
constexpr hdf5::Variable agreeing_rigs{"agreeing_rigs", hdf5::Number::float64, regime::unknown, "1", "share of the rigs solved again that have the outcome that the map says"};
constexpr hdf5::Variable agreeing_starts{"agreeing_starts", hdf5::Number::float64, regime::unknown, "1", "share of the starts solved again that end on the attractor that the map says"};
constexpr hdf5::Variable results[] = {
    {"agreeing_labels", hdf5::Number::float64, regime::unknown, "1", "share of audited cells with the same regime and p/q"},
    {"force_error_median", hdf5::Number::float64, regime::unknown, "1", "median relative error of the peak force"},
    {"force_error_99_percent", hdf5::Number::float64, regime::unknown, "1", "error that 99 % of the compared cells do not exceed"},
    {"force_error_largest", hdf5::Number::float64, regime::unknown, "1", "largest relative error of the peak force"},
};
constexpr hdf5::Variable seconds{"audit_seconds", hdf5::Number::float64, regime::unknown, "s", "computing time of the independent engine"};
// clang-format on

std::string path_of(const char* name) {
    return std::string("/audit/") + name;
}

template <class Value>
constexpr hdf5::Number number_of() {
    if constexpr (std::is_same_v<Value, std::int8_t>) return hdf5::Number::int8;
    if constexpr (std::is_same_v<Value, std::int32_t>) return hdf5::Number::int32;
    if constexpr (std::is_same_v<Value, std::int64_t>) return hdf5::Number::int64;
    return hdf5::Number::float64;
}

template <class Value>
std::vector<Value> read_column(const hdf5::OpenMap& map, const std::string& path, std::int64_t count) {
    std::vector<Value> values(static_cast<std::size_t>(count));
    if (count > 0) hdf5::Stored(map, path, number_of<Value>()).read(hdf5::Block(0, count), values.data());
    return values;
}

// The smallest error that this share of the cells does not exceed; NaN without any.
double quantile_of(std::vector<double> errors, double share) {
    if (errors.empty()) return regime::unknown;
    std::ranges::sort(errors);
    return errors[static_cast<std::size_t>(std::ceil(share * static_cast<double>(errors.size()))) - 1];
}

}  // namespace

void AuditReport::Tries::add(const AuditedTries& of_cell) {
    solved += of_cell.solved;
    elsewhere += of_cell.elsewhere;
    decided_by_rounding += of_cell.decided_by_rounding;
}

AuditReport report(std::span<const AuditRow> rows) {
    AuditReport report{.cells = std::ssize(rows)};
    std::vector<double> errors;
    std::vector<double> of_filled;
    for (const AuditRow& row : rows) {
        report.agreeing += row.agrees ? 1 : 0;
        report.filled += row.computed ? 0 : 1;
        report.agreeing_filled += row.agrees && !row.computed ? 1 : 0;
        const bool by_rounding = row.computed && !row.agrees && row.sensitivity > regime::rounding_decides;
        report.decided_by_rounding += by_rounding ? 1 : 0;
        report.starts.add(row.starts);
        report.rigs.add(row.rigs);
        report.seconds_per_cell += row.seconds / static_cast<double>(rows.size());
        if (!std::isnan(row.force_error)) errors.push_back(row.force_error);
        if (!std::isnan(row.filled_force_error)) of_filled.push_back(row.filled_force_error);
    }
    report.compared = std::ssize(errors);
    report.median_force_error = quantile_of(errors, 0.5);
    report.force_error_99_percent = quantile_of(errors, 0.99);
    report.largest_force_error = quantile_of(errors, 1);
    report.compared_filled = std::ssize(of_filled);
    report.median_filled_error = quantile_of(of_filled, 0.5);
    report.largest_filled_error = quantile_of(of_filled, 1);
    return report;
}

double force_error(const quantities::StoredCell& cell, const quantities::StoredCell& again) {
    const bool settled =
        again.regime == regime::Regime::periodic || again.regime == regime::Regime::sustained_contact;
    if (!settled || !regime::same_label(cell, again) || !(again.peak_force > 0)) return regime::unknown;
    return std::abs(cell.peak_force / again.peak_force - 1);
}

std::int64_t audit_rows(const job::Job& job) {
    return std::min(job.audit.cells, job.cells());
}

std::vector<DatasetPlan> audit_plans(const job::Job& job) {
    std::vector<DatasetPlan> plans;
    const Dimension dimension{audited.name, audit_rows(job)};
    if (dimension.size == 0) return plans;
    plans.push_back({"/audit", audited, {dimension}});
    for (const hdf5::Variable& column : columns) plans.push_back({"/audit", column, {dimension}});
    const auto add = [&](const auto& more, const hdf5::Variable& agreeing) {
        for (const hdf5::Variable& column : more) plans.push_back({"/audit", column, {dimension}});
        plans.push_back({"/audit", agreeing, {}});
    };
    if (job.starts.count > 0) add(start_columns, agreeing_starts);
    if (job.uncertainty.rigs > 0) add(rig_columns, agreeing_rigs);
    for (const hdf5::Variable& result : results) plans.push_back({"/audit", result, {}});
    return plans;
}

std::vector<DatasetPlan> audit_run_plans(const job::Job& job) {
    const Dimension dimension{audited.name, audit_rows(job)};
    if (dimension.size == 0) return {};
    return {{"/run", audited, {dimension}}, {"/run", seconds, {dimension}}};
}

template <class Value>
void AuditTable::put(const char* name, std::int64_t index, Value value) const {
    hdf5::Stored(map_, path_of(name), number_of<Value>()).write(hdf5::Block(index, 1), &value);
}

bool AuditTable::has(std::int64_t index) const {
    std::int8_t mark = -1;
    hdf5::Stored(map_, path_of(agrees), hdf5::Number::int8).read(hdf5::Block(index, 1), &mark);
    return mark == 0 || mark == 1;
}

void AuditTable::write(std::int64_t index, const AuditRow& row) const {
    put("cell", index, row.cell);
    put("row", index, static_cast<std::int32_t>(row.row));
    put("column", index, static_cast<std::int32_t>(row.column));
    put("regime", index, static_cast<std::int8_t>(row.again.regime));
    put("status", index, static_cast<std::int8_t>(row.again.status));
    put("engine", index, static_cast<std::int8_t>(row.again.engine));
    put("impacts", index, row.again.impacts);
    put("period", index, row.again.period);
    put("peak_force_ratio", index, row.again.peak_force);
    put(of_force, index, row.force_error);
    put(sensitivity, index, row.sensitivity);
    if (has_starts_) put(starts, index, row.starts);
    if (has_rigs_) put(rigs, index, row.rigs);
    hdf5::Stored(map_, seconds_path, hdf5::Number::float64).write(hdf5::Block(index, 1), &row.seconds);
    put(agrees, index, static_cast<std::int8_t>(row.agrees ? 1 : 0));
}

std::vector<AuditRow> AuditTable::read(std::int64_t count) const {
    const auto errors = read_column<double>(map_, path_of(of_force), count);
    const auto regimes = read_column<std::int8_t>(map_, path_of("regime"), count);
    const auto impacts = read_column<std::int32_t>(map_, path_of("impacts"), count);
    const auto periods = read_column<std::int32_t>(map_, path_of("period"), count);
    const auto forces = read_column<double>(map_, path_of("peak_force_ratio"), count);
    const auto places = read_column<std::int64_t>(map_, path_of("cell"), count);
    const auto growths = read_column<double>(map_, path_of(sensitivity), count);
    const auto marks = read_column<std::int8_t>(map_, path_of(agrees), count);
    const auto times = read_column<double>(map_, seconds_path, count);
    std::vector<AuditRow> rows(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].cell = places[i];
        rows[i].again.regime = static_cast<regime::Regime>(regimes[i]);
        rows[i].again.impacts = impacts[i];
        rows[i].again.period = periods[i];
        rows[i].again.peak_force = forces[i];
        rows[i].force_error = errors[i];
        rows[i].sensitivity = growths[i];
        rows[i].agrees = marks[i] == 1;
        rows[i].seconds = times[i];
    }
    const auto of_starts = has_starts_ ? read_tries(starts, count) : std::vector<AuditedTries>(rows.size());
    const auto of_rigs = has_rigs_ ? read_tries(rigs, count) : std::vector<AuditedTries>(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].starts = of_starts[i];
        rows[i].rigs = of_rigs[i];
    }
    return rows;
}

void AuditTable::put(const char* name, std::int64_t index, const AuditedTries& tries) const {
    put(name, index, tries.solved);
    put((std::string(name) + ended_elsewhere).c_str(), index, tries.elsewhere);
    put((std::string(name) + decided_by_rounding).c_str(), index, tries.decided_by_rounding);
}

std::vector<AuditedTries> AuditTable::read_tries(const char* name, std::int64_t count) const {
    const auto column = [&](const char* suffix) {
        return read_column<std::int32_t>(map_, path_of((std::string(name) + suffix).c_str()), count);
    };
    const auto solved = column("");
    const auto elsewhere = column(ended_elsewhere);
    const auto by_rounding = column(decided_by_rounding);
    std::vector<AuditedTries> tries;
    for (std::size_t i = 0; i < solved.size(); ++i) tries.push_back({solved[i], elsewhere[i], by_rounding[i]});
    return tries;
}

void AuditTable::write(const AuditReport& report) const {
    const double share = static_cast<double>(report.agreeing) / static_cast<double>(report.cells);
    const auto put_result = [&](const char* name, double value) {
        hdf5::put_number(map_, path_of(name).c_str(), hdf5::Number::float64, value);
    };
    put_result("agreeing_labels", share);
    const auto put_agreeing = [&](const hdf5::Variable& agreeing, const AuditReport::Tries& tries) {
        if (tries.solved == 0) return;
        put_result(agreeing.name, 1 - static_cast<double>(tries.elsewhere) / static_cast<double>(tries.solved));
    };
    put_agreeing(agreeing_starts, report.starts);
    put_agreeing(agreeing_rigs, report.rigs);
    put_result("force_error_median", report.median_force_error);
    put_result("force_error_99_percent", report.force_error_99_percent);
    put_result("force_error_largest", report.largest_force_error);
}

}  // namespace peterka::map_file
