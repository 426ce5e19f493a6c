#include "regime/orbit_round.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace peterka::regime {

void OrbitRound::add(const CycleResult& cycle, const Point& following) {
    const Point residual = cycle.end - following;
    steps_.push_back({cycle.jacobian, residual, cycle.pattern});
    residual_ = (cycle.jacobian * residual_ + residual).eval();
    jacobian_ = (cycle.jacobian * jacobian_).eval();
    largest_stretch_ = std::max(largest_stretch_, cycle.jacobian.norm());
    touched_ |= cycle.touched;
    separated_ |= cycle.separated;
}

std::optional<double> OrbitRound::correct(Points& points) const {
    const Eigen::Matrix2d system = Eigen::Matrix2d::Identity() - jacobian_;
    const Point first = system.partialPivLu().solve(residual_);
    double largest = 0;
    Point move = first;
    for (std::size_t n = 0; n < steps_.size(); ++n) {
        // written so that a NaN counts as too far
        const double size = move.lpNorm<Eigen::Infinity>() / magnitude(points[n]);
        if (!(size <= 1)) return std::nullopt;
        largest = std::max(largest, size);
        move = (steps_[n].jacobian * move + steps_[n].residual).eval();
    }
    move = first;
    for (std::size_t n = 0; n < steps_.size(); ++n) {
        points[n] += move;
        move = (steps_[n].jacobian * move + steps_[n].residual).eval();
    }
    return largest;
}

EventPattern OrbitRound::pattern(std::size_t from) const {
    EventPattern pattern = 0;
    for (std::size_t n = 0; n < steps_.size(); ++n) {
        pattern = append(pattern, steps_[(from + n) % steps_.size()].pattern);
    }
    return pattern;
}

}  // namespace peterka::regime
