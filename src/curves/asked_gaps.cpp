#include "curves/asked_gaps.hpp"

#include "job/axis_key.hpp"
#include "job/twins.hpp"

namespace peterka::curves {

std::size_t gap_axis(const job::Job& job) {
    return job::is_gap(job::column_key(job)) ? 0 : 1;
}

std::vector<double> asked_gaps(const Rig& rig, const job::Job& job) {
    const std::size_t axis = gap_axis(job);
    const auto twin = axis == 0 ? job::twin_of_columns(job) : job::twin_of_rows(job);
    std::vector<double> coordinates;
    for (const double gap : job.curves.gaps()) {
        const bool is_twin = twin && twin->key == job.curves.gap_key();
        const double value = is_twin ? job::as_twin(twin->key, gap, twin->rig) : gap;
        coordinates.push_back(coordinate(rig.place_of({value, value}), axis));
    }
    return coordinates;
}

}  // namespace peterka::curves
