// Corrupted inputs: none may be proved if the statement is false. For each kind of corruption the inputs that
// reach the rejecting step are counted, so that the test cannot pass vacuously. On the paper's stop and on
// rigid ones: 39 % of the orbits end in rest with r = 0, 6 % with r = 0.32. PETERKA_ATTACKED_GRID: cells per
// side (30), for endurance/certificates.py, which reads the counts that are recorded.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <string_view>

#include "certificate/chatter.hpp"
#include "certificate/leg_proof.hpp"
#include "certificate/orbit_box.hpp"
#include "certificate/stability.hpp"
#include "certified_cells.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/multiplier.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using testing::claim_of;
using testing::SolvedPlace;
using testing::Stop;
using testing::stops;

int grid() {
    const char* asked = std::getenv("PETERKA_ATTACKED_GRID");
    return asked == nullptr ? 30 : std::stoi(asked);
}

class CertificateAttacks : public ::testing::TestWithParam<Stop> {
  protected:
    [[nodiscard]] static bool rigid() { return std::holds_alternative<job::Restitution>(GetParam().law); }
    [[nodiscard]] static const std::vector<SolvedPlace>& periodic_cells() {
        static std::map<std::string, std::vector<SolvedPlace>> known;
        const auto [cells, is_new] = known.try_emplace(GetParam().name);
        if (is_new) cells->second = testing::cells_of(regime::Regime::periodic, grid(), GetParam().law);
        return cells->second;
    }
    static void record(std::string_view kind, int tried, int refused) {
        std::cout << "attacks: " << GetParam().name << ": " << kind << ": " << tried << " tried, " << refused
                  << " refused\n";
    }
};

// The engine's result for a chain: how far its state at some phase 0 moves in q cycles, the number of touches
// in them, and the largest multiplier.
struct ByEngine {
    double moved = 0;
    int impacts = 0;
    double multiplier = 0;
};

template <class CycleMap>
ByEngine by_map(const CycleMap& map, const scene::State<double>& start, std::int64_t cycles) {
    scene::State<double> x = start;
    scene::Jacobian<double> product = scene::Jacobian<double>::Identity();
    ByEngine seen;
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle) {
        const auto result = map(x);
        product = result.jacobian * product;
        seen.impacts += result.impacts;
        x = result.end;
    }
    seen.moved = (x - start).norm();
    seen.multiplier = std::abs(trajectory::largest_multiplier(product.trace() / 2, product.determinant()));
    return seen;
}

ByEngine by_engine(const job::CellNumbers& numbers, EventChain chain) {
    Springs<Interval> enclosed(*rig_of(numbers));
    Springs<double> springs(middle(*rig_of(numbers)));
    if (chain.events.front().kind == EventKind::lift_off && find_lift_off(enclosed))
        springs.lift_off = enclosed.lift_off.middle();
    for (Event& event : chain.events) {  // Newton's method may have moved it to another cycle
        event.time += static_cast<double>(event.cycle) * springs.rig.period;
        sort_into_cycle(event, springs.rig.period);
    }
    std::size_t i = 0;
    while (i < chain.events.size() && chain.cycles_of_leg(i) < 1) ++i;  // its leg crosses the end of a cycle
    const auto leg = leg_of(springs, chain, places_of(chain), i).leg;
    const Moment<double> moment = leg.at(springs.rig.period - chain.events[i].time);
    // The hammer rests there if the leg after its last bounce crosses it.
    const bool rests = springs.rig.rigid && moment.state.position >= 0;
    const scene::State<double> start = rests
                                           ? scene::State<double>::Zero()
                                           : scene::State<double>(moment.state.position, moment.state.velocity);
    const scene::Oscillator<double> oscillator = testing::oscillator_at(numbers);
    return springs.rig.rigid ? by_map(trajectory::RigidExactMap<double>(oscillator), start, chain.period)
                             : by_map(trajectory::ExactCycleMap<double>(oscillator), start, chain.period);
}

// The chain near a claimed orbit, with or without chatter.
std::optional<EventChain> chain_near(const job::CellNumbers& numbers, const StroboscopicOrbit& orbit) {
    Springs<Interval> enclosed(*rig_of(numbers));
    Springs<double> springs(middle(*rig_of(numbers)));
    if (auto chain = find_chain(springs, orbit); chain || !springs.rig.rigid) return chain;
    if (!find_lift_off(enclosed)) return std::nullopt;
    springs.lift_off = enclosed.lift_off.middle();
    return find_chatter(enclosed, springs, orbit);
}

// Newton's method on its equations; returns whether it converged.
bool solve(const Springs<double>& springs, EventChain& chain) {
    double last = INFINITY;
    for (int steps = 0; steps < 30; ++steps) {
        const EquationsInDoubles equations = equations_in_doubles(springs, chain);
        const Eigen::VectorXd step = equations.derivatives.partialPivLu().solve(equations.residuals);
        for (std::size_t i = 0; i < chain.events.size(); ++i) {
            chain.events[i].time -= step[static_cast<Eigen::Index>(2 * i)];
            chain.events[i].along -= step[static_cast<Eigen::Index>(2 * i + 1)];
        }
        last = step.norm();
    }
    return last < 1e-10;
}

bool all_legs_are_free(const Springs<Interval>& springs, const EventChain& chain,
                       const std::vector<Place<Interval>>& box) {
    for (std::size_t i = 0; i < chain.events.size(); ++i) {
        if (!leg_is_free(springs, chain, box, i)) return false;
    }
    return true;
}

TEST_P(CertificateAttacks, PeriodsOfWhichAPartIsOneAreRefused) {
    int tried = 0;
    int without_proof = 0;
    int refused = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        for (const int factor : {2, 3}) {
            Claim claim = claim_of(place.cell);
            claim.orbit.impacts *= factor;
            claim.orbit.period *= factor;
            const Certified verdict = certify(place.numbers, claim).verdict;
            EXPECT_LT(verdict, Certified::not_tried);
            ++tried;
            without_proof += verdict < Certified::not_tried ? 1 : 0;
            refused += verdict == Certified::other_label ? 1 : 0;
        }
    }
    EXPECT_GT(refused, 300);
    record("a multiple of the period", tried, without_proof);
}

TEST_P(CertificateAttacks, OtherNumbersOfImpactsAreRefused) {
    int tried = 0;
    int refused = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        for (const int change : {-1, 1}) {
            Claim claim = claim_of(place.cell);
            claim.orbit.impacts += change;
            const Certified verdict = certify(place.numbers, claim).verdict;
            EXPECT_LT(verdict, Certified::not_tried);
            ++tried;
            refused += verdict < Certified::not_tried ? 1 : 0;
        }
    }
    record("another number of impacts", tried, refused);
}

// Period and events halved: usually the orbit that lost stability where this one was born.
TEST_P(CertificateAttacks, UnstableOrbitsAreRefused) {
    int tried = 0;
    int refused = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        if (place.cell.impacts % 2 == 1 || place.cell.period % 2 == 1) continue;
        const Springs<double> springs(middle(*rig_of(place.numbers)));
        const auto chain = find_chain(springs, claim_of(place.cell).orbit);
        if (!chain || chain->events.size() % 2 == 1) continue;
        EventChain half{chain->period / 2, {}};
        const std::size_t events = chain->events.size() / 2;
        for (std::size_t i = 0; i < events; ++i) {
            Event event = chain->events[i];
            event.time = 0.5 * (event.time + chain->events[i + events].time);
            event.along = 0.5 * (event.along + chain->events[i + events].along);
            half.events.push_back(event);
        }
        if (!solve(springs, half)) continue;
        const Springs<Interval> enclosed(*rig_of(place.numbers));
        const auto box = orbit_box(enclosed, springs, half);
        if (!box || !all_legs_are_free(enclosed, half, *box)) continue;
        const bool is_stable = stability_margin(enclosed, half, *box) > 0;
        EXPECT_EQ(is_stable, by_engine(place.numbers, half).multiplier < 1);
        ++tried;
        refused += is_stable ? 0 : 1;
    }
    EXPECT_GT(refused, 5);
    record("the orbit of half the period", tried, refused);
}

// A contact, or a release and the next touch, removed from the chain: its equations may well have a solution,
// usually one that passes through the stop or is pulled by it. If it is a motion after all, the engine must
// confirm it.
TEST_P(CertificateAttacks, AContactLeftOutIsRefused) {
    int tried = 0;
    int refused = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        const Springs<double> springs(middle(*rig_of(place.numbers)));
        const auto whole = find_chain(springs, claim_of(place.cell).orbit);
        if (!whole || whole->events.size() < (rigid() ? 2 : 4)) continue;
        const std::size_t per_contact = rigid() ? 1 : 2;
        for (std::size_t first = 0; first + per_contact <= whole->events.size(); ++first) {
            EventChain chain = *whole;
            const auto at = chain.events.begin() + static_cast<std::ptrdiff_t>(first);
            chain.events.erase(at, at + static_cast<std::ptrdiff_t>(per_contact));
            ++tried;
            if (!solve(springs, chain)) continue;
            const Springs<Interval> enclosed(*rig_of(place.numbers));
            const auto box = orbit_box(enclosed, springs, chain);
            if (!box) continue;
            if (!all_legs_are_free(enclosed, chain, *box)) {
                ++refused;
                continue;
            }
            const ByEngine seen = by_engine(place.numbers, chain);
            EXPECT_LT(seen.moved, 1e-6);
            EXPECT_EQ(seen.impacts, chain.impacts());
        }
    }
    EXPECT_GT(refused, 20);
    record(rigid() ? "a bounce left out" : "two events left out", tried, refused);
}

// Another gap, stop or damping: whatever is proved then must be what an engine finds there.
TEST_P(CertificateAttacks, OtherPlacesAndRigsAreProvedOnlyWhereTheEngineFindsTheSame) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> change(0.8, 1.25);
    int refused = 0;
    int proved = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        for (int kind = 0; kind < 3; ++kind) {
            job::CellNumbers numbers = place.numbers;
            if (kind == 0) numbers.place.gap_ratio *= change(random);
            if (auto* stop = std::get_if<job::KelvinVoigt>(&numbers.contact)) {
                if (kind == 1) stop->stiffness_n_per_m *= change(random);
                if (kind == 2) stop->damping_ns_per_m *= change(random);
            } else {
                if (kind == 1) std::get<job::Restitution>(numbers.contact).coefficient *= change(random);
                if (kind == 2)
                    numbers.hammer.damping_ns_per_m = *numbers.hammer.damping_ns_per_m * change(random);
            }
            const Certificate certificate = certify(numbers, claim_of(place.cell));
            if (!certificate.proved()) {
                ++refused;
                continue;
            }
            ++proved;
            const SolvedPlace again =
                testing::solved(numbers, place.cell.orbit_displacement,
                                place.cell.orbit_velocity + numbers.place.frequency_ratio);
            if (!regime::same_label(again.cell, place.cell)) {  // the start leads elsewhere
                const auto chain = chain_near(numbers, claim_of(place.cell).orbit);
                const ByEngine seen = by_engine(numbers, chain.value());
                EXPECT_LT(seen.moved, 1e-6);
                EXPECT_EQ(seen.impacts, place.cell.impacts);
                EXPECT_LT(seen.multiplier, 1);
                continue;
            }
            const auto scales = scene::scales_of(numbers);
            const auto& [bounds, seen] =
                rigid() ? std::pair(certificate.impact_speed,
                                    scales.in_unit_of_file(again.cell.impact_speed, cell::Dimension::speed))
                        : std::pair(certificate.force_ratio, again.cell.peak_force * scales.force_ratio());
            EXPECT_LT(std::abs(seen / bounds.middle() - 1), 1e-8);
        }
    }
    EXPECT_GT(refused, 20);
    EXPECT_GT(proved, 20);
    record(rigid() ? "another gap, restitution or damping" : "another gap, stiffness or damping",
           refused + proved, refused);
}

INSTANTIATE_TEST_SUITE_P(OnStops, CertificateAttacks, ::testing::ValuesIn(stops),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace peterka::certificate
