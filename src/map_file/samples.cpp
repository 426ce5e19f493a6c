#include "map_file/samples.hpp"

#include <cmath>
#include <cstddef>

#include "map_file/attractor_samples.hpp"

namespace peterka::map_file {

std::vector<hdf5::Variable> stored_sample_variables(const job::Job& job) {
    if (job.kind != job::Kind::sweep) return {};
    std::vector<hdf5::Variable> stored(sample_variables.begin(), sample_variables.end());
    if (job.starts.count > 0) {
        stored.insert(stored.end(), attractor_sample_variables.begin(), attractor_sample_variables.end());
    }
    return stored;
}

std::vector<double> sample_values(std::span<const regime::BranchPoint> points, std::int64_t samples) {
    const auto per_point = static_cast<std::size_t>(samples);
    const std::size_t per_variable = points.size() * per_point;
    std::vector<double> values(sample_variables.size() * per_variable, regime::unknown);
    for (std::size_t point = 0; point < points.size(); ++point) {
        const double gap = points[point].gap;
        double* to = &values[point * per_point];
        for (const auto& state : points[point].motion.stroboscopic.values()) {
            to[0] = state[0] + gap;
            to[per_variable] = state[1];
            ++to;
        }
        to = &values[2 * per_variable + point * per_point];
        for (const auto& touch : points[point].motion.touches.values()) {
            to[0] = gap + std::sin(touch.phase);
            to[per_variable] = touch.speed;
            ++to;
        }
    }
    return values;
}

}  // namespace peterka::map_file
