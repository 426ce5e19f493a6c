#include "map_file/attractor_samples.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace peterka::map_file {

namespace {

using attractors::PointAttractors;
using regime::SteadyMotion;

// Samples of one kind for all points: the attractor of each, and its two numbers.
struct Columns {
    explicit Columns(std::size_t size)
        : attractor(size, -1), displacement(size, regime::unknown), velocity(size, regime::unknown) {}
    std::vector<std::int32_t> attractor;
    std::vector<double> displacement;
    std::vector<double> velocity;
};

using Pairs = std::vector<std::pair<double, double>>;
using PairsOf = std::function<Pairs(const SteadyMotion& motion, double gap)>;

Pairs stroboscopic(const SteadyMotion& motion, double gap) {
    Pairs pairs;
    for (const auto& state : motion.stroboscopic.values()) pairs.emplace_back(state[0] + gap, state[1]);
    return pairs;
}

Pairs touches(const SteadyMotion& motion, double gap) {
    Pairs pairs;
    for (const auto& touch : motion.touches.values()) {
        pairs.emplace_back(gap + std::sin(touch.phase), touch.speed);
    }
    return pairs;
}

Columns columns_of(std::span<const PointAttractors> points, std::size_t samples, const PairsOf& pairs_of) {
    Columns columns(points.size() * samples);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t end = (i + 1) * samples;
        std::size_t at = i * samples;
        const std::size_t slots = points[i].motions.size();
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const Pairs pairs = pairs_of(points[i].motions[slot], points[i].gap);
            const std::size_t count = std::min(pairs.size(), (end - at) / (slots - slot));
            for (std::size_t n = 0; n < count; ++n, ++at) {
                columns.attractor[at] = static_cast<std::int32_t>(slot);
                columns.displacement[at] = pairs[n].first;
                columns.velocity[at] = pairs[n].second;
            }
        }
    }
    return columns;
}

template <class Value>
void append(std::vector<std::byte>& bytes, const std::vector<Value>& values, std::int64_t times) {
    const auto added = std::as_bytes(std::span(values));
    for (std::int64_t n = 0; n < times; ++n) bytes.insert(bytes.end(), added.begin(), added.end());
}

}  // namespace

std::vector<std::byte> attractor_sample_bytes(std::span<const PointAttractors> points, std::int64_t rows,
                                              std::int64_t samples) {
    std::vector<std::byte> bytes;
    for (const PairsOf& pairs_of : {PairsOf(stroboscopic), PairsOf(touches)}) {
        const Columns columns = columns_of(points, static_cast<std::size_t>(samples), pairs_of);
        append(bytes, columns.attractor, rows);
        append(bytes, columns.displacement, rows);
        append(bytes, columns.velocity, rows);
    }
    return bytes;
}

}  // namespace peterka::map_file
