// Curves at limits known independently: formulas, an independent simulation of the model, other engines.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "curves/follow.hpp"
#include "curves/free_motion.hpp"
#include "curves/trace_curve.hpp"
#include "regime/steady_state.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::curves {
namespace {

const PlanePoint window{4, 5};

// Beam springs of 170 mm, with the paper's printed numbers.
scene::Oscillator<double> rig_170mm() {
    const double mass = 0.298;
    const double omega = 2 * std::numbers::pi * 4.5;
    scene::Oscillator<double> rig;
    rig.damping_ratio = 0.06 / (2 * mass * omega);
    rig.contact = scene::KelvinVoigt<double>{5.5e6 / (mass * omega * omega), 1.2e3 / (mass * omega)};
    rig.frequency = 1;
    return rig;
}

scene::Oscillator<double> rigid_rig() {
    scene::Oscillator<double> rig;
    rig.damping_ratio = 0.02;
    rig.contact = scene::Restitution<double>{0.6};
    rig.frequency = 1;
    return rig;
}

template <class Map>
std::optional<OrbitPoint> orbit_at(scene::Oscillator<double> oscillator, const PlanePoint& place,
                                   std::int64_t period, const State<double>& start = {0, 0}) {
    oscillator.frequency = place.column;
    oscillator.gap = place.row;
    const Map map(oscillator);
    State<double> x(start[0] - place.row, start[1] - place.column);
    for (int cycle = 0; cycle < 2000; ++cycle) x = map(x).end;
    return stable_orbit_near(Rig(oscillator), place, x, period, window);
}

Seed edge(const scene::Oscillator<double>& oscillator, const PlanePoint& from, const PlanePoint& to,
          const State<double>& start = {0, 0}) {
    const bool rigid = std::holds_alternative<scene::Restitution<double>>(oscillator.contact);
    const auto orbit = rigid
                           ? orbit_at<trajectory::RigidExactMap<double>>(oscillator, from, 1, {-1, from.column})
                           : orbit_at<trajectory::ExactCycleMap<double>>(oscillator, from, 1, start);
    EXPECT_TRUE(orbit);
    const FollowedOrbit followed = follow(Rig(oscillator), *orbit, to, window);
    EXPECT_TRUE(followed.seed);
    return *followed.seed;
}

regime::CellResult by_cvode(const PlanePoint& place, const State<double>& start = {0, 0}) {
    scene::Oscillator<double> oscillator = rig_170mm();
    oscillator.frequency = place.column;
    oscillator.gap = place.row;
    return regime::find_steady_state(oscillator, {start[0] - place.row, start[1] - place.column}, {},
                                     {.engine = regime::Engine::cvode, .tolerance = 1e-9});
}

std::pair<int, int> label(const regime::CellResult& cell) {
    return {cell.impacts, cell.period};
}

// Reference values from an independent long-double program.
TEST(Curves, LimitsOf11OnThe170mmRig) {
    const auto rig = rig_170mm();
    struct Known {
        PlanePoint from;
        PlanePoint to;
        State<double> start;
        CurveKind kind;
        double frequency;
    };
    for (const Known& known : {Known{{2, 0}, {3, 0}, {0, 0}, CurveKind::period_doubling, 2.659361979},
                               Known{{2, 1}, {3, 1}, {0, 0}, CurveKind::period_doubling, 2.264326891},
                               Known{{1, 1}, {0.5, 1}, {0, 0}, CurveKind::period_doubling, 0.718391067},
                               Known{{1.6, 1.5}, {2.2, 1.5}, {-1, 2}, CurveKind::fold, 1.862464993},
                               Known{{1.3, 0}, {0.9, 0}, {0, 0}, CurveKind::grazing, 1.15008754}}) {
        const Seed seed = edge(rig, known.from, known.to, known.start);
        EXPECT_EQ(seed.kind, known.kind);
        EXPECT_NEAR(seed.point.place.column, known.frequency, 1e-8);
        EXPECT_LE(curve_point(Rig(rig), seed.point, seed.kind).residual, largest_residual);
    }
}

// Its multiplier reaches 1 there and turns back; beyond, the same orbit follows with its halves interchanged.
TEST(Curves, ADoubledOrbitEndsWhereItMergesWithTheOneThatDoubled) {
    const auto rig = rig_170mm();
    for (const double frequency : {2.67323, 2.66, 2.7}) {
        const auto orbit = orbit_at<trajectory::ExactCycleMap<double>>(rig, {frequency, 0}, 2);
        ASSERT_TRUE(orbit);
        const FollowedOrbit followed = follow(Rig(rig), *orbit, {2.6, 0}, window);
        ASSERT_TRUE(followed.seed);
        EXPECT_EQ(followed.seed->kind, CurveKind::period_doubling);
        EXPECT_EQ(followed.seed->point.orbit.period, 1);
        EXPECT_NEAR(followed.seed->point.place.column, 2.659361979, 1e-8);
    }
}

// Two that cancel: 3/1 of this rig doubles its period, and 6/2 merges back shortly after.
TEST(Curves, ALongStepDoesNotPassOverADoublingAndItsReverse) {
    scene::Oscillator<double> rig = rig_170mm();
    const double unit = 0.298 * 2 * std::numbers::pi * 4.5;
    rig.damping_ratio = 0.013864002082350675;
    rig.contact = scene::KelvinVoigt<double>{197625.9147313871 / (unit * 2 * std::numbers::pi * 4.5),
                                             74.96898401790209 / unit};
    const PlanePoint from{0.6140930714272375, -0.009472110829916669};
    const auto orbit = orbit_at<trajectory::ExactCycleMap<double>>(rig, from, 1);
    ASSERT_TRUE(orbit);
    ASSERT_EQ(orbit->orbit.impacts(), 3);
    const auto any_step = [](const OrbitPoint&, const OrbitPoint&, const PlanePoint&) { return true; };
    for (const double to : {0.64, 0.7, 1.0, 3.0}) {
        const FollowedOrbit followed = follow(Rig(rig), *orbit, {to, from.row}, {3, 3}, any_step);
        ASSERT_TRUE(followed.seed);
        EXPECT_EQ(followed.seed->kind, CurveKind::period_doubling);
        EXPECT_NEAR(followed.seed->point.place.column - from.column, 0.0088, 2e-4) << to;
    }
}

// 4/2 whose last contact is renewed from 2.8018 on, and from 2.80213 to 2.80216 becomes two impacts. Expected
// is where labels of a sweep with 20,001 points change.
TEST(Curves, ALongStepDoesNotPassOverAnImpactThatARenewedContactBecomes) {
    const auto rig = rig_170mm();
    const PlanePoint from{2.7992125984251968, 0.6692913385826772};
    const auto orbit = orbit_at<trajectory::ExactCycleMap<double>>(rig, from, 2);
    ASSERT_TRUE(orbit);
    ASSERT_EQ(orbit->orbit.impacts(), 4);
    const auto any_step = [](const OrbitPoint&, const OrbitPoint&, const PlanePoint&) { return true; };
    for (const double to : {2.803, 2.81, 3.0, 4.5}) {
        const FollowedOrbit followed = follow(Rig(rig), *orbit, {to, from.row}, window, any_step);
        ASSERT_TRUE(followed.seed);
        EXPECT_EQ(followed.seed->kind, CurveKind::grazing);
        EXPECT_NEAR(followed.seed->point.place.column - from.column, 0.002916, 2e-6) << to;
    }
}

TEST(Curves, PeriodDoublingOfARigidStop) {
    const auto rig = rigid_rig();
    EXPECT_NEAR(edge(rig, {2, 0}, {3, 0}).point.place.column, 2.6609482425529, 1e-9);
    EXPECT_NEAR(edge(rig, {2, 0.5}, {3, 0.5}).point.place.column, 2.494678798104, 1e-9);
}

// alpha^2 V^2 + ... has a double root at g = P sqrt(1 + alpha^2 eta^2 / (r + beta)^2).
TEST(Curves, FoldOfARigidStopInClosedForm) {
    const double eta = 1.7;
    const double r = 0.6;
    const double zeta = 0.02;
    const Seed seed = edge(rigid_rig(), {eta, 1.0}, {eta, 4.0});
    ASSERT_EQ(seed.kind, CurveKind::fold);
    const double turn = 2 * std::numbers::pi / eta;
    const double nu = std::sqrt(1 - zeta * zeta);
    const double decay = std::exp(-zeta * turn);
    Eigen::Matrix2d flow;
    flow << decay * (std::cos(nu * turn) + zeta / nu * std::sin(nu * turn)), decay * std::sin(nu * turn) / nu,
        -decay * std::sin(nu * turn) / nu, decay * (std::cos(nu * turn) - zeta / nu * std::sin(nu * turn));
    const Eigen::Matrix2d inverse = (flow - Eigen::Matrix2d::Identity()).inverse();
    const double alpha = (1 + r) * inverse(0, 1);
    const double beta = (1 + r) * inverse(1, 1);
    const double reach = eta * eta / std::hypot(1 - eta * eta, 2 * zeta * eta);
    EXPECT_NEAR(seed.point.place.row, reach * std::hypot(1, alpha * eta / (r + beta)), 1e-9);
}

TEST(Curves, MotionWithoutImpactEndsWhereItsSwingReachesTheStop) {
    const auto rig = rig_170mm();
    const auto seed = end_of_free_motion(Rig(rig), {3.0, 0.0}, {3.0, 5.0}, window);
    ASSERT_TRUE(seed);
    const Curve curve = trace_curve(Rig(rig), *seed, {{0.5, 0}, {4.5, 5}});
    ASSERT_GT(curve.points.size(), 50U);
    EXPECT_EQ(curve.impacts, 0);
    for (const CurvePoint& point : curve.points) {
        const double eta = point.place.column;
        EXPECT_NEAR(point.place.row, eta * eta / std::hypot(1 - eta * eta, 2 * rig.damping_ratio * eta), 1e-11);
        EXPECT_LE(point.residual, largest_residual);
    }
}

// The fold of 1/1 and the edge of no impact meet at a point that each finds independently: the fold where its
// impact speed vanishes, the edge where the orbit with the new impact has the multiplier 1. Likewise the
// period doubling and the edge.
TEST(Curves, SpecialPointsAreTheSameFromBothCurves) {
    const auto rig = rig_170mm();
    const Window plane{{0.5, 0}, {4.5, 5}};
    const Curve reach =
        trace_curve(Rig(rig), *end_of_free_motion(Rig(rig), {3.0, 0.0}, {3.0, 5.0}, window), plane);
    const Curve fold = trace_curve(Rig(rig), edge(rig, {1.6, 1.5}, {2.2, 1.5}, {-1, 2}), plane);
    const Curve doubling = trace_curve(Rig(rig), edge(rig, {2, 1}, {3, 1}), plane);
    const auto special = [](const Curve& curve, SpecialKind kind) {
        for (const Special& each : curve.specials) {
            if (each.kind == kind) return each.place;
        }
        ADD_FAILURE() << "no such point";
        return PlanePoint{};
    };
    for (const auto& [curve, kind] :
         {std::pair(fold, SpecialKind::fold_grazing), std::pair(doubling, SpecialKind::flip_grazing)}) {
        EXPECT_NEAR(special(curve, kind).column, special(reach, kind).column, 1e-9);
        EXPECT_NEAR(special(curve, kind).row, special(reach, kind).row, 1e-9);
    }
}

// Beyond each point the orbit is different: CVODE, which does not use the closed form, confirms it.
TEST(Curves, AnotherEngineSeesTheEdges) {
    const std::pair one{1, 1};
    const double step = 1e-3;
    EXPECT_EQ(label(by_cvode({2.659361979 - step, 0})), one);
    EXPECT_EQ(label(by_cvode({2.659361979 + step, 0})), std::pair(2, 2));
    EXPECT_EQ(label(by_cvode({1.15008754 + step, 0})), one);
    EXPECT_EQ(label(by_cvode({1.15008754 - step, 0})), std::pair(2, 1));
    const PlanePoint before{1.862464993 - step, 1.5};
    const auto orbit = orbit_at<trajectory::ExactCycleMap<double>>(rig_170mm(), {1.8, 1.5}, 1, {-1, 2});
    ASSERT_TRUE(orbit);
    EXPECT_EQ(label(by_cvode(before, {-1, 2})), one);
    EXPECT_NE(label(by_cvode({1.862464993 + step, 1.5}, {-1, 2})), one);
}

// All derivatives in closed form, against central differences.
void expect_derivatives(const Rig& rig, const Seed& seed) {
    const Equations at = equations(rig, seed.point, conditions_of(seed.kind));
    for (Eigen::Index i = 0; i < at.jacobian.cols(); ++i) {
        const double step = 1e-6;
        Eigen::VectorXd change = Eigen::VectorXd::Zero(at.jacobian.cols());
        OrbitPoint up = seed.point;
        OrbitPoint down = seed.point;
        change[i] = step;
        move(up, change);
        move(down, -change);
        const Eigen::VectorXd slope = (equations(rig, up, conditions_of(seed.kind)).values -
                                       equations(rig, down, conditions_of(seed.kind)).values) /
                                      (2 * step);
        EXPECT_LT((slope - at.jacobian.col(i)).norm(), 1e-5 * (1 + slope.norm())) << "unknown " << i;
    }
}

TEST(Curves, DerivativesAreThoseOfTheEquations) {
    expect_derivatives(Rig(rig_170mm()), edge(rig_170mm(), {2, 1}, {3, 1}));
    expect_derivatives(Rig(rig_170mm()), edge(rig_170mm(), {1.6, 1.5}, {2.2, 1.5}, {-1, 2}));
    expect_derivatives(Rig(rig_170mm()), edge(rig_170mm(), {1.3, 0}, {0.9, 0}));
    const auto other = [] {
        auto rig = rigid_rig();
        rig.damping_ratio = 0.1;
        return rig;
    }();
    expect_derivatives(Rig(other), edge(other, {2, 0.5}, {3, 0.5}));
}

// With r = 0 the hammer leaves the stop from rest, as a grazing does; it begins to stick where it has no
// acceleration there: at gap = eta^2 sin(theta), with eta tan(pi / eta) tan(theta) = 1 for an undamped flight
// of one cycle from rest to the next impact.
TEST(Curves, NoGrazingIsWhereAHammerBeginsToStick) {
    auto rig = rigid_rig();
    rig.damping_ratio = 0;
    rig.contact = scene::Restitution<double>{0};
    for (const double eta : {1.7, 2.0, 2.3}) {
        const double theta = std::numbers::pi + std::atan(1 / (eta * std::tan(std::numbers::pi / eta)));
        const double gap = eta * eta * std::sin(theta);
        const auto orbit = orbit_at<trajectory::RigidExactMap<double>>(rig, {eta, gap + 0.4}, 1, {-1, eta});
        ASSERT_TRUE(orbit);
        const FollowedOrbit followed = follow(Rig(rig), *orbit, {eta, gap - 0.4}, window);
        EXPECT_FALSE(followed.reached);
        EXPECT_FALSE(followed.seed);
        // beyond, the flight enters the stop: as deep as the cube of the distance, and seen from 1e-9 on
        EXPECT_NEAR(followed.last.row, gap, 2e-3);
    }
}

TEST(Curves, AMotionThatIsNoOrbitGivesNone) {
    scene::Oscillator<double> rig = rigid_rig();
    EXPECT_FALSE(stable_orbit_near(Rig(rig), {3, 4}, {-4, -3}, 1, window));     // never touches
    EXPECT_FALSE(stable_orbit_near(Rig(rig), {0.3, 0}, {-0.1, 0}, 1, window));  // ends in chatter
    rig.damping_ratio = 0;
    EXPECT_FALSE(end_of_free_motion(Rig(rig), {1.0, 0.0}, {1.0, 5.0}, window));  // its amplitude is unbounded
}

}  // namespace
}  // namespace peterka::curves
