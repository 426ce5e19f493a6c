#include "scene/scene.hpp"

#include "job/axis.hpp"

namespace peterka::scene {

Scene::Scene(const job::Job& job) : job_(job), scales_(scales_of(job)), oscillator_(oscillator_of(job)) {}

// The cart passes its middle at full speed, y = 0 and y' = A0 Omega, when the forcing's phase is 0.
Cell Scene::cell_at(const job::OperatingPoint& place, const job::Start& start) const {
    Cell cell{oscillator_, {}};
    cell.oscillator.frequency = place.frequency_ratio;
    cell.oscillator.gap = place.gap_ratio;
    cell.start = {start.displacement_ratio - place.gap_ratio, start.velocity_ratio - place.frequency_ratio};
    return cell;
}

Cell Scene::cell(std::int64_t row, std::int64_t column) const {
    if (job_.kind == job::Kind::trace) return cell_at(job_.operating_point, job_.start);
    const double across = job::axis_value(job_.columns, column);
    const bool sweeps = job_.kind == job::Kind::sweep;
    const double up = sweeps ? job_.sweep.branch(row).gap_ratio : job::axis_value(job_.rows, row);
    const bool is_map = job_.kind != job::Kind::basin;  // a study of labels has the plane of a map

    if (is_map) return cell_at({across, up}, job_.start);
    return cell_at(job_.operating_point, {across, up});
}

}  // namespace peterka::scene
