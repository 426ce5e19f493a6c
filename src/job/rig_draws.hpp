// The rigs of [uncertainty]: numbers drawn around a cell's own, the same draws in every cell.
//
// Draw n takes a point of a low-discrepancy sequence (job/sobol.hpp). Numbers of a covariance deviate together,
// by its Cholesky factor times normal deviates; others each by itself. A draw that takes a number out of its
// range in any cell of the job is drawn again. So all draws are a function of the job alone.
//
// The place of a cell and its start are physical, in Hz, m and m/s as the cell's own rig has them: a motor and
// a stop are set, whatever the rig is. Offsets of [uncertainty.operating_point] add to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/cell_numbers.hpp"
#include "job/job.hpp"
#include "job/range.hpp"

namespace peterka::job {

// The lower Cholesky factor, row by row; nothing if the matrix is not positive definite. It is square.
[[nodiscard]] std::optional<std::vector<std::vector<double>>> cholesky_factor(
    const std::vector<std::vector<double>>& matrix);

class RigDraws {
  public:
    // For a job whose [uncertainty] is sound: its lists fit together, the matrix is positive definite, and each
    // number is spread in one way.
    explicit RigDraws(const Job& job);

    // job.uncertainty.rigs, or fewer if hardly any draw lies in the ranges: of the first `tried`.
    [[nodiscard]] std::size_t count() const { return deviations_.size(); }
    [[nodiscard]] std::int64_t tried() const { return tried_; }
    [[nodiscard]] std::int64_t drawn_again() const { return tried_ - static_cast<std::int64_t>(count()); }
    // Whether draws differ in more than their place.
    [[nodiscard]] bool vary_the_rig() const;
    // The number of which draws lie out of range most often; "" if none do.
    [[nodiscard]] std::string_view most_out_of_range() const;

    // The rig that draw n makes of a cell's own numbers, still at the place that these name.
    [[nodiscard]] CellNumbers rig(const CellNumbers& own, std::size_t n) const;
    // Puts a drawn rig at the place and start of the cell with these numbers, and adds the offsets of draw n.
    void place(CellNumbers& rig, const CellNumbers& own, std::size_t n) const;

  private:
    enum class Way { added, scaled, replaced };
    struct Number {
        std::string key;  // of an axis
        Way way;
        Range<double> range;
        std::int64_t out_of_range = 0;  // draws
        [[nodiscard]] bool is_of_place() const;
        [[nodiscard]] double drawn(double own, double deviation) const;
    };
    using Deviations = std::vector<double>;  // of each number

    void add_numbers(const Uncertainty& uncertainty);
    void draw(const Job& job, std::int64_t points);
    [[nodiscard]] Deviations deviations_of(const Uncertainty& uncertainty, std::int64_t point,
                                           std::int64_t points) const;
    [[nodiscard]] CellNumbers rig(const CellNumbers& own, const Deviations& deviations) const;
    void place(CellNumbers& rig, const CellNumbers& own, const Deviations& deviations) const;
    [[nodiscard]] bool is_in_range(const CellNumbers& own, const Deviations& deviations);

    std::vector<Number> numbers_;  // those of the covariance first
    std::vector<std::vector<double>> factor_;
    std::vector<Deviations> deviations_;  // of each draw kept
    std::int64_t tried_ = 0;
};

}  // namespace peterka::job
