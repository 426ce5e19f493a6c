// Where orbits fold, double their period and graze, against closed forms: the free swing of linear springs,
// whose amplitude is that of a resonance curve, and the orbit with one impact per cycle on a rigid stop.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "certificate/branch_crossing.hpp"
#include "certificate/orbit_box.hpp"
#include "certified_cells.hpp"

namespace peterka::certificate {
namespace {

using Real = long double;

Real damping_ratio_of(const job::CellNumbers& numbers) {
    const Real omega = 2 * std::numbers::pi_v<Real> * *numbers.hammer.natural_frequency_hz;
    return *numbers.hammer.damping_ns_per_m / (2 * numbers.hammer.mass_kg * omega);
}

// R = real + i imaginary of the steady flight.
struct Response {
    Real real;
    Real imaginary;
    Response(Real zeta, Real eta) {
        const Real in_phase = 1 - eta * eta;
        const Real behind = 2 * zeta * eta;
        const Real share = eta * eta / (in_phase * in_phase + behind * behind);
        real = share * in_phase;
        imaginary = -share * behind;
    }
    [[nodiscard]] Real square() const { return real * real + imaginary * imaginary; }
};

// The frequencies at which |R| is the gap: (1 - 1/g^2) e^2 + (4 zeta^2 - 2) e + 1 = 0 with e = eta^2.
std::vector<Real> ends_of_free_swing(Real zeta, Real gap) {
    const Real a = 1 - 1 / (gap * gap);
    const Real b = 4 * zeta * zeta - 2;
    const Real root = std::sqrt(b * b - 4 * a);
    std::vector<Real> frequencies;
    for (const Real square : {2 / (-b + root), (-b + root) / (2 * a)}) {
        if (square > 0) frequencies.push_back(std::sqrt(square));
    }
    return frequencies;
}

void expect_around(const CrossingProof& proof, Real exact, Real width) {
    ASSERT_EQ(proof.verdict, Crossed::proved);
    EXPECT_LE(proof.at.lo, exact);
    EXPECT_GE(proof.at.hi, exact);
    EXPECT_LT((proof.at.hi - proof.at.lo) / exact, width);
}

// `off`: of the guess for the frequency.
BranchCrossing free_swing_at(Real zeta, Real eta, double off = 0) {
    const Response response(zeta, eta);
    const Real angle = std::numbers::pi_v<Real> / 2 - std::atan2(response.imaginary, response.real);
    const auto time = static_cast<double>(angle / eta);
    return {BranchEvent::grazing,
            {1, {{EventKind::graze, 0, time, 0}}},
            "frequency_ratio",
            static_cast<double>(eta) * (1 + off)};
}

TEST(BranchCrossing, AFreeSwingGrazesWhereItsAmplitudeIsTheGap) {
    for (const double gap : {0.7, 1.5, 3.0, 20.0}) {
        const job::CellNumbers numbers = testing::numbers_170mm(1, gap);
        const Real zeta = damping_ratio_of(numbers);
        for (const Real eta : ends_of_free_swing(zeta, gap)) {
            for (const double off : {0.0, 1e-4}) {
                SCOPED_TRACE(gap);
                expect_around(prove_crossing(numbers, free_swing_at(zeta, eta, off)), eta, 1e-11L);
            }
        }
    }
}

TEST(BranchCrossing, IsInTheUnitOfItsKey) {
    job::CellNumbers numbers = testing::numbers_170mm(1, 1.5);
    const Real zeta = damping_ratio_of(numbers);
    const Real eta = ends_of_free_swing(zeta, 1.5).front();
    BranchCrossing swing = free_swing_at(zeta, eta);
    swing.key = "frequency_hz";
    swing.near *= 4.5;
    expect_around(prove_crossing(numbers, swing), 4.5L * eta, 1e-11L);
    // At this frequency the gap is the amplitude.
    const double frequency = 1.7;
    numbers.place.frequency_ratio = frequency;
    swing = free_swing_at(zeta, frequency);
    swing.key = "gap_ratio";
    const Real amplitude = std::sqrt(Response(zeta, frequency).square());
    swing.near = static_cast<double>(amplitude);
    expect_around(prove_crossing(numbers, swing), amplitude, 1e-13L);
}

// One impact per cycle on a rigid stop: the steady flight has (p, w) at the impact, the rest goes over from
// (-p, -r v - w) into (-p, v - w) in a cycle; so (p, w) = v (P, W), and (p + g)^2 + (w/eta)^2 = |R|^2.
class RigidOrbit {
  public:
    RigidOrbit(Real zeta, Real r, Real g, Real eta)
        : zeta_(zeta), r_(r), g_(g), eta_(eta), response_(zeta, eta) {
        period_ = 2 * std::numbers::pi_v<Real> / eta;
        const Real rate = std::sqrt(1 - zeta * zeta);
        const Real decay = std::exp(-zeta * period_);
        const Real sine = decay * std::sin(rate * period_) / rate;
        const Real cosine = decay * std::cos(rate * period_);
        flow_ = {cosine + zeta * sine, sine, -sine, cosine - zeta * sine};
        determinant_ = r * r * decay * decay;
        const Real x = r * flow_.b;
        const Real y = 1 + r * flow_.d;
        const Real of_inverse = (1 - flow_.a) * (1 - flow_.d) - flow_.b * flow_.c;
        position_ = ((1 - flow_.d) * x + flow_.b * y) / of_inverse;
        velocity_ = (flow_.c * x + (1 - flow_.a) * y) / of_inverse;
    }
    // Of the quadratic equation for v: 0 where two orbits become one.
    [[nodiscard]] Real discriminant() const {
        return position_ * position_ * g_ * g_ - square() * (g_ * g_ - response_.square());
    }
    [[nodiscard]] Real speed() const {
        return (-position_ * g_ + std::sqrt(std::max<Real>(discriminant(), 0))) / square();
    }
    [[nodiscard]] Real time() const {
        const Real x = position_ * speed() + g_;
        const Real y = velocity_ * speed() / eta_;
        const Real angle = std::atan2(response_.real * x - response_.imaginary * y,
                                      response_.imaginary * x + response_.real * y) /
                           eta_;
        return angle < 0 ? angle + period_ : angle;
    }
    [[nodiscard]] Real test_of_doubling() const {  // det(M + I)
        const Real pressing = eta_ * eta_ * std::sin(eta_ * time()) - g_;
        const Real trace = -r_ * (flow_.a + flow_.d) + flow_.b * (1 + r_) * pressing / speed();
        return 1 + trace + determinant_;
    }
    // Of the flight from one impact to the next over the stop; above 0 it would pass through.
    [[nodiscard]] Real highest() const {
        constexpr int samples = 2000;
        const Real rate = std::sqrt(1 - zeta_ * zeta_);
        const Real before = -position_ * speed();
        const Real after = -(r_ + velocity_) * speed();
        Real highest = -std::numeric_limits<Real>::infinity();
        for (int n = samples / 50; n < samples - samples / 50; ++n) {
            const Real passed = period_ * n / samples;
            const Real angle = eta_ * (time() + passed);
            const Real decay = std::exp(-zeta_ * passed);
            const Real sine = decay * std::sin(rate * passed) / rate;
            const Real rest = (decay * std::cos(rate * passed) + zeta_ * sine) * before + sine * after;
            const Real swing = response_.real * std::sin(angle) + response_.imaginary * std::cos(angle);
            highest = std::max(highest, swing + rest - g_);
        }
        return highest;
    }
    [[nodiscard]] BranchCrossing guess(BranchEvent event, double near) const {
        return {event,
                {1, {{EventKind::bounce, 0, static_cast<double>(time()), static_cast<double>(speed())}}},
                "frequency_ratio",
                near};
    }

  private:
    [[nodiscard]] Real square() const { return position_ * position_ + velocity_ * velocity_ / (eta_ * eta_); }

    Real zeta_;
    Real r_;
    Real g_;
    Real eta_;
    Response response_;
    Real period_;
    Matrix<Real> flow_;
    Real determinant_;
    Real position_;
    Real velocity_;
};

struct RigidCase {
    job::CellNumbers numbers;
    Real restitution;
    Real gap;

    RigidCase(double r, double g) : numbers(testing::numbers_170mm(1, g)), restitution(r), gap(g) {
        numbers.contact = job::Restitution{r};
    }
    [[nodiscard]] RigidOrbit at(Real eta) const { return {damping_ratio_of(numbers), restitution, gap, eta}; }
    // All sign changes of a function of the orbit from eta 0.6 to 4, where there is one with v > 0.
    template <class Function>
    [[nodiscard]] std::vector<Real> zeros(Function&& function) const {
        std::vector<Real> found;
        const auto value = [&](Real eta) { return function(at(eta)); };
        constexpr Real step = 0.003L;
        for (Real low = 0.6L; low < 4; low += step) {
            Real a = low;
            Real b = low + step;
            const Real before = value(a);
            const Real after = value(b);
            if (!(before * after < 0) || std::abs(before - after) > 30) continue;
            for (int halving = 0; halving < 90; ++halving) {
                const Real middle = (a + b) / 2;
                ((value(middle) > 0) == (before > 0) ? a : b) = middle;
            }
            if (at(a).speed() > 1e-3L) found.push_back(a);
        }
        return found;
    }
};

TEST(BranchCrossing, TheOrbitOfOneImpactOnARigidStopDoublesItsPeriodWhereItsClosedFormSays) {
    int proved = 0;
    for (const double r : {0.5, 0.8}) {
        for (const double gap : {0.0, 0.5, 1.0}) {
            const RigidCase rig(r, gap);
            const auto zeros = rig.zeros([](const RigidOrbit& orbit) {
                return orbit.discriminant() > 0 ? orbit.test_of_doubling() : Real(NAN);
            });
            for (const Real eta : zeros) {
                const BranchCrossing guess =
                    rig.at(eta).guess(BranchEvent::period_doubling, static_cast<double>(eta));
                const CrossingProof proof = prove_crossing(rig.numbers, guess);
                if (proof.verdict == Crossed::near_grazing) continue;  // it passes through the stop
                expect_around(proof, eta, 1e-10L);
                ++proved;
            }
        }
    }
    EXPECT_GE(proved, 6);
}

TEST(BranchCrossing, TwoOrbitsOfOneImpactOnARigidStopMergeWhereTheirClosedFormSays) {
    int proved = 0;
    for (const double r : {0.5, 0.8}) {
        for (const double gap : {1.0, 2.0, 4.0}) {
            const RigidCase rig(r, gap);
            for (const Real eta : rig.zeros([](const RigidOrbit& orbit) { return orbit.discriminant(); })) {
                const BranchCrossing guess = rig.at(eta).guess(BranchEvent::fold, static_cast<double>(eta));
                const CrossingProof proof = prove_crossing(rig.numbers, guess);
                if (proof.verdict == Crossed::near_grazing) continue;
                expect_around(proof, eta, 1e-11L);
                ++proved;
            }
        }
    }
    EXPECT_GE(proved, 2);
}

// Newton's method on a relaxed chain of one bounce: mu, where its speed is held.
double slack_in_doubles(const Springs<double>& springs, EventChain& chain, double speed) {
    chain.events[0].along = speed;
    double slack = 0;
    for (int steps = 0; steps < 8; ++steps) {
        const EquationsInDoubles at = equations_in_doubles(springs, chain);
        const double step = at.residuals[0] / at.derivatives(0, 0);
        chain.events[0].time -= step;
        slack = -(at.residuals[1] - at.derivatives(1, 0) * step);
    }
    return slack;
}

// The whole family, its slack and its slope hold those of each of its members.
TEST(BranchCrossing, ARelaxedChainHoldsItsMembers) {
    const RigidCase rig(0.8, 2);
    const auto folds = rig.zeros([](const RigidOrbit& orbit) { return orbit.discriminant(); });
    ASSERT_FALSE(folds.empty());
    job::CellNumbers numbers = rig.numbers;
    numbers.place.frequency_ratio = static_cast<double>(folds.front());
    const Springs<Interval> springs(*rig_of(numbers));
    const Springs<double> approximate(middle(*rig_of(numbers)));
    EventChain chain = rig.at(folds.front()).guess(BranchEvent::fold, 0).chain;
    const double speed = chain.events[0].along;
    for (const double radius : {1e-6, 1e-5, 1e-4, 1e-3}) {
        const Interval held(speed - radius, speed + radius);
        const auto all = relaxed_orbits(springs, approximate, chain, {1, 1, held});
        ASSERT_TRUE(all);
        EXPECT_LT(all->slack.hi - all->slack.lo, 50 * radius * radius + 1e-13);
        for (int part = -10; part <= 10; ++part) {
            const double s = speed + 0.1 * part * radius;
            EventChain member = chain;
            const double slack = slack_in_doubles(approximate, member, s);
            const double rounding = 1e-14;
            EXPECT_LE(all->slack.lo - rounding, slack);
            EXPECT_GE(all->slack.hi + rounding, slack);
            EXPECT_TRUE(all->orbits.places[0].time.holds(member.events[0].time));
            const auto one = relaxed_orbits(springs, approximate, member, {1, 1, Interval(s)});
            ASSERT_TRUE(one);
            EXPECT_LE(one->slack.lo, slack);
            EXPECT_GE(one->slack.hi, slack);
            EXPECT_LT(one->slack.hi - one->slack.lo, 1e-12);
            EXPECT_LE(all->slope.lo, one->slope.lo);
            EXPECT_GE(all->slope.hi, one->slope.hi);
            const double h = 1e-6;
            EventChain beside = chain;
            const double quotient =
                (slack_in_doubles(approximate, beside, s + h) - slack_in_doubles(approximate, beside, s - h)) /
                (2 * h);
            EXPECT_NEAR(one->slope.middle(), quotient, 1e-7);
            EXPECT_LT(one->slope.hi - one->slope.lo, 1e-10);
        }
    }
}

// mu at the fold of a rigid rig, from closed forms: the chain, and S around its speed.
struct FoldOfBounce {
    RigidCase rig{0.8, 2};
    Real eta = rig.zeros([](const RigidOrbit& orbit) { return orbit.discriminant(); }).front();
    BranchCrossing guess = rig.at(eta).guess(BranchEvent::fold, static_cast<double>(eta));
    double speed = guess.chain.events[0].along;

    [[nodiscard]] Crossed within(double s, double radius, double sign, const Interval& etas) const {
        return folds_within(rig.numbers, guess, {{1, 1, {s - radius, s + radius}}, sign}, etas);
    }
};

TEST(BranchCrossing, AFoldNeedsAMaximumWithinTheHeldValues) {
    const FoldOfBounce fold;
    const double eta = fold.guess.near;
    const double radius = 1e-6;
    const Interval etas(eta - 1e-9, eta + 1e-9);
    const double sign = fold.within(fold.speed, radius, 1, etas) == Crossed::proved ? 1 : -1;
    EXPECT_EQ(fold.within(fold.speed, radius, sign, etas), Crossed::proved);
    EXPECT_EQ(fold.within(fold.speed, radius, -sign, etas), Crossed::not_surely_crossed);
}

// On one side of the fold there are two orbits, on the other none.
TEST(BranchCrossing, NoBoxHoldsOneOrbitForEachRigAcrossAFold) {
    const FoldOfBounce fold;
    for (const double far : {1e-10, 1e-9, 1e-8}) {
        const double side = fold.rig.at(fold.eta + far).discriminant() > 0 ? 1 : -1;
        const double eta = fold.guess.near + side * far;
        job::CellNumbers numbers = fold.rig.numbers;
        numbers.place.frequency_ratio = eta;
        Rig rig = *rig_of(numbers);
        const Springs<double> approximate(middle(rig));
        const EventChain chain = fold.rig.at(eta).guess(BranchEvent::fold, eta).chain;
        const auto encloses = [&](double radius) {
            rig.frequency = around(eta, radius);
            rig.period = Interval(2) * pi / rig.frequency;
            return enclosed_orbits(Springs<Interval>(rig), approximate, chain).has_value();
        };
        EXPECT_TRUE(encloses(1e-3 * far)) << far;
        for (const double across : {1.05, 1.5, 3.0}) EXPECT_FALSE(encloses(across * far)) << far;
    }
}

// In intervals of frequencies beside the fold, each from a distance to its double, with S anywhere around it:
// mu rises or falls throughout where S does not hold its maximum, and becomes 0 at an orbit that is no fold;
// and where it does, mu at the middle of S changes its sign elsewhere than the maximum.
TEST(BranchCrossing, OrbitsBesideAFoldAreNone) {
    const FoldOfBounce fold;
    const double eta = fold.guess.near;
    int refused = 0;
    for (const double beside : {-1e-4, -1e-5, 1e-5, 1e-4}) {
        for (const double radius : {1e-7, 2 * std::abs(beside)}) {
            for (const double sign : {-1., 1.}) {
                for (const double side : {-1., 1.}) {
                    for (double far = 1e-12; far < 1e-4; far *= 1.7) {
                        const double end = eta + side * far;
                        const Interval etas(std::min(end, end + side * far), std::max(end, end + side * far));
                        const Crossed verdict = fold.within(fold.speed + beside, radius, sign, etas);
                        EXPECT_NE(verdict, Crossed::proved);
                        refused += verdict == Crossed::not_surely_crossed ? 1 : 0;
                    }
                }
            }
        }
    }
    EXPECT_GT(refused, 500);
}

// Where the hammer's natural frequency rises, an orbit doubles its period and comes later near the stop once
// more, beyond which it would pass through: an interval from the one to the other has a lower half that is
// proved alone.
TEST(BranchCrossing, IsRefusedWhereOrbitsOfTheUpperHalfComeNearTheStopAgain) {
    const RigidCase rig(0.3, 1);
    const auto zeros = rig.zeros([](const RigidOrbit& orbit) {
        return orbit.discriminant() > 0 ? orbit.test_of_doubling() : Real(NAN);
    });
    ASSERT_FALSE(zeros.empty());
    const Real eta = zeros.front();
    const double natural = *rig.numbers.hammer.natural_frequency_hz;
    job::CellNumbers numbers = rig.numbers;
    numbers.place.frequency_hz = static_cast<double>(eta * natural);
    BranchCrossing doubling = rig.at(eta).guess(BranchEvent::period_doubling, natural);
    doubling.key = "hammer.natural_frequency_hz";
    const double low = natural - 1e-7;
    int with_a_sound_half = 0;
    for (double far = 0.0687; far < 0.1; far += 0.004) {
        const Crossed whole = crosses_within(numbers, doubling, {low, natural + far});
        EXPECT_LT(whole, Crossed::not_tried) << far << " " << rig.at(eta * natural / (natural + far)).highest();
        const double middle = Interval(low, natural + far).middle();
        const bool is_sound = crosses_within(numbers, doubling, {low, middle}) == Crossed::proved;
        with_a_sound_half += whole == Crossed::near_grazing && is_sound ? 1 : 0;
    }
    EXPECT_GT(rig.at(eta * natural / (natural + 0.1)).highest(), 0);
    EXPECT_GT(with_a_sound_half, 0);
}

// Far from any zero, and where another branch would have to be taken.
TEST(BranchCrossing, WideIntervalsAreRefused) {
    const job::CellNumbers numbers = testing::numbers_170mm(1, 1.5);
    const Real eta = ends_of_free_swing(damping_ratio_of(numbers), 1.5L).front();
    const BranchCrossing swing = free_swing_at(damping_ratio_of(numbers), eta);
    EXPECT_EQ(crosses_within(numbers, swing, around(swing.near, 1e-9)), Crossed::proved);
    EXPECT_LT(crosses_within(numbers, swing, {-swing.near, swing.near}), Crossed::not_tried);
    EXPECT_LT(crosses_within(numbers, swing, {swing.near + 1e-9, swing.near + 1e-8}), Crossed::not_tried);
    EXPECT_LT(crosses_within(numbers, swing, {swing.near - 0.2, 4}), Crossed::not_tried);
}

// Not a chain of this stop, or without the grazing that is claimed.
TEST(BranchCrossing, ChainsOfAnotherStopAreRefused) {
    const RigidCase rig(0.8, 1);
    BranchCrossing bounce = rig.at(2.5L).guess(BranchEvent::period_doubling, 2.5);
    EXPECT_EQ(prove_crossing(testing::numbers_170mm(1, 1), bounce).verdict, Crossed::no_orbit_found);
    bounce.event = BranchEvent::grazing;
    EXPECT_EQ(prove_crossing(rig.numbers, bounce).verdict, Crossed::no_orbit_found);
    job::CellNumbers numbers = rig.numbers;
    numbers.contact = job::HuntCrossley{};
    EXPECT_EQ(prove_crossing(numbers, bounce).verdict, Crossed::other_stop);
}

}  // namespace
}  // namespace peterka::certificate
