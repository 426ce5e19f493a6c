#include "noise/home.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "trajectory/multiplier.hpp"

namespace peterka::noise {

namespace {

using Matrix = scene::Jacobian<double>;
using State = scene::State<double>;

using Linear = DisturbedMap::Linear;

// What a cycle of a cart that deviates by a standard deviation changes in the state at its end, to first order.
std::optional<State> effect_of(DisturbedMap& map, const State& start, const Deviations& of_one) {
    constexpr double small = 1e-6;  // smooth but at grazings, and well above rounding
    const double share = small / std::max(of_one.amplitude, of_one.frequency);
    const auto more = map.deviating(start, {share * of_one.amplitude, share * of_one.frequency});
    const auto less = map.deviating(start, {-share * of_one.amplitude, -share * of_one.frequency});
    if (!more || !less) return std::nullopt;
    return (*more - *less) / (2 * share);
}

// A cycle, with the covariance of what all disturbances add.
std::optional<Linear> cycle_from(DisturbedMap& map, const State& start) {
    auto cycle = map.linear(start);
    const Disturbance& disturbance = map.disturbance();
    for (const Deviations& cart :
         {Deviations{.amplitude = disturbance.amplitude}, Deviations{.frequency = disturbance.frequency}}) {
        if (!cycle || cart == Deviations{}) continue;
        const auto effect = effect_of(map, start, cart);
        if (!effect) return std::nullopt;
        cycle->covariance += *effect * effect->transpose();
    }
    return cycle;
}

// P = M P M^T + Q.
Matrix stationary(const Matrix& flow, const Matrix& added) {
    Eigen::Matrix4d system = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) system(i, j) -= flow(i / 2, j / 2) * flow(i % 2, j % 2);
    }
    const Eigen::Vector4d right(added(0, 0), added(0, 1), added(1, 0), added(1, 1));
    const Eigen::Vector4d solved = system.partialPivLu().solve(right);
    const double across = (solved[1] + solved[2]) / 2;
    return (Matrix() << solved[0], across, across, solved[3]).finished();
}

constexpr double is_there = 1e-7;  // relative; about what integrators miss a point by

// Disturbances may leave a direction out, as where a rigid stop holds the hammer for a while, or be weaker than
// rounding: a state counts as away once it is off by more than an engine's errors.
Matrix with_errors(Matrix covariance, const State& point) {
    const double error = is_there * (1 + point.norm());
    const double floor = 1e-12 * covariance.trace() + error * error;
    covariance(0, 0) += floor;
    covariance(1, 1) += floor;
    return covariance;
}

// The cycles of a closed motion, from one of its points on.
struct Round {
    std::vector<State> starts;
    std::vector<Linear> cycles;
    Matrix flow = Matrix::Identity();
    Matrix added = Matrix::Zero();  // covariance

    [[nodiscard]] State missed() const { return cycles.back().end - starts.front(); }
};

std::optional<Round> round_from(DisturbedMap& map, State state, int period) {
    Round round;
    for (int n = 0; n < period; ++n) {
        const auto cycle = cycle_from(map, state);
        if (!cycle) return std::nullopt;
        round.starts.push_back(state);
        round.cycles.push_back(*cycle);
        round.flow = cycle->jacobian * round.flow;
        round.added = cycle->jacobian * round.added * cycle->jacobian.transpose() + cycle->covariance;
        state = cycle->end;
    }
    return round;
}

// Newton's method from a point near an orbit: a point that is off would not be returned to. Nothing where it is
// no such point: an orbit of another engine may lack a small term.
std::optional<Round> closed_round(DisturbedMap& map, const State& near, int period) {
    constexpr double near_enough = 1e-5;  // relative
    constexpr double closed = 1e-11;
    constexpr double closed_by_integrators = 1e-7;
    constexpr int most_steps = 6;
    const double size = 1 + near.norm();
    auto round = round_from(map, near, period);
    if (!round || !(round->missed().norm() <= near_enough * size)) return std::nullopt;
    for (int n = 0; n < most_steps && round->missed().norm() > closed * size; ++n) {
        const State step = (Matrix::Identity() - round->flow).inverse() * round->missed();
        auto next = round_from(map, round->starts.front() + step, period);
        if (!next || !(next->missed().norm() < round->missed().norm())) break;
        round = std::move(next);
    }
    if (!(round->missed().norm() <= closed_by_integrators * size)) return std::nullopt;
    return round;
}

}  // namespace

std::optional<Home> Home::of(DisturbedMap& map, const State& at_phase_0, int period, double most_to_relax) {
    constexpr double rounding = 1e-9;
    const auto round = closed_round(map, at_phase_0, period);
    if (!round) return std::nullopt;
    const double multiplier =
        std::abs(trajectory::largest_multiplier(round->flow.trace() / 2, round->flow.determinant()));
    if (!(multiplier < 1 - rounding)) return std::nullopt;
    Home home;
    home.to_relax_ = -period / std::log(multiplier);
    if (home.to_relax_ > most_to_relax) return std::nullopt;
    Matrix covariance = stationary(round->flow, round->added);
    for (std::size_t i = 0; i < round->cycles.size(); ++i) {
        if (!covariance.allFinite()) return std::nullopt;
        const Matrix precision = with_errors(covariance, round->starts[i]).inverse();
        home.points_.push_back({round->starts[i], covariance, precision});
        home.spread_ = std::max(home.spread_, std::sqrt(covariance.trace()));
        const Linear& cycle = round->cycles[i];
        covariance = cycle.jacobian * covariance * cycle.jacobian.transpose() + cycle.covariance;
    }
    home.radius_ = home.find_radius(map);
    return home;
}

// From small to large, as another basin may lie between.
double Home::find_radius(DisturbedMap& map) {
    constexpr double largest = 2;
    constexpr double small = 1e-3;  // where the motion is linear
    constexpr double step = 4;
    double radius = largest;
    while (radius * spread_ > small) radius /= step;
    radius_ = radius;
    while (radius < largest && takes_back_from(map, step * radius)) radius_ = radius *= step;
    return radius;
}

// From states at this distance all around some of the points, outside of a rigid stop.
bool Home::takes_back_from(DisturbedMap& map, double distance) const {
    constexpr std::size_t fewest = 96;  // a basin with fingers is not seen by chance
    constexpr std::size_t fewest_of_point = 8;
    constexpr std::size_t most_points = 8;
    constexpr double patience = 10;  // few states of a basin may take long, by a chaotic transient
    const std::size_t apart = (points_.size() + most_points - 1) / most_points;
    const std::size_t directions = std::max(fewest_of_point, fewest / points_.size());
    std::vector<State> elsewhere;
    for (std::size_t i = 0; i < points_.size(); i += apart) {
        const Point& point = points_[i];
        const Matrix root = with_errors(point.covariance, point.state).llt().matrixL();
        for (std::size_t n = 0; n < directions; ++n) {
            const double angle =
                2 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(directions);
            State state = point.state + distance * root * State(std::cos(angle), std::sin(angle));
            if (map.has_rigid_stop()) state[0] = std::min(state[0], 0.0);
            if (!takes_back(map, state, elsewhere, patience).value_or(false)) return false;
        }
    }
    return true;
}

double Home::distance(const State& state) const {
    double least = std::numeric_limits<double>::infinity();
    if (!state.allFinite()) return least;
    for (const Point& point : points_) {
        const State off = state - point.state;
        least = std::min(least, off.dot(point.precision * off));
    }
    return std::sqrt(std::max(least, 0.0));
}

// As near as an engine's errors allow.
bool Home::is_at_a_point(const State& state) const {
    return std::ranges::any_of(points_, [&](const Point& point) {
        return (state - point.state).norm() < is_there * (1 + point.state.norm());
    });
}

std::optional<bool> Home::takes_back(DisturbedMap& map, State state, std::vector<State>& elsewhere,
                                     double times) const {
    constexpr double longest = 500;  // cycles, or more where small deviations shrink slowly
    constexpr double times_to_relax = 20;
    constexpr std::size_t periods = 16;  // up to which another motion is known by its return
    constexpr std::size_t most_known = 64;
    constexpr double attracted = 1e-5;                                     // relative
    const double same = std::min(1e-9, 1e-3 * spread_) / (1 + to_relax_);  // no slow approach is taken for one
    const auto most = static_cast<std::size_t>(times * std::max(longest, times_to_relax * to_relax_));
    std::array<State, periods> last;
    for (std::size_t n = 0; n < most; ++n) {
        if (!state.allFinite()) return false;
        if (distance(state) <= radius_ || is_at_a_point(state)) return true;
        const auto is_near = [&](const State& point) {
            return (state - point).norm() < attracted * (1 + point.norm());
        };
        if (std::ranges::any_of(elsewhere, is_near)) return false;
        const auto returns = [&](const State& before) { return (state - before).norm() < same; };
        if (n >= periods && std::ranges::any_of(last, returns)) {
            if (elsewhere.size() + periods <= most_known)
                elsewhere.insert(elsewhere.end(), last.begin(), last.end());
            return false;
        }
        last[n % periods] = state;
        const auto next = map.at_next_phase_0({state});
        if (!next) return std::nullopt;
        state = *next;
    }
    return false;
}

std::int64_t Home::returning(DisturbedMap& map, std::span<const State> states, RandomNumbers& random,
                             std::vector<State>& elsewhere) const {
    if (states.empty()) return 0;
    const State& one = states[random.below(states.size())];
    return takes_back(map, one, elsewhere).value_or(false) ? std::ssize(states) : 0;
}

}  // namespace peterka::noise
