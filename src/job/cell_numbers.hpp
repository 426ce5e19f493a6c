// The numbers of a job that a cell may have for itself, and setting one of them by the name that an axis gives
// it.
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

// As the tables of the job have them.
[[nodiscard]] CellNumbers numbers_in(const Job& job);

// `key` as axis_quantity.hpp lists them, of the law that the stop has. It takes the place of a key of which
// only one of both is given: a frequency in Hz that of a ratio.
void set_number(CellNumbers& numbers, std::string_view key, double value);

// As numbers_in, with the values of the job's axes, or its branch, at a place.
[[nodiscard]] CellNumbers numbers_at(const Job& job, std::int64_t row, std::int64_t column);

// Of the cells that a study of work and precision lists: at rest at phase 0.
[[nodiscard]] std::vector<CellNumbers> numbers_of_cells(const Job& job);

// Of the first and last cells of the first and last rows, or of all branches: each number is monotonic along an
// axis, so that what holds for these holds for all cells. A job without axes has one.
[[nodiscard]] std::vector<CellNumbers> numbers_at_corners(const Job& job);

}  // namespace peterka::job
