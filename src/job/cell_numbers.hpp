// The numbers of a job that may differ from cell to cell, and one of them by its axis name.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

struct CellNumbers {
    Hammer hammer;
    Cart cart;
    Contact contact;
    OperatingPoint place;
    Start start;

    // Omega/omega and gap/A0, whichever keys gave them.
    [[nodiscard]] double frequency_ratio() const;
    [[nodiscard]] double gap_ratio() const;
    // x(0)/A0 and x'(0)/(A0 omega)
    [[nodiscard]] double displacement_ratio() const;
    [[nodiscard]] double velocity_ratio() const;
};

// As given in the job's tables.
[[nodiscard]] CellNumbers numbers_in(const Job& job);

// `key`: one listed in axis_quantity.hpp, for the stop's own law. It replaces an alternative key of which only
// one may be given: a frequency in Hz replaces a ratio.
void set_number(CellNumbers& numbers, std::string_view key, double value);

// The value of such a key, derived where its alternative is given.
[[nodiscard]] double number_of(const CellNumbers& numbers, std::string_view key);

// Whether the job gives this number itself, not an alternative to it, and other than 0.
[[nodiscard]] bool gives_number(const CellNumbers& numbers, std::string_view key);

// Like numbers_in, with the values of the job's axes, or of its branch, at this cell.
[[nodiscard]] CellNumbers numbers_at(const Job& job, std::int64_t row, std::int64_t column);

// For the cells listed in a work-precision study: at rest at phase 0.
[[nodiscard]] std::vector<CellNumbers> numbers_of_cells(const Job& job);

// For the first and last cells of the first and last rows, or of all branches: each number is monotonic along
// an axis, so what holds for these holds for all cells. A job without axes has one cell.
[[nodiscard]] std::vector<CellNumbers> numbers_at_corners(const Job& job);

}  // namespace peterka::job
