#include "curves/free_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace peterka::curves {

namespace {

std::complex<double> response_of(const PlacedRig& rig) {
    const double eta = rig.frequency();
    return eta * eta / std::complex<double>(1 - eta * eta, 2 * rig.damping(false) * eta);
}

}  // namespace

PlanePoint on_way(const PlanePoint& from, const PlanePoint& to, double share) {
    return {from.column + share * (to.column - from.column), from.row + share * (to.row - from.row)};
}

// The hammer's amplitude P = eta^2/|1 - eta^2 + 2 i zeta eta| equals the gap g where
// s^2 (1 - g^2) + s g^2 (2 - 4 zeta^2) - g^2 = 0 with s = eta^2.
std::vector<double> frequencies_with_swing(const PlacedRig& rig) {
    const double g2 = rig.gap() * rig.gap();
    const double damping = rig.damping(false);
    const double b = g2 * (1 - 2 * damping * damping);     // half the middle coefficient
    const double root = std::sqrt(b * b + (1 - g2) * g2);  // NaN if no frequency reaches this amplitude
    std::vector<double> frequencies;
    // as quotients of the constant term: the textbook formula cancels for g near 1
    for (const double s : {g2 / (b + root), g2 / (b - root)}) {
        if (s > 0) frequencies.push_back(std::sqrt(s));
    }
    return frequencies;
}

double room_of_free_motion(const Rig& rig, const PlanePoint& place) {
    const PlacedRig here = rig.at(place);
    return here.gap() - std::abs(response_of(here));
}

std::optional<double> share_at_end_of_free_motion(const Rig& rig, const PlanePoint& from,
                                                  const PlanePoint& to) {
    const double first = room_of_free_motion(rig, from);
    const double last = room_of_free_motion(rig, to);
    const bool has_first = first > 0;
    if (!std::isfinite(first) || !std::isfinite(last) || has_first == (last > 0)) return std::nullopt;
    double low = 0;
    double high = 1;
    constexpr int halvings = 60;  // down to rounding
    for (int halving = 0; halving < halvings; ++halving) {
        const double middle = (low + high) / 2;
        ((room_of_free_motion(rig, on_way(from, to, middle)) > 0) == has_first ? low : high) = middle;
    }
    return (low + high) / 2;
}

std::optional<Seed> end_of_free_motion(const Rig& rig, const PlanePoint& from, const PlanePoint& to,
                                       const PlanePoint& window) {
    const auto share = share_at_end_of_free_motion(rig, from, to);
    if (!share) return std::nullopt;
    const PlanePoint place = on_way(from, to, *share);
    const PlacedRig here = rig.at(place);
    const double top = (std::numbers::pi / 2 - std::arg(response_of(here))) / here.frequency();
    const OrbitPoint guess{{1, {{EventKind::graze, false, top, 0}}}, place};
    const double size = std::max(std::abs(to.row - from.row), std::abs(to.column - from.column));
    const PlanePoint across{(to.row - from.row) / size, (from.column - to.column) / size};
    const auto found = solve(rig, guess, window, {Condition::on_line(place, across)});
    if (!found) return std::nullopt;
    return Seed{CurveKind::grazing, *found};
}

}  // namespace peterka::curves
