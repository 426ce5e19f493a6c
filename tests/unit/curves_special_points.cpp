// Special points of grazing curves, whose orbits are integrated again by elementary means: Runge-Kutta steps
// of the equation of motion with the stop's force as defined, without events, curves or the closed form.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "curves/follow.hpp"
#include "curves/trace_curve.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::curves {
namespace {

constexpr PlanePoint whole_window{4, 5};

scene::Oscillator<double> beam_of_170mm() {
    const double mass = 0.298;
    const double omega = 2 * std::numbers::pi * 4.5;
    scene::Oscillator<double> rig;
    rig.damping_ratio = 0.06 / (2 * mass * omega);
    rig.contact = scene::KelvinVoigt<double>{5.5e6 / (mass * omega * omega), 1.2e3 / (mass * omega)};
    rig.frequency = 1;
    return rig;
}

// A motion in time steps, from a touch on.
class PlainMotion {
  public:
    PlainMotion(const scene::Oscillator<double>& rig, const OrbitPoint& orbit)
        : damping_(rig.damping_ratio),
          stop_(std::get<scene::KelvinVoigt<double>>(rig.contact)),
          frequency_(orbit.place.column),
          gap_(orbit.place.row) {
        const auto touch = std::ranges::find(orbit.orbit.events, EventKind::touch, &Event::kind);
        time_ = touch->time;
        x_ = {0, touch->velocity};
        presses_ = true;
        presses_from_.push_back(x_);
        constexpr double before_it_comes_again = 1e-9;
        run_until(time_ + 2 * std::numbers::pi * static_cast<double>(orbit.orbit.period) / frequency_ -
                  before_it_comes_again);
        off_ = (x_ - State<double>(0, touch->velocity)).lpNorm<Eigen::Infinity>();
    }

    [[nodiscard]] double off() const { return off_; }  // after one period
    // Apexes of flights that just reach the stop, and minima of flights beyond its surface that just leave it.
    [[nodiscard]] std::int64_t touches_without_speed() const {
        const auto grazes = [](const State<double>& x) {
            return std::abs(x[0]) < 1e-9 && std::abs(x[1]) < 1e-6;
        };
        return std::ranges::count_if(tops_, grazes) + std::ranges::count_if(presses_from_, grazes);
    }
    [[nodiscard]] std::int64_t inflections_within(double size) const {
        return std::ranges::count_if(inflections_, [&](const State<double>& at) {
            return std::abs(at[0]) < size * size && std::abs(at[1]) < size;
        });
    }
    [[nodiscard]] std::int64_t impacts_faster_than(double speed) const {
        return std::ranges::count_if(presses_from_, [&](const State<double>& x) { return x[1] > speed; });
    }

  private:
    [[nodiscard]] double force(const State<double>& x) const {
        return stop_.stiffness * x[0] + stop_.damping * x[1];
    }
    [[nodiscard]] bool is_pressed(const State<double>& x) const { return x[0] > 0 && force(x) > 0; }
    [[nodiscard]] double free_acceleration(double time, const State<double>& x) const {
        return frequency_ * frequency_ * std::sin(frequency_ * time) - 2 * damping_ * x[1] - x[0] - gap_;
    }
    [[nodiscard]] State<double> slope(double time, const State<double>& x) const {
        return {x[1], free_acceleration(time, x) - (presses_ ? force(x) : 0)};
    }
    [[nodiscard]] State<double> after(double step) const {
        const State<double> a = slope(time_, x_);
        const State<double> b = slope(time_ + step / 2, x_ + step / 2 * a);
        const State<double> c = slope(time_ + step / 2, x_ + step / 2 * b);
        const State<double> d = slope(time_ + step, x_ + step * c);
        return x_ + step / 6 * (a + 2 * b + 2 * c + d);
    }
    // The fraction of a step after which a predicate has changed.
    template <class Changed>
    [[nodiscard]] double part_until(double step, const Changed& changed) const {
        double before = 0;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = (before + step) / 2;
            (changed(middle, after(middle)) ? step : before) = middle;
        }
        return step;
    }

    void run_until(double end) {
        while (time_ < end) {
            double step = std::min(presses_ ? 2e-6 : 1e-4, end - time_);
            const auto switches = [&](double, const State<double>& x) { return is_pressed(x) != presses_; };
            const bool will_switch = switches(step, after(step));
            if (will_switch) step = part_until(step, switches);
            if (!presses_) note(step);
            x_ = after(step);
            time_ += step;
            if (!will_switch) continue;
            presses_ = !presses_;
            if (presses_) presses_from_.push_back(x_);
        }
    }

    void note(double step) {
        const State<double> next = after(step);
        if (x_[1] > 0 && next[1] <= 0) {
            const auto falls = [](double, const State<double>& x) { return x[1] <= 0; };
            tops_.push_back(after(part_until(step, falls)));
        }
        const bool rises = free_acceleration(time_, x_) > 0;
        const auto turns = [&](double later, const State<double>& x) {
            return (free_acceleration(time_ + later, x) > 0) != rises;
        };
        if (turns(step, next)) inflections_.push_back(after(part_until(step, turns)));
    }

    double damping_;
    scene::KelvinVoigt<double> stop_;
    double frequency_;
    double gap_;
    double time_ = 0;
    State<double> x_ = State<double>::Zero();
    bool presses_ = false;
    double off_ = 0;
    std::vector<State<double>> tops_;
    std::vector<State<double>> inflections_;
    std::vector<State<double>> presses_from_;
};

// The grazing curve crossed between a point where the motion from rest is stable and another point.
Curve grazing_curve(const PlanePoint& from, const PlanePoint& to, std::int64_t period) {
    scene::Oscillator<double> oscillator = beam_of_170mm();
    oscillator.frequency = from.column;
    oscillator.gap = from.row;
    const trajectory::ExactCycleMap<double> map(oscillator);
    State<double> x(-from.row, -from.column);
    for (int cycle = 0; cycle < 4000; ++cycle) x = map(x).end;
    const Rig rig(oscillator);
    const auto orbit = stable_orbit_near(rig, from, x, period, whole_window);
    EXPECT_TRUE(orbit);
    if (!orbit) return {};
    const auto seed = follow(rig, *orbit, to, whole_window).seed;
    EXPECT_TRUE(seed && seed->kind == CurveKind::grazing);
    return seed ? trace_curve(rig, *seed, {{0.5, 0}, {4.5, 5}}) : Curve{};
}

// The orbit at the first special point of this kind.
OrbitPoint orbit_at_special(const Curve& curve, SpecialKind kind) {
    const auto special = std::ranges::find(curve.specials, kind, &Special::kind);
    if (special == curve.specials.end()) {
        ADD_FAILURE() << "no such point";
        return {};
    }
    const auto point = std::ranges::find_if(curve.points, [&](const CurvePoint& each) {
        return each.place.column == special->place.column && each.place.row == special->place.row;
    });
    return {point->orbit, special->place};
}

// A cell of a 128 by 128 map.
PlanePoint cell(int column, int row) {
    return {0.5 + 4.0 * column / 127, 5.0 * row / 127};
}

TEST(CurvesSpecialPoints, WhereTwoGrazingsMeetTheOrbitTouchesTwiceWithoutSpeed) {
    const Curve curve = grazing_curve(cell(78, 2), cell(79, 2), 2);
    const OrbitPoint orbit = orbit_at_special(curve, SpecialKind::double_grazing);
    const PlainMotion motion(beam_of_170mm(), orbit);
    EXPECT_LT(motion.off(), 1e-7);
    EXPECT_EQ(motion.touches_without_speed(), 2);
    EXPECT_EQ(motion.impacts_faster_than(1e-3), orbit.orbit.impacts());
    for (const std::size_t other : {curve.points.size() / 3, curve.points.size() / 2}) {
        const PlainMotion along(beam_of_170mm(), {curve.points[other].orbit, curve.points[other].place});
        EXPECT_LT(along.off(), 1e-7);
        EXPECT_EQ(along.touches_without_speed(), 1);
    }
}

// Multipliers 1 and -1, or a pair on the unit circle, would require |det M| = 1.
TEST(CurvesSpecialPoints, NoOrbitHasTwoMultipliersOnTheUnitCircle) {
    const Curve curve = grazing_curve(cell(78, 2), cell(79, 2), 2);
    const Rig rig(beam_of_170mm());
    ASSERT_GT(curve.points.size(), 20U);
    for (const CurvePoint& point : curve.points) {
        for (const Side side : {Side::without_impact, Side::with_impact}) {
            const Monodromy product = monodromy(rig, point.orbit, point.place, side);
            EXPECT_LT(std::abs(product.determinant), 0.5);
            EXPECT_NEAR(product.matrix.determinant(), product.determinant, 1e-9 * product.matrix.squaredNorm());
        }
    }
}

TEST(CurvesSpecialPoints, AGrazingWithoutAccelerationIsAnInflectionOfTheFlight) {
    const Curve curve = grazing_curve(cell(60, 38), cell(61, 38), 2);
    const OrbitPoint orbit = orbit_at_special(curve, SpecialKind::inflection);
    const PlainMotion motion(beam_of_170mm(), orbit);
    EXPECT_LT(motion.off(), 1e-7);
    EXPECT_EQ(motion.inflections_within(1e-5), 1);
    EXPECT_EQ(motion.impacts_faster_than(1e-3), orbit.orbit.impacts());
    const std::size_t middle = curve.points.size() / 2;
    const PlainMotion along(beam_of_170mm(), {curve.points[middle].orbit, curve.points[middle].place});
    EXPECT_EQ(along.inflections_within(1e-5), 0);
    EXPECT_EQ(along.touches_without_speed(), 1);
}

}  // namespace
}  // namespace peterka::curves
