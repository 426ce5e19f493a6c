// Group /audit of a map file: a sample of cells, each solved again by an independent engine with every term.
//
// The sample is chosen and judged by the caller; a row's `agrees` is written last, so that a row that has it is
// complete.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hdf5/stored.hpp"
#include "job/job.hpp"
#include "map_file/layout.hpp"
#include "quantities/fields.hpp"

namespace peterka::map_file {

// For a cell with [starts]: how many starts were solved again, how many of these end on another attractor, and
// for how many of the latter a perturbation grew so much that rounding decides. For a cell with [uncertainty]:
// the same of rigs drawn for it, and of outcomes.
struct AuditedTries {
    std::int32_t solved = 0;
    std::int32_t elsewhere = 0;
    std::int32_t decided_by_rounding = 0;
};

struct AuditRow {
    std::int64_t cell = 0;  // row by row from 0
    std::int64_t row = 0;
    std::int64_t column = 0;
    quantities::StoredCell again;          // the independent result
    double force_error = regime::unknown;  // of the map relative to it; NaN if there is nothing to compare
    double filled_force_error = regime::unknown;  // of a force interpolated in a filled cell; not in the table
    double sensitivity = regime::unknown;  // where labels differ: ln of the largest growth of a perturbation
                                           // in either run
    bool agrees = false;                   // same regime, and the same p/q where it is periodic
    bool computed = true;                  // not filled from the cells around it
    AuditedTries starts;
    AuditedTries rigs;
    double seconds = 0;  // spent on solving it again
};

// What the sample implies for the whole map.
struct AuditReport {
    std::int64_t cells = 0;
    std::int64_t agreeing = 0;
    std::int64_t decided_by_rounding = 0;  // of computed ones that do not agree
    std::int64_t filled = 0;               // of all
    std::int64_t agreeing_filled = 0;
    std::int64_t compared = 0;                    // cells with a force_error
    double median_force_error = regime::unknown;  // of these, relative, as are the next two
    double force_error_99_percent = regime::unknown;
    double largest_force_error = regime::unknown;
    std::int64_t compared_filled = 0;  // filled cells with a filled_force_error
    double median_filled_error = regime::unknown;
    double largest_filled_error = regime::unknown;
    double seconds_per_cell = 0;  // of the independent engine
    struct Tries {                // of these cells
        std::int64_t solved = 0;  // again
        std::int64_t elsewhere = 0;
        std::int64_t decided_by_rounding = 0;  // of those
        void add(const AuditedTries& of_cell);
    };
    Tries starts = {};
    Tries rigs = {};
};
[[nodiscard]] AuditReport report(std::span<const AuditRow> rows);

// Relative error of the peak force of a cell of the map against the independent result; NaN if there is nothing
// to compare: the largest force of a motion without a period depends on the window in which it was observed.
[[nodiscard]] double force_error(const quantities::StoredCell& cell, const quantities::StoredCell& again);

// Rows of the table: audit.cells of the job, or all cells of a smaller map.
[[nodiscard]] std::int64_t audit_rows(const job::Job& job);

// Its datasets, for the layout; none if the job requests no audit.
[[nodiscard]] std::vector<DatasetPlan> audit_plans(const job::Job& job);
[[nodiscard]] std::vector<DatasetPlan> audit_run_plans(const job::Job& job);  // those in group /run

// The table in an open file. No call is collective.
class AuditTable {
  public:
    // The table has columns for starts and drawn rigs where the job has these.
    AuditTable(const hdf5::OpenMap& map, const job::Job& job)
        : map_(map), has_starts_(job.starts.count > 0), has_rigs_(job.uncertainty.rigs > 0) {}

    [[nodiscard]] bool has(std::int64_t index) const;
    void write(std::int64_t index, const AuditRow& row) const;
    // What a report needs of each of the first `count` rows, except whether the cell was computed.
    [[nodiscard]] std::vector<AuditRow> read(std::int64_t count) const;
    void write(const AuditReport& report) const;

  private:
    void put(const char* name, std::int64_t index, const AuditedTries& tries) const;
    [[nodiscard]] std::vector<AuditedTries> read_tries(const char* name, std::int64_t count) const;
    template <class Value>
    void put(const char* name, std::int64_t index, Value value) const;

    hdf5::OpenMap map_;
    bool has_starts_;
    bool has_rigs_;
};

}  // namespace peterka::map_file
