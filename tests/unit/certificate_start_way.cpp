// Proofs that a start leads to an orbit: against motions followed one by one, in doubles, and against the
// engine where starts of one cell end on different orbits.
#include "certificate/start_way.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "certificate/certify.hpp"
#include "certificate/find_chain.hpp"
#include "certificate/leg_proof.hpp"
#include "certificate/orbit_box.hpp"
#include "certified_cells.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using testing::claim_of;
using testing::SolvedPlace;
using testing::Stop;
using testing::stops;

constexpr double rounding_decides = 20;  // sensitivity, from where a start's label may depend on rounding

class StartsOf : public ::testing::TestWithParam<Stop> {};
INSTANTIATE_TEST_SUITE_P(Stops, StartsOf, ::testing::ValuesIn(stops),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(StartsOf, NearlyAllCellsAreProvedToLeadToTheirOrbits) {
    for (const auto regime : {cell::Regime::periodic, cell::Regime::no_impact}) {
        int cells = 0;
        int proved = 0;
        for (const SolvedPlace& place : testing::cells_of(regime, 16, GetParam().law)) {
            if (place.cell.sensitivity > rounding_decides) continue;
            const Claim claim = claim_of(place.cell);
            const Certified verdict = certify(place.numbers, claim, OfStart::through_impacts).verdict;
            if (verdict < Certified::not_tried) continue;
            ++cells;
            proved += verdict == Certified::start ? 1 : 0;
        }
        EXPECT_GT(cells, 60);
        EXPECT_GT(proved, 0.95 * cells);
    }
}

bool same_motion(const cell::CellResult& a, const cell::CellResult& b) {
    return a.regime == b.regime && a.impacts == b.impacts && a.period == b.period &&
           (std::abs(a.peak_force - b.peak_force) < 1e-6 * a.peak_force || !(a.peak_force > 0)) &&
           (std::abs(a.impact_speed - b.impact_speed) < 1e-6 * a.impact_speed || !(a.impact_speed > 0));
}

// Both orbits exist and are proved; the start decides.
TEST_P(StartsOf, AStartThatEndsElsewhereIsNotProvedToLeadThere) {
    std::mt19937_64 random(12);
    std::uniform_real_distribution<double> displacement(-3, 1);
    std::uniform_real_distribution<double> velocity(-4, 4);
    int elsewhere = 0;
    int here = 0;
    int proved = 0;
    for (int row = 0; row < 10; ++row) {
        for (int column = 0; column < 10; ++column) {
            job::CellNumbers numbers = testing::numbers_170mm(0.61 + 3.8 * column / 10, 0.4 + 4.0 * row / 10);
            numbers.contact = GetParam().law;
            const SolvedPlace first = testing::solved(numbers);
            for (int starts = 0; starts < 2; ++starts) {
                const double x = displacement(random);
                const double v = velocity(random);
                const SolvedPlace other = testing::solved(numbers, x, v);
                numbers.start = {};
                numbers.start.displacement_ratio = x;
                numbers.start.velocity_ratio = v;
                if (other.cell.sensitivity > rounding_decides) continue;
                const Certified verdict =
                    certify(numbers, claim_of(first.cell), OfStart::in_many_digits).verdict;
                if (verdict <= Certified::not_tried) continue;
                if (!same_motion(first.cell, other.cell)) {
                    ++elsewhere;
                    EXPECT_EQ(verdict, Certified::orbit)
                        << numbers.frequency_ratio() << ' ' << numbers.gap_ratio() << ' ' << x << ' ' << v;
                } else {
                    ++here;
                    proved += verdict == Certified::start ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(elsewhere, 15);
    EXPECT_GT(here, 60);
    EXPECT_GT(proved, 0.95 * here);
}

struct ProvedOrbit {
    Springs<Interval> springs;
    Springs<double> approximate;
    EventChain chain;
    std::vector<Place<Interval>> places;
};

// Those of a stop that have a chain of impacts.
std::vector<ProvedOrbit> proved_orbits(const job::Contact& law) {
    std::vector<ProvedOrbit> orbits;
    for (const SolvedPlace& place : testing::cells_of(cell::Regime::periodic, 10, law)) {
        const Rig rig = rig_of(place.numbers).value();
        ProvedOrbit orbit{Springs<Interval>(rig), Springs<double>(middle(rig)), {}, {}};
        const auto chain = find_chain(orbit.approximate, claim_of(place.cell).orbit);
        if (!chain) continue;
        const auto places = orbit_box(orbit.springs, orbit.approximate, *chain);
        if (!places) continue;
        orbit.chain = *chain;
        orbit.places = *places;
        orbits.push_back(orbit);
    }
    return orbits;
}

// One event later, in doubles, which has to be of this kind.
Place<double> next_event(const Springs<double>& springs, Event from, const Place<double>& place,
                         const Event& expected) {
    from.time = place.time;
    from.along = place.along;
    Walk walk = Walk::after(springs, from);
    Event next;
    EXPECT_EQ(walk.go_on(place.time + 1e4, next), Walk::End::event);
    EXPECT_EQ(next.kind, expected.kind);
    return {next.time - static_cast<double>(expected.cycle) * springs.rig.period, next.along};
}

Place<double> at(const Patch& patch, double first, double second) {
    const double r = first * patch.spread.position.size();
    const double s = second * patch.spread.velocity.size();
    return {patch.event.time + patch.frame.a.middle() * r + patch.frame.b.middle() * s,
            patch.event.along + patch.frame.c.middle() * r + patch.frame.d.middle() * s};
}

TEST_P(StartsOf, ASetContainsAllThatItsPlacesLeadTo) {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> part(-1, 1);
    int passages = 0;
    double widest = 0;
    for (const ProvedOrbit& orbit : proved_orbits(GetParam().law)) {
        for (const double radius : {0.3, 0.1, 3e-2, 1e-3, 1e-5}) {
            Patch patch = patch_of(orbit.chain.events[0].kind, orbit.places[0]);
            const double turn = part(random) * std::numbers::pi;
            patch.frame = {std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn)};
            patch.spread = {Interval(-radius, radius), Interval(-0.1 * radius, 0.1 * radius)};
            Event to = orbit.chain.events[orbit.chain.next(0)];
            to.cycle = orbit.chain.cycles_of_leg(0);
            const auto passage = pass(orbit.springs, orbit.approximate, patch, to);
            if (!passage) continue;
            ++passages;
            const Matrix<Interval> turned = inverse(passage->end.frame);
            const Vector<Interval>& spread = passage->end.spread;
            for (int samples = 0; samples < 40; ++samples) {
                const bool corner = samples % 2 == 0;
                const auto pick = [&] { return corner ? std::copysign(1.0, part(random)) : part(random); };
                const auto end = next_event(orbit.approximate, patch.event, at(patch, pick(), pick()), to);
                const Vector<Interval> away{Interval(end.time - passage->end.event.time),
                                            Interval(end.along - passage->end.event.along)};
                const Vector<Interval> r = turned * away;
                const double tolerance = 1e-11;  // of the motion in doubles
                EXPECT_GT(r.position.hi, spread.position.lo - tolerance);
                EXPECT_LT(r.position.lo, spread.position.hi + tolerance);
                EXPECT_GT(r.velocity.hi, spread.velocity.lo - tolerance);
                EXPECT_LT(r.velocity.lo, spread.velocity.hi + tolerance);
                widest = std::max(widest, std::abs(r.position.middle()) / spread.position.size());
            }
        }
    }
    EXPECT_GT(passages, 15);
    EXPECT_GT(widest, 0.9);
}

TEST_P(StartsOf, ATrapPullsAllItsPlacesTowardsTheOrbit) {
    std::mt19937_64 random(14);
    std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
    int traps = 0;
    for (const ProvedOrbit& orbit : proved_orbits(GetParam().law)) {
        const auto trap = find_trap(orbit.springs, orbit.approximate, orbit.chain, orbit.places);
        if (!trap || trap->radius < 1e-7) continue;  // within the accuracy of motions in doubles
        ++traps;
        const Matrix<Interval> basis = inverse(trap->coordinates);
        std::size_t first = 0;
        while (orbit.chain.events[first].time != trap->event.time) ++first;
        for (int samples = 0; samples < 6; ++samples) {
            const double turn = angle(random);
            const Vector<Interval> b{Interval(trap->radius * std::cos(turn)),
                                     Interval(trap->radius * std::sin(turn))};
            const Vector<Interval> away = basis * b;
            Place<double> place{(trap->orbit.time + away.position).middle(),
                                (trap->orbit.along + away.velocity).middle()};
            for (std::size_t leg = 0; leg < orbit.chain.events.size(); ++leg) {
                const std::size_t i = (first + leg) % orbit.chain.events.size();
                Event to = orbit.chain.events[orbit.chain.next(i)];
                to.cycle = orbit.chain.cycles_of_leg(i);
                place = next_event(orbit.approximate, orbit.chain.events[i], place, to);
            }
            const Vector<Interval> back =
                trap->coordinates * Vector<Interval>{Interval(place.time) - trap->orbit.time,
                                                     Interval(place.along) - trap->orbit.along};
            EXPECT_LT(std::hypot(back.position.middle(), back.velocity.middle()), trap->radius);
        }
        Patch patch = patch_of(trap->event.kind, trap->orbit);
        EXPECT_TRUE(trap->holds(patch));
        patch.event.time += 1.01 * trap->radius * Eigen::Vector2d(basis.a.lo, basis.c.lo).norm() + 1e-9;
        patch.event.along += 3 * trap->radius + 1e-9;
        patch.spread = {Interval(-1e-3, 1e-3), Interval(-1e-3, 1e-3)};
        EXPECT_FALSE(trap->holds(patch));
    }
    EXPECT_GT(traps, 10);
}

// Of a single place nothing is known to the last digit; and dy/dx is that of differences.
TEST_P(StartsOf, OnePlaceLeadsToAnEnclosedOneWithItsDerivative) {
    int passages = 0;
    for (const ProvedOrbit& orbit : proved_orbits(GetParam().law)) {
        const Patch patch = patch_of(orbit.chain.events[0].kind, {Interval(orbit.places[0].time.middle()),
                                                                  Interval(orbit.places[0].along.middle())});
        Event to = orbit.chain.events[orbit.chain.next(0)];
        to.cycle = orbit.chain.cycles_of_leg(0);
        const auto passage = pass(orbit.springs, orbit.approximate, patch, to);
        if (!passage) continue;
        ++passages;
        EXPECT_GT(passage->end.spread.position.size(), 1e-18);
        EXPECT_GT(passage->end.spread.velocity.size(), 1e-18);
        EXPECT_LT(passage->end.spread.position.size(), 1e-9);
        constexpr double h = 1e-6;
        const auto end = [&](double time, double along) {
            return next_event(orbit.approximate, patch.event,
                              {patch.event.time + time, patch.event.along + along}, to);
        };
        const auto expect = [](const Interval& derivative, double difference) {
            EXPECT_NEAR(derivative.middle(), difference, 1e-4 * (1 + std::abs(difference)));
        };
        const auto later = end(h, 0);
        const auto sooner = end(-h, 0);
        const auto faster = end(0, h);
        const auto slower = end(0, -h);
        expect(passage->derivative.a, (later.time - sooner.time) / (2 * h));
        expect(passage->derivative.c, (later.along - sooner.along) / (2 * h));
        expect(passage->derivative.b, (faster.time - slower.time) / (2 * h));
        expect(passage->derivative.d, (faster.along - slower.along) / (2 * h));
    }
    EXPECT_GT(passages, 10);
}

TEST(StartWay, TheFirstEventIsEnclosed) {
    const Rig rig = rig_of(testing::numbers_170mm(2, 0.5)).value();
    const Springs<Interval> springs(rig);
    const Springs<double> approximate(middle(rig));
    StartWay way(springs, approximate, {-rig.gap, -rig.frequency});
    ASSERT_EQ(way.go_on(0), StartWay::Step::proved);
    EXPECT_EQ(way.at()->event.kind, EventKind::touch);
    EXPECT_GT(way.at()->spread.position.size(), 1e-18);
    EXPECT_GT(way.at()->spread.velocity.size(), 1e-18);
    EXPECT_LT(way.at()->spread.velocity.size(), 1e-12);
}

// Many digits and doubles enclose the same motion, the former in a far smaller set.
TEST_P(StartsOf, InManyDigitsAWayLiesWithinThatInDoubles) {
    for (const auto& [frequency, gap, cubic] : {std::tuple(2.0, 0.5, 0.0), {3.1, 0.2, 0.0}, {2.3, 0.7, 2e4}}) {
        job::CellNumbers numbers = testing::numbers_170mm(frequency, gap);
        numbers.contact = GetParam().law;
        numbers.hammer.cubic_stiffness_n_per_m3 = cubic;
        const Rig rig = rig_of(numbers).value();
        const Springs<Interval> springs(rig);
        const Springs<double> approximate(middle(rig));
        const Springs<Ball> fine(rig_of<Ball>(numbers).value());
        StartWay way(springs, approximate, {-rig.gap, -rig.frequency});
        StartWay fine_way({&springs, &approximate, &fine}, {-fine.rig.gap, -fine.rig.frequency});
        int events = 0;
        for (; events < 12; ++events) {
            if (way.go_on(0) != StartWay::Step::proved) break;
            ASSERT_EQ(fine_way.go_on(0), StartWay::Step::proved) << frequency;
            ASSERT_EQ(way.at()->event.kind, fine_way.at()->event.kind);
            const Place<Interval> coarse = way.at()->hull();
            const Place<Interval> exact = fine_way.at()->hull();
            EXPECT_FALSE(coarse.time.apart(exact.time)) << frequency << " event " << events;
            EXPECT_FALSE(coarse.along.apart(exact.along)) << frequency << " event " << events;
            EXPECT_LE(exact.time.radius(), 1e-15);  // that of neighbouring doubles
        }
        EXPECT_GT(events, 0);  // with r = 0 the hammer rests
    }
}

// Errors grow by more than e^30 on this way, which leads to 6/10: so does an independent program's in 90
// digits.
TEST(StartWay, InManyDigitsLongWaysAreProved) {
    const SolvedPlace place = testing::solved_at(2.1842105263157894, 1.6842105263157894);
    EXPECT_GT(place.cell.sensitivity, 30);
    const Claim claim = claim_of(place.cell);
    EXPECT_EQ(certify(place.numbers, claim, OfStart::through_impacts).verdict, Certified::orbit);
    EXPECT_EQ(certify(place.numbers, claim, OfStart::in_many_digits).verdict, Certified::start);
}

// By then errors would have grown by more than e^500: neither 448 bits nor the exponents of doubles carry it.
TEST(StartWay, InMoreDigitsLongerWaysAreProved) {
    const SolvedPlace place = testing::solved_at(3.994736842105263, 1.1578947368421053);
    EXPECT_EQ(place.cell.regime, cell::Regime::no_impact);
    const Certificate certificate = certify(place.numbers, claim_of(place.cell), OfStart::in_many_digits);
    EXPECT_EQ(certificate.verdict, Certified::start);
    EXPECT_GT(certificate.last_event, 1800);
    EXPECT_FALSE(certificate.elsewhere.has_value());
}

// Up to where 448 bits lose the way: their set contains the motion as more digits know it, though it has grown
// from 1e-135 to a size that doubles show.
TEST(StartWay, SetsOfFewerDigitsContainTheMotionKnownWithMore) {
    const job::CellNumbers numbers = testing::numbers_170mm(3.994736842105263, 1.1578947368421053);
    const Rig rig = rig_of(numbers).value();
    const Springs<Interval> springs(rig);
    const Springs<double> approximate(middle(rig));
    const auto springs_with = [&](slong bits) {
        const Ball::Precision precision(bits);
        return Springs<Ball>(rig_of<Ball>(numbers).value());
    };
    const Springs<Ball> few = springs_with(448);
    const Springs<Ball> many = springs_with(1792);
    const auto way_with = [&](const Springs<Ball>& fine) {
        return StartWay({&springs, &approximate, &fine}, {-fine.rig.gap, -fine.rig.frequency});
    };
    StartWay way = way_with(few);
    StartWay exact_way = way_with(many);
    double largest = 0;
    while (way.go_on(0) == StartWay::Step::proved) {
        const Ball::Precision precision(1792);
        ASSERT_EQ(exact_way.go_on(0), StartWay::Step::proved);
        const Place<Interval> set = way.at()->hull();
        const Place<Interval> exact = exact_way.at()->hull();
        ASSERT_FALSE(set.time.apart(exact.time)) << "cycle " << way.cycles();
        ASSERT_FALSE(set.along.apart(exact.along)) << "cycle " << way.cycles();
        EXPECT_LE(exact.time.radius(), 1e-15);
        largest = std::max(largest, set.time.radius());
    }
    EXPECT_GT(way.cycles(), 1000);
    EXPECT_GT(largest, 1e-9);
}

// Rounding leads the search to no impact; so does an integrator of 113 bits if the rig's numbers are rounded to
// doubles, but with the exact ones it finds 2/3.
TEST(StartWay, TellsWhereAStartLeadsInstead) {
    const SolvedPlace place = testing::solved_at(2.057894736842105, 1.5789473684210527);
    ASSERT_EQ(place.cell.regime, cell::Regime::no_impact);
    const auto in = [&](OfStart digits) { return certify(place.numbers, claim_of(place.cell), digits); };
    EXPECT_FALSE(in(OfStart::through_impacts).elsewhere.has_value());
    const Certificate certificate = in(OfStart::in_many_digits);
    EXPECT_EQ(certificate.verdict, Certified::orbit);
    ASSERT_TRUE(certificate.elsewhere.has_value());
    EXPECT_GT(certificate.elsewhere->cycles, 100);
    const scene::Oscillator<double> oscillator = testing::oscillator_at(place.numbers);
    const cell::CellResult there = regime::find_steady_state(
        oscillator, {certificate.elsewhere->displacement - oscillator.gap, certificate.elsewhere->velocity}, {},
        {});
    EXPECT_EQ(there.regime, cell::Regime::periodic);
    EXPECT_EQ(there.impacts, 2);
    EXPECT_EQ(there.period, 3);
    EXPECT_LT(there.sensitivity, 3) << "it has settled";
    EXPECT_EQ(certify(place.numbers, claim_of(there), OfStart::in_many_digits).verdict, Certified::start);
}

TEST(Trap, HoldsWhatLiesInItsDiscAlone) {
    const Trap trap{{EventKind::touch, 0, 2, 3},
                    {Interval(2), Interval(3)},
                    {Interval(0.5), Interval(0), Interval(0), Interval(1)},
                    1};
    const auto holds = [&](EventKind kind, double time, double along, double spread) {
        Patch patch = patch_of(kind, {Interval(time), Interval(along)});
        patch.spread = {Interval(-spread, spread), Interval(-spread, spread)};
        return trap.holds(patch);
    };
    EXPECT_TRUE(holds(EventKind::touch, 3.8, 3, 0.1));
    EXPECT_FALSE(holds(EventKind::release, 3.8, 3, 0.1));
    EXPECT_FALSE(holds(EventKind::touch, 3.8, 3, 0.3));
    EXPECT_FALSE(holds(EventKind::touch, 4.1, 3, 0));
    EXPECT_TRUE(holds(EventKind::touch, 2, 3.95, 0.01));
    EXPECT_FALSE(holds(EventKind::touch, 2, 3.95, 0.1));
    EXPECT_FALSE(holds(EventKind::touch, 3.5, 3.7, 0.01));  // outside the disc, within the square around it
}

// Of an orbit that loses stability, no neighbourhood is a trap.
TEST(Trap, AnUnstableOrbitHasNone) {
    int tried = 0;
    for (const ProvedOrbit& orbit : proved_orbits(stops[0].law)) {
        EventChain half = orbit.chain;
        if (half.period % 2 != 0 || half.events.size() % 2 != 0) continue;
        half.period /= 2;
        half.events.resize(half.events.size() / 2);
        for (Event& event : half.events) event.cycle %= half.period;
        if (!refine(orbit.approximate, half)) continue;
        const auto places = orbit_box(orbit.springs, orbit.approximate, half);
        if (!places) continue;
        ++tried;
        EXPECT_FALSE(find_trap(orbit.springs, orbit.approximate, half, *places).has_value());
    }
    EXPECT_GT(tried, 1);
}

// On the surface of a stop whose dashpot is strong, with a velocity that hardly exceeds the cart's: the force
// is positive at once, though it falls.
TEST(March, AStartThatTouchesAtOnceDoesNotLeave) {
    const Rig rig = rig_of(testing::numbers_170mm(3, 3)).value();
    const Springs<Interval> springs(rig);
    for (const double velocity : {1e-3, 1e-9, -1e-9, -1e-3}) {
        const Leg<Interval> leg(springs.phase(false), Interval(0), {Interval(0), Interval(velocity)});
        EXPECT_EQ(March(springs, leg, false).begin(std::nullopt, 1e-3), velocity < 0) << velocity;
    }
}

}  // namespace
}  // namespace peterka::certificate
