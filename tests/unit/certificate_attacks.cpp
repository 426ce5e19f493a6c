// Corrupted inputs: none may be proved if the statement is false. For each kind of corruption the inputs that
// reach the rejecting step are counted, so that the test cannot pass vacuously. PETERKA_ATTACKED_GRID: cells
// per side (30), for endurance/certificates.py, which reads the counts that are recorded.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <string_view>

#include "certificate/leg_proof.hpp"
#include "certificate/orbit_box.hpp"
#include "certificate/stability.hpp"
#include "certified_cells.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using testing::claim_of;
using testing::SolvedPlace;

int grid() {
    const char* asked = std::getenv("PETERKA_ATTACKED_GRID");
    return asked == nullptr ? 30 : std::stoi(asked);
}

void record(std::string_view kind, int tried, int refused) {
    std::cout << "attacks: " << kind << ": " << tried << " tried, " << refused << " refused\n";
}

const std::vector<SolvedPlace>& periodic_cells() {
    static const std::vector<SolvedPlace> cells = testing::cells_of(regime::Regime::periodic, grid());
    return cells;
}

// The engine's result for a chain: how far its state at some phase 0 moves in q cycles, the number of touches
// in them, and the largest multiplier.
struct ByEngine {
    double moved = 0;
    int impacts = 0;
    double multiplier = 0;
};

ByEngine by_engine(const job::CellNumbers& numbers, const EventChain& chain) {
    const Springs<double> springs(middle(*rig_of(numbers)));
    std::size_t i = 0;
    while (chain.cycles_of_leg(i) < 1) ++i;  // its leg crosses the end of a cycle
    const auto leg = leg_of(springs, chain, places_of(chain), i).leg;
    const Moment<double> moment = leg.at(springs.rig.period - chain.events[i].time);
    const scene::State<double> start(moment.state.position, moment.state.velocity);
    scene::State<double> x = start;
    scene::Jacobian<double> product = scene::Jacobian<double>::Identity();
    ByEngine seen;
    const trajectory::ExactCycleMap<double> map(testing::oscillator_at(numbers));
    for (std::int64_t cycle = 0; cycle < chain.period; ++cycle) {
        const auto result = map(x);
        product = result.jacobian * product;
        seen.impacts += result.impacts;
        x = result.end;
    }
    seen.moved = (x - start).norm();
    seen.multiplier = product.eigenvalues().cwiseAbs().maxCoeff();
    return seen;
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

TEST(CertificateAttacks, PeriodsOfWhichAPartIsOneAreRefused) {
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

TEST(CertificateAttacks, OtherNumbersOfImpactsAreRefused) {
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
TEST(CertificateAttacks, UnstableOrbitsAreRefused) {
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

// Two neighbouring events removed from the chain: its equations may well have a solution, usually one that
// passes through the stop or is pulled by it. If it is a motion after all, the engine must confirm it.
TEST(CertificateAttacks, AContactLeftOutIsRefused) {
    int tried = 0;
    int refused = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        const Springs<double> springs(middle(*rig_of(place.numbers)));
        const auto whole = find_chain(springs, claim_of(place.cell).orbit);
        if (!whole || whole->events.size() < 4) continue;
        for (std::size_t first = 0; first + 1 < whole->events.size(); ++first) {
            EventChain chain = *whole;
            const auto at = chain.events.begin() + static_cast<std::ptrdiff_t>(first);
            chain.events.erase(at, at + 2);
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
    record("two events left out", tried, refused);
}

// Another gap, stop or damping: whatever is proved then must be what an engine finds there.
TEST(CertificateAttacks, OtherPlacesAndRigsAreProvedOnlyWhereTheEngineFindsTheSame) {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> change(0.8, 1.25);
    int refused = 0;
    int proved = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        for (int kind = 0; kind < 3; ++kind) {
            job::CellNumbers numbers = place.numbers;
            auto& stop = std::get<job::KelvinVoigt>(numbers.contact);
            if (kind == 0) numbers.place.gap_ratio *= change(random);
            if (kind == 1) stop.stiffness_n_per_m *= change(random);
            if (kind == 2) stop.damping_ns_per_m *= change(random);
            const Certificate certificate = certify(numbers, claim_of(place.cell));
            if (!certificate.proved()) {
                ++refused;
                continue;
            }
            ++proved;
            const regime::CellResult again =
                testing::solve(testing::oscillator_at(numbers), place.cell.orbit_displacement,
                               place.cell.orbit_velocity + numbers.place.frequency_ratio);
            if (!regime::same_label(again, place.cell)) {  // the start leads elsewhere
                const auto chain =
                    find_chain(Springs<double>(middle(*rig_of(numbers))), claim_of(place.cell).orbit);
                const ByEngine seen = by_engine(numbers, chain.value());
                EXPECT_LT(seen.moved, 1e-6);
                EXPECT_EQ(seen.impacts, place.cell.impacts);
                EXPECT_LT(seen.multiplier, 1);
                continue;
            }
            const double force = again.peak_force * scene::scales_of(numbers).force_ratio();
            EXPECT_LT(std::abs(force / certificate.force_ratio.middle() - 1), 1e-8);
        }
    }
    EXPECT_GT(refused, 20);
    EXPECT_GT(proved, 20);
    record("another gap, stiffness or damping", refused + proved, refused);
}

}  // namespace
}  // namespace peterka::certificate
