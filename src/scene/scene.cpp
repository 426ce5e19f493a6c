#include "scene/scene.hpp"

#include "job/axis.hpp"

namespace peterka::scene {

Scene::Scene(const job::Job& job) : job_(job), scales_(scales_of(job)), oscillator_(oscillator_of(job)) {}

Cell Scene::cell(std::int64_t row, std::int64_t column) const {
    const double across = job::axis_value(job_.columns, column);
    const bool sweeps = job_.kind == job::Kind::sweep;
    const double up = sweeps ? job_.sweep.branch(row).gap_ratio : job::axis_value(job_.rows, row);
    const bool is_map = job_.kind != job::Kind::basin;  // a study of labels has the plane of a map

    Cell cell{oscillator_, {}};
    cell.oscillator.frequency = is_map ? across : job_.operating_point.frequency_ratio;
    cell.oscillator.gap = is_map ? up : job_.operating_point.gap_ratio;
    const double displacement = is_map ? job_.start.displacement_ratio : across;
    const double velocity = is_map ? job_.start.velocity_ratio : up;
    // The cart passes its middle at full speed, y = 0 and y' = A0 Omega, when the forcing's phase is 0.
    cell.start = {displacement - cell.oscillator.gap, velocity - cell.oscillator.frequency};
    return cell;
}

}  // namespace peterka::scene
