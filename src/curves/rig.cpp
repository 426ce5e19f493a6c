#include "curves/rig.hpp"

#include <algorithm>
#include <cmath>

#include "job/axis_key.hpp"
#include "job/derived.hpp"
#include "scene/scales.hpp"

namespace peterka::curves {

double Rig::AlongAxis::value(double coordinate) const {
    return is_logarithmic ? std::exp(coordinate) : coordinate * unit;
}

double Rig::AlongAxis::coordinate(double value) const {
    return is_logarithmic ? std::log(value) : value / unit;
}

double Rig::AlongAxis::slope(double coordinate) const {
    return is_logarithmic ? std::exp(coordinate) : unit;
}

Rig::AlongAxis Rig::along(std::string_view key, const job::Axis& axis, const std::optional<job::Twin>& twin) {
    const bool in_si = job::is_in_si(key);
    const bool is_on_the_plane = job::is_frequency(key) || job::is_gap(key);
    AlongAxis result{.key = std::string(key),
                     .is_of_rig = job::is_of_rig(key),
                     .is_in_ratios = is_on_the_plane && (!in_si || twin)};
    if (result.is_in_ratios) {
        if (in_si) result.unit = job::unit_of(key, twin->rig);
        return result;
    }
    result.is_logarithmic = axis.scale == job::Spacing::log;
    result.unit = std::max(std::abs(axis.from), std::abs(axis.to));
    if (!(result.unit > 0)) result.unit = 1;
    return result;
}

Rig::Rig(const scene::Oscillator<double>& oscillator)
    : axes_{AlongAxis{.key = "frequency_ratio", .is_in_ratios = true},
            AlongAxis{.key = "gap_ratio", .is_in_ratios = true}},
      oscillator_(oscillator) {}

Rig::Rig(const job::Job& job)
    : axes_{along(job::column_key(job), job.columns, job::twin_of_columns(job)),
            along(job::row_key(job), job.rows, job::twin_of_rows(job))},
      numbers_(job::numbers_in(job)),
      oscillator_(scene::oscillator_of(numbers_)) {}

job::CellNumbers Rig::numbers_at(const PlanePoint& place) const {
    job::CellNumbers numbers = numbers_;
    const PlanePoint values = values_at(place);
    job::set_number(numbers, axes_[0].key, values.column);
    job::set_number(numbers, axes_[1].key, values.row);
    return numbers;
}

PlaceSlopes Rig::slopes_at(const job::CellNumbers& numbers, const PlanePoint& place) const {
    const auto of_axis = [&](std::size_t axis, double& of_frequency, double& of_gap) {
        of_frequency = 0;
        of_gap = 0;
        const AlongAxis& along = axes_[axis];
        const double slope = along.slope(coordinate(place, axis));
        if (along.key == "frequency_ratio") of_frequency = slope;
        if (along.key == "frequency_hz") of_frequency = slope / job::natural_frequency_hz(numbers.hammer);
        if (along.key == "gap_ratio") of_gap = slope;
        if (along.key == "gap_m") of_gap = slope / numbers.cart.amplitude_m;
    };
    PlaceSlopes slopes;
    of_axis(0, slopes.frequency_by_column, slopes.gap_by_column);
    of_axis(1, slopes.frequency_by_row, slopes.gap_by_row);
    return slopes;
}

PlacedRig Rig::at(const PlanePoint& place) const {
    const job::CellNumbers numbers = numbers_at(place);
    scene::Oscillator<double> oscillator =
        changes_along(0) || changes_along(1) ? scene::oscillator_of(numbers) : oscillator_;
    oscillator.frequency = numbers.frequency_ratio();
    oscillator.gap = numbers.gap_ratio();
    return PlacedRig(oscillator, slopes_at(numbers, place));
}

double Rig::force_ratio(const PlanePoint& place) const {
    return scene::scales_of(numbers_at(place)).force_ratio();
}

PlanePoint Rig::values_at(const PlanePoint& place) const {
    return {axes_[0].value(place.column), axes_[1].value(place.row)};
}

PlanePoint Rig::place_of(const PlanePoint& values) const {
    return {axes_[0].coordinate(values.column), axes_[1].coordinate(values.row)};
}

// Half the distance of the two places: small relative to the value itself, so that its sign is kept, and far
// above rounding. An error of 1e-9 in these derivatives does not slow Newton's method.
double Rig::step_of_difference(std::size_t axis, const PlanePoint& place) const {
    constexpr double step = 1e-6;
    const double size = std::abs(coordinate(place, axis));
    return axes_[axis].is_logarithmic || size == 0 ? step : std::min(step, 1e-2 * size);
}

}  // namespace peterka::curves
