// The monodromy matrix M against differences of the stroboscopic map in extended precision, and the
// derivatives of det(M - sign I) against its differences.
#include "curves/monodromy.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <optional>

#include "curves/defining_system.hpp"
#include "curves/follow.hpp"
#include "curves/stroboscopic.hpp"
#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::curves {
namespace {

constexpr PlanePoint plane{4, 5};

template <class Contact>
scene::Oscillator<double> rig_with_stop(const Contact& contact, double damping_ratio) {
    scene::Oscillator<double> rig = testing::paper_rig(testing::beam_170mm, 1, 0);
    rig.damping_ratio = damping_ratio;
    rig.contact = contact;
    return rig;
}

template <class Map>
std::optional<OrbitPoint> settled_orbit(scene::Oscillator<double> oscillator, const PlanePoint& place,
                                        std::int64_t period) {
    oscillator.frequency = place.column;
    oscillator.gap = place.row;
    const Map map(oscillator);
    State<double> x(-1 - place.row, 0);
    for (int cycle = 0; cycle < 2000; ++cycle) x = map(x).end;
    return stable_orbit_near(Rig(oscillator), place, x, period, plane);
}

// For the map of q cycles, from the orbit's state at phase 0.
template <class Map, class Contact>
Jacobian<double> by_differences(const scene::Oscillator<double>& rig, const Contact& contact,
                                const OrbitPoint& point) {
    scene::Oscillator<long double> same;
    same.damping_ratio = rig.damping_ratio;
    same.contact = contact;
    same.frequency = point.place.column;
    same.gap = point.place.row;
    const Map map(same);
    const auto first = stroboscopic_states(Rig(rig), point).front().state.template cast<long double>().eval();
    const auto after = [&](scene::State<long double> x) {
        for (std::int64_t cycle = 0; cycle < point.orbit.period; ++cycle) x = map(x).end;
        return x;
    };
    constexpr long double step = 1e-7L;
    Jacobian<double> jacobian;
    for (int axis = 0; axis < 2; ++axis) {
        scene::State<long double> aside = scene::State<long double>::Zero();
        aside[axis] = step;
        const scene::State<long double> slope = (after(first + aside) - after(first - aside)) / (2 * step);
        jacobian.col(axis) = slope.cast<double>();
    }
    return jacobian;
}

// With another event as the first, M is similar: trace and determinant are the same.
void expect_same_growth(const Monodromy& product, const Jacobian<double>& jacobian) {
    const double size = jacobian.norm();
    EXPECT_NEAR(product.matrix.trace(), jacobian.trace(), 1e-6 * size);
    EXPECT_NEAR(product.determinant, jacobian.determinant(), 1e-6 * size * size);
    EXPECT_NEAR(product.determinant, product.matrix.determinant(), 1e-9 * size * size);
    const double half = jacobian.trace() / 2;
    const std::complex<double> root = std::sqrt(std::complex<double>(half * half - jacobian.determinant()));
    const std::complex<double> largest = half < 0 ? half - root : half + root;
    EXPECT_NEAR(std::abs(product.multiplier()), std::abs(largest), 1e-5 * size);
    EXPECT_EQ(product.multiplier() < 0, largest.real() < 0);
    for (const int sign : {1, -1}) {
        const Jacobian<double> rest = jacobian - sign * Jacobian<double>::Identity();
        EXPECT_NEAR(product.bifurcation(sign), rest.determinant(), 1e-6 * (1 + size));
    }
}

TEST(Monodromy, OfASpringDashpotStopIsTheJacobianOfItsCycles) {
    const auto stop = testing::paper_rig(testing::beam_170mm, 1, 0).kelvin_voigt();
    const scene::KelvinVoigt<long double> same{stop.stiffness, stop.damping};
    const auto rig = rig_with_stop(stop, 0.0036);
    struct Known {
        PlanePoint place;
        std::int64_t period;
    };
    for (const Known& known : {Known{{2, 0}, 1}, Known{{2.75, 0}, 2}, Known{{1.3, 1}, 1}}) {
        SCOPED_TRACE(known.place.column);
        const auto point = settled_orbit<trajectory::ExactCycleMap<double>>(rig, known.place, known.period);
        ASSERT_TRUE(point.has_value());
        expect_same_growth(monodromy(Rig(rig), point->orbit, point->place, Side::without_impact),
                           by_differences<trajectory::ExactCycleMap<long double>>(rig, same, *point));
    }
}

TEST(Monodromy, OfARigidStopIsTheJacobianOfItsCycles) {
    const auto rig = rig_with_stop(scene::Restitution<double>{0.6}, 0.02);
    for (const PlanePoint& place : {PlanePoint{2, 0}, PlanePoint{2, 0.4}, PlanePoint{2.2, 0.2}}) {
        SCOPED_TRACE(place.row);
        const auto point = settled_orbit<trajectory::RigidExactMap<double>>(rig, place, 1);
        ASSERT_TRUE(point.has_value());
        expect_same_growth(monodromy(Rig(rig), point->orbit, point->place, Side::without_impact),
                           by_differences<trajectory::RigidExactMap<long double>>(
                               rig, scene::Restitution<long double>{0.6}, *point));
    }
}

// At a period doubling, where the value is 0 and its scale is therefore irrelevant.
void expect_derivatives_at_doubling(const scene::Oscillator<double>& rig, const OrbitPoint& stable,
                                    const PlanePoint& beyond) {
    const Rig rigs(rig);
    const FollowedOrbit followed = follow(rigs, stable, beyond, plane);
    ASSERT_TRUE(followed.seed.has_value());
    ASSERT_EQ(followed.seed->kind, CurveKind::period_doubling);
    const OrbitPoint& point = followed.seed->point;
    const auto value_at = [&](const OrbitPoint& at) {
        return bifurcation(rigs.at(at.place), at.orbit, -1, Side::without_impact).value;
    };
    const Bifurcation at = bifurcation(rigs.at(point.place), point.orbit, -1, Side::without_impact);
    EXPECT_NEAR(at.value, 0, 1e-8);
    const Unknowns unknowns(point.orbit);
    constexpr double step = 1e-6;
    for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
        OrbitPoint up = point;
        OrbitPoint down = point;
        move(up, step * Eigen::VectorXd::Unit(unknowns.size(), i));
        move(down, -step * Eigen::VectorXd::Unit(unknowns.size(), i));
        const double slope = (value_at(up) - value_at(down)) / (2 * step);
        EXPECT_NEAR(at.gradient[i], slope, 1e-6 * (1 + at.gradient.norm())) << i;
    }
}

TEST(Monodromy, DerivativesOfABifurcationAreItsDifferences) {
    const auto stop = testing::paper_rig(testing::beam_170mm, 1, 0).kelvin_voigt();
    const auto soft =
        rig_with_stop(scene::KelvinVoigt<double>{stop.stiffness / 1000, stop.damping / 30}, 0.0036);
    const auto point = settled_orbit<trajectory::ExactCycleMap<double>>(soft, {2, 0}, 1);
    ASSERT_TRUE(point.has_value());
    expect_derivatives_at_doubling(soft, *point, {3.5, 0});
    const auto rigid = rig_with_stop(scene::Restitution<double>{0.6}, 0.02);
    const auto struck = settled_orbit<trajectory::RigidExactMap<double>>(rigid, {2, 0.1}, 1);
    ASSERT_TRUE(struck.has_value());
    expect_derivatives_at_doubling(rigid, *struck, {3.5, 0.1});
}

// A strong dashpot makes M grow, so that its eigenvalues are far from the unit circle; with terms as large as
// M's factors, the test function would be so, too.
TEST(Monodromy, ABifurcationIsOfOrderOneHoweverStrongTheImpacts) {
    for (const double damping : {1.0, 1e2, 1e4}) {
        const auto oscillator = rig_with_stop(scene::KelvinVoigt<double>{100, damping}, 0.01);
        const Rig rigs(oscillator);
        const PlanePoint place{1.5, 0};
        const Orbit orbit{1, {{EventKind::touch, true, 0.3, 1}, {EventKind::release, false, 0.3 + 1e-6, -1}}};
        const double size = damping;  // of the saltation matrix at the touch
        for (const int sign : {1, -1}) {
            const double value = bifurcation(rigs.at(place), orbit, sign, Side::without_impact).value;
            EXPECT_LT(std::abs(value), 4);
            EXPECT_GT(std::abs(value), 0.01);
            const double whole = monodromy(rigs, orbit, place, Side::without_impact).bifurcation(sign);
            EXPECT_EQ(value > 0, whole > 0);
            EXPECT_LT(std::abs(value), 4 * std::abs(whole) / size);
        }
    }
}

// Each of many bounces is slower than the one before. With each over the largest speed, the value would be the
// product of all these ratios, and anything would count as a period doubling. Of 120 the factors' sizes alone,
// multiplied, are a million times the value.
TEST(Monodromy, ABifurcationIsOfOrderOneHoweverWeakTheImpacts) {
    struct Case {
        double restitution;
        int bounces;
        double least;
    };
    for (const auto& [restitution, bounces, least] :
         {Case{0.54, 1, 0.01}, Case{0.54, 12, 0.01}, Case{0.9, 120, 1e-6}}) {
        const auto oscillator = rig_with_stop(scene::Restitution<double>{restitution}, 0.08);
        const Rig rigs(oscillator);
        const PlanePoint place{0.45, 0.1};
        Orbit orbit{1, {}};
        double time = 4;
        double speed = 1;
        for (int n = 0; n < bounces; ++n) {
            orbit.events.push_back({EventKind::touch, false, time, speed});
            time += 2 * restitution * speed;
            speed *= restitution;
        }
        for (const int sign : {1, -1}) {
            const double value = bifurcation(rigs.at(place), orbit, sign, Side::without_impact).value;
            EXPECT_LT(std::abs(value), 4);
            EXPECT_GT(std::abs(value), least) << bounces;
            const double whole = monodromy(rigs, orbit, place, Side::without_impact).bifurcation(sign);
            EXPECT_EQ(value > 0, whole > 0);
        }
    }
}

}  // namespace
}  // namespace peterka::curves
