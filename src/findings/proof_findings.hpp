// What is proved of the cells of a map, or of their attractors: counts by verdict, and bounds of the largest
// peak.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "cell/labels.hpp"
#include "cell/result.hpp"

namespace peterka::findings {

// Bounds on the largest peak force of the motions with a certificate, F/(m g0), or of a rigid stop on the
// largest impact speed [m/s].
struct ProvedPeak {
    double lower = -std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();

    void take(const ProvedPeak& other) {
        lower = std::max(lower, other.lower);
        upper = std::max(upper, other.upper);
    }
};

// motion: a cell or an attractor as stored.
template <class Stored>
[[nodiscard]] bool is_proved(const Stored& motion) {
    return motion.certified > cell::Certified::not_tried;
}
template <class Stored>
[[nodiscard]] ProvedPeak bounds_of_peak(const Stored& motion) {
    if (!is_proved(motion)) return {};
    const bool rigid = !std::isnan(motion.impact_speed_upper);
    return rigid ? ProvedPeak{motion.impact_speed_lower, motion.impact_speed_upper}
                 : ProvedPeak{motion.force_lower, motion.force_upper};
}
// How far a computed peak lies outside its bounds, relative to the upper one.
[[nodiscard]] inline double outside(const ProvedPeak& bounds, double computed) {
    const double outside = std::max({0.0, bounds.lower - computed, computed - bounds.upper});
    return outside > 0 ? outside / bounds.upper : 0;
}

struct ProofFindings {
    std::array<std::int64_t, cell::certified_names.size()> by_verdict{};  // in the order of their names
    ProvedPeak largest;
    double furthest_outside = 0;  // of computed peaks outside their own bounds, relative

    [[nodiscard]] std::int64_t count(cell::Certified verdict) const {
        return by_verdict[static_cast<std::size_t>(static_cast<int>(verdict) - cell::first_certified)];
    }
    // Cells and attractors of which nothing was asked, or that have no value, don't count.
    template <class Stored>
    void add(const Stored& motion, double computed_peak) {
        const int place = static_cast<int>(motion.certified) - cell::first_certified;
        if (place < 0) return;
        ++by_verdict[static_cast<std::size_t>(place)];
        const ProvedPeak bounds = bounds_of_peak(motion);
        largest.take(bounds);
        if (is_proved(motion)) furthest_outside = std::max(furthest_outside, outside(bounds, computed_peak));
    }
    void add(const ProofFindings& other) {
        std::ranges::transform(by_verdict, other.by_verdict, by_verdict.begin(), std::plus<>());
        largest.take(other.largest);
        furthest_outside = std::max(furthest_outside, other.furthest_outside);
    }
};

}  // namespace peterka::findings
