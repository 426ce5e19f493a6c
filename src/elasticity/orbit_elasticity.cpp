#include "elasticity/orbit_elasticity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "certificate/bends.hpp"
#include "certificate/chatter.hpp"
#include "scene/scales.hpp"

namespace peterka::elasticity {
namespace {

using certificate::EventChain;
using certificate::EventKind;
using certificate::Interval;
using certificate::Leg;
using certificate::Matrix;
using certificate::Place;
using certificate::RigOf;
using certificate::Springs;
using certificate::Vector;

constexpr Vector<double> at_rest{0, 0};

RigOf<Dual> variable(const RigOf<double>& rig) {
    RigOf<Dual> numbers;
    numbers.damping_ratio = {rig.damping_ratio, RigNumber::damping_ratio};
    numbers.frequency = {rig.frequency, RigNumber::frequency};
    numbers.period = Dual(rig.period * rig.frequency) / numbers.frequency;
    numbers.gap = {rig.gap, RigNumber::gap};
    numbers.cubic = {rig.cubic, RigNumber::cubic};
    numbers.absolute = rig.absolute;
    numbers.rigid = rig.rigid;
    if (rig.rigid) {
        numbers.restitution = {rig.restitution, RigNumber::stiffness};
    } else {
        numbers.stiffness = {rig.stiffness, RigNumber::stiffness};
        numbers.damping = {rig.damping, RigNumber::damping};
    }
    return numbers;
}

// An orbit's chain of events, with the lift-off after chatter, if there is one, in both springs.
class SolvedOrbit {
  public:
    SolvedOrbit(const certificate::Rig& rig, const certificate::StroboscopicOrbit& orbit)
        : springs_(certificate::middle(rig)), dual_(variable(springs_.rig)) {
        chain_ = certificate::find_chain(springs_, orbit);
        const bool matches =
            chain_ ? chain_->impacts() == orbit.impacts : rig.rigid && finds_chatter(rig, orbit);
        if (!matches) chain_.reset();
    }

    [[nodiscard]] std::optional<OrbitElasticity> elasticity() const {
        if (!chain_ || !(determinant_of_return() >= least_determinant)) return std::nullopt;
        const Dual largest = largest_of(places());
        OrbitElasticity result{largest.value, {}};
        const RigOf<double>& rig = springs_.rig;
        const std::array<double, rig_numbers> values{
            rig.frequency, rig.gap,  rig.damping_ratio, rig.rigid ? rig.restitution : rig.stiffness,
            rig.damping,   rig.cubic};
        for (std::size_t i = 0; i < rig_numbers; ++i)
            result.by_rig_numbers[i] = values[i] * largest.slopes[i] / largest.value;
        if (!std::ranges::all_of(result.by_rig_numbers, [](double x) { return std::isfinite(x); }))
            return std::nullopt;
        return result;
    }

  private:
    bool finds_chatter(const certificate::Rig& rig, const certificate::StroboscopicOrbit& orbit) {
        Springs<Interval> enclosed(rig);
        if (!find_lift_off(enclosed)) return false;
        const double time = springs_.lift_off = enclosed.lift_off.middle();
        chain_ = find_chatter(enclosed, springs_, orbit);
        if (!chain_) return false;
        dual_.lift_off = time;  // whose shift doesn't matter: the hammer leaves from rest, without acceleration
        std::vector<Place<Interval>> places;
        for (const certificate::Event& event : chain_->events) places.push_back({event.time, event.along});
        return impacts_with_chatter(enclosed, *chain_, places) == orbit.impacts;
    }

    // det(I - M): 1 - tr M + det M. Chatter ends in one state, whatever came before: M = 0.
    [[nodiscard]] double determinant_of_return() const {
        if (chain_->events.front().kind == EventKind::lift_off) return 1;
        const std::vector<Place<double>> places = places_of(*chain_);
        const RigOf<double>& rig = springs_.rig;
        Matrix<double> product;
        double determinant = 1;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (chain_->events[i].kind == EventKind::touch) {
                product = Matrix<double>{1, 0, -rig.damping, 1} * product;
            } else if (chain_->events[i].kind == EventKind::bounce) {
                const double r = rig.restitution;
                const double sine = std::sin(rig.frequency * places[i].time);
                const double pressing = springs_.flight.acceleration(at_rest, sine);
                product = Matrix<double>{-r, 0, (1 + r) * pressing / places[i].along, -r} * product;
                determinant *= r * r;
            }
            const auto [leg, length] = leg_of(springs_, *chain_, places, i);
            product = leg.flow(length) * product;
            determinant *= std::exp(-springs_.phase(chain_->presses(i)).damping() * length);
        }
        return 1 - product.a - product.d + determinant;
    }

    // The unknowns with their derivatives.
    [[nodiscard]] std::vector<Place<Dual>> places() const {
        std::vector<Place<Dual>> places;
        for (const certificate::Event& event : chain_->events) places.push_back({event.time, event.along});
        const auto size = static_cast<Eigen::Index>(2 * places.size());
        Eigen::MatrixXd by_numbers(size, static_cast<Eigen::Index>(rig_numbers));
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Vector<Dual> residual = leg_residual(dual_, *chain_, places, i);
            const auto row = static_cast<Eigen::Index>(2 * i);
            for (std::size_t number = 0; number < rig_numbers; ++number) {
                const auto column = static_cast<Eigen::Index>(number);
                by_numbers(row, column) = residual.position.slopes[number];
                by_numbers(row + 1, column) = residual.velocity.slopes[number];
            }
        }
        const Eigen::MatrixXd moves =
            -equations_in_doubles(springs_, *chain_).derivatives.partialPivLu().solve(by_numbers);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto row = static_cast<Eigen::Index>(2 * i);
            for (std::size_t number = 0; number < rig_numbers; ++number) {
                const auto column = static_cast<Eigen::Index>(number);
                places[i].time.slopes[number] = moves(row, column);
                places[i].along.slopes[number] = moves(row + 1, column);
            }
        }
        return places;
    }

    [[nodiscard]] Dual largest_of(const std::vector<Place<Dual>>& places) const {
        Dual largest;
        const auto take = [&](const Dual& one) {
            if (one.value > largest.value) largest = one;
        };
        const std::vector<Place<double>> points = places_of(*chain_);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (springs_.rig.rigid) {
                take(places[i].along);
            } else if (chain_->events[i].kind == EventKind::touch) {
                take(dual_.rig.damping * places[i].along);
            }
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!chain_->presses(i)) continue;
            const auto [leg, length] = leg_of(springs_, *chain_, points, i);
            const std::optional<double> offset = maximum_in(leg, length, largest.value);
            if (!offset) continue;
            take(dual_.force(leg_of(dual_, *chain_, places, i).leg.at(*offset).state));
        }
        return largest;
    }

    // Force and slope at an offset of a contact.
    struct Force {
        double value;
        double slope;
    };
    [[nodiscard]] Force force_at(const Leg<double>& leg, double offset) const {
        const auto moment = leg.at(offset);
        const double acceleration = leg.phase().acceleration(moment.state, moment.angle.sine);
        return {springs_.force(moment.state), springs_.force({moment.state.velocity, acceleration})};
    }

    // Where the force of a contact is largest, after its begin and above `least`. Looks ten times in the
    // shortest time that its phase knows.
    [[nodiscard]] std::optional<double> maximum_in(const Leg<double>& leg, double length, double least) const {
        const double step = 0.1 * short_time(leg.phase());
        std::optional<double> best;
        Force before = force_at(leg, 0);
        for (double from = 0; from < length; from += step) {
            const double to = std::min(from + step, length);
            const Force now = force_at(leg, to);
            if (before.slope > 0 && now.slope <= 0) {
                const double offset = top_between(leg, from, to);
                const double force = force_at(leg, offset).value;
                if (force > least) {
                    best = offset;
                    least = force;
                }
            }
            before = now;
        }
        return best;
    }

    [[nodiscard]] double top_between(const Leg<double>& leg, double low, double high) const {
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            if (!(low < middle && middle < high)) break;
            (force_at(leg, middle).slope > 0 ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    Springs<double> springs_;
    Springs<Dual> dual_;
    std::optional<EventChain> chain_;
};

// The numbers of a rig that has its place in Hz and m, and the unit of force or speed.
struct Monomials {
    std::array<double, rig_numbers> rig{};
    double unit = 0;
};

Monomials monomials_of(const job::CellNumbers& numbers) {
    const scene::Oscillator<double> oscillator = scene::oscillator_of(numbers);
    const scene::Scales scales = scene::scales_of(numbers);
    const auto* stop = oscillator.spring_dashpot();
    return {{numbers.frequency_ratio(), numbers.gap_ratio(), oscillator.damping_ratio,
             stop != nullptr ? stop->stiffness : oscillator.restitution().coefficient,
             stop != nullptr ? stop->damping : 0, oscillator.cubic},
            stop != nullptr ? scales.force_n : scales.length_m * scales.frequency_rad_per_s};
}

}  // namespace

std::optional<OrbitElasticity> orbit_elasticity(const job::CellNumbers& numbers,
                                                const certificate::StroboscopicOrbit& orbit) {
    const std::optional<certificate::Rig> rig = certificate::rig_of(numbers);
    if (!rig || orbit.period < 1) return std::nullopt;
    return SolvedOrbit(*rig, orbit).elasticity();
}

// All of them are products of powers of the job's numbers, whose exponents a factor of 2 tells exactly.
double elasticity_by(std::string_view key, const job::CellNumbers& numbers, const OrbitElasticity& of_orbit) {
    job::CellNumbers own = numbers;
    own.place.frequency_hz = number_of(numbers, "frequency_hz");
    own.place.gap_m = number_of(numbers, "gap_m");
    const double value = number_of(own, key);
    if (value == 0) return 0;
    job::CellNumbers doubled = own;
    set_number(doubled, key, 2 * value);
    const Monomials before = monomials_of(own);
    const Monomials after = monomials_of(doubled);
    double sum = std::log2(after.unit / before.unit);
    for (std::size_t i = 0; i < rig_numbers; ++i) {
        if (before.rig[i] != 0) sum += of_orbit.by_rig_numbers[i] * std::log2(after.rig[i] / before.rig[i]);
    }
    return sum;
}

}  // namespace peterka::elasticity
