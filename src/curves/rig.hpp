// The rig of a job at any place of its plane.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "curves/placed_rig.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/job.hpp"
#include "job/twins.hpp"

namespace peterka::curves {

// A place in the plane. A coordinate is Omega/omega or gap/A0 if the axis runs over that, in either unit. For
// any other axis, and if the rig changes that unit from place to place, it is the value over the largest one on
// the axis, or its logarithm: numbers of order 1, whatever the unit, in which steps and residuals are measured.
struct PlanePoint {
    double column = 0;
    double row = 0;
};

class Rig {
  public:
    // In the plane of frequency_ratio and gap_ratio; the oscillator's own frequency and gap are ignored.
    explicit Rig(const scene::Oscillator<double>& oscillator);
    // In the plane of the job's axes.
    explicit Rig(const job::Job& job);

    [[nodiscard]] bool is_rigid() const { return scene::is_rigid(oscillator_.contact); }
    [[nodiscard]] PlacedRig at(const PlanePoint& place) const;
    // F/(m g0) of a force k A0.
    [[nodiscard]] double force_ratio(const PlanePoint& place) const;

    // The values of the axes, in their units, at a place, and the inverse.
    [[nodiscard]] PlanePoint values_at(const PlanePoint& place) const;
    [[nodiscard]] PlanePoint place_of(const PlanePoint& values) const;

    // The quantity that an axis runs over: columns first, then rows.
    [[nodiscard]] const std::string& key(std::size_t axis) const { return axes_[axis].key; }
    // Whether its coordinate is Omega/omega or gap/A0.
    [[nodiscard]] bool is_in_ratios(std::size_t axis) const { return axes_[axis].is_in_ratios; }
    // Whether springs, dampers or stop change along an axis. Derivatives by its coordinate then have no closed
    // form and are central differences with this step.
    [[nodiscard]] bool changes_along(std::size_t axis) const { return axes_[axis].is_of_rig; }
    [[nodiscard]] double step_of_difference(std::size_t axis, const PlanePoint& place) const;

  private:
    struct AlongAxis {
        std::string key;
        bool is_of_rig = false;
        bool is_in_ratios = false;
        bool is_logarithmic = false;
        double unit = 1;  // the value at coordinate 1, unless logarithmic

        [[nodiscard]] double value(double coordinate) const;
        [[nodiscard]] double coordinate(double value) const;
        [[nodiscard]] double slope(double coordinate) const;  // derivative of the value
    };

    static AlongAxis along(std::string_view key, const job::Axis& axis, const std::optional<job::Twin>& twin);
    [[nodiscard]] job::CellNumbers numbers_at(const PlanePoint& place) const;
    [[nodiscard]] PlaceSlopes slopes_at(const job::CellNumbers& numbers, const PlanePoint& place) const;

    std::array<AlongAxis, 2> axes_;
    job::CellNumbers numbers_;              // of the job's tables
    scene::Oscillator<double> oscillator_;  // of these numbers
};

[[nodiscard]] inline double coordinate(const PlanePoint& place, std::size_t axis) {
    return axis == 0 ? place.column : place.row;
}
[[nodiscard]] inline PlanePoint moved(PlanePoint place, std::size_t axis, double by) {
    (axis == 0 ? place.column : place.row) += by;
    return place;
}

}  // namespace peterka::curves
