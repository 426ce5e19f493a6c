// Corrupted inputs: none may be proved where the statement is false. Each kind of corruption counts how many of
// its inputs came to the step that has to refuse them, so that none passes for want of trying.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "certificate/leg_proof.hpp"
#include "certificate/orbit_box.hpp"
#include "certificate/stability.hpp"
#include "certified_cells.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using testing::claim_of;
using testing::SolvedPlace;

constexpr int grid = 30;  // cells of a side

const std::vector<SolvedPlace>& periodic_cells() {
    static const std::vector<SolvedPlace> cells = testing::cells_of(regime::Regime::periodic, grid);
    return cells;
}

TEST(CertificateAttacks, PeriodsOfWhichAPartIsOneAreRefused) {
    int refused = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        for (const int factor : {2, 3}) {
            Claim claim = claim_of(place.cell);
            claim.orbit.impacts *= factor;
            claim.orbit.period *= factor;
            const Certified verdict = certify(place.numbers, claim).verdict;
            EXPECT_LT(verdict, Certified::not_tried);
            refused += verdict == Certified::other_label ? 1 : 0;
        }
    }
    EXPECT_GT(refused, 300);
}

TEST(CertificateAttacks, OtherNumbersOfImpactsAreRefused) {
    for (const SolvedPlace& place : periodic_cells()) {
        for (const int change : {-1, 1}) {
            Claim claim = claim_of(place.cell);
            claim.orbit.impacts += change;
            EXPECT_LT(certify(place.numbers, claim).verdict, Certified::not_tried);
        }
    }
}

// The orbit of half the period, which lost its stability where this one came into being.
TEST(CertificateAttacks, UnstableOrbitsAreRefused) {
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
        Eigen::VectorXd step = Eigen::VectorXd::Zero(0);
        for (int steps = 0; steps < 30; ++steps) {
            const EquationsInDoubles equations = equations_in_doubles(springs, half);
            step = equations.derivatives.partialPivLu().solve(equations.residuals);
            for (std::size_t i = 0; i < events; ++i) {
                half.events[i].time -= step[static_cast<Eigen::Index>(2 * i)];
                half.events[i].along -= step[static_cast<Eigen::Index>(2 * i + 1)];
            }
        }
        if (!(step.norm() < 1e-10)) continue;
        const Springs<Interval> enclosed(*rig_of(place.numbers));
        const auto box = orbit_box(enclosed, springs, half);
        if (!box) continue;
        EXPECT_FALSE(stability_margin(enclosed, half, *box) > 0);
        ++refused;
    }
    EXPECT_GT(refused, 5);
}

// Two neighbouring events out of the chain: its equations may well have a solution, which passes through the
// stop or is pulled by it.
TEST(CertificateAttacks, AContactLeftOutIsRefused) {
    int enclosed = 0;
    for (const SolvedPlace& place : periodic_cells()) {
        const Rig rig = *rig_of(place.numbers);
        const Springs<double> springs(middle(rig));
        const auto whole = find_chain(springs, claim_of(place.cell).orbit);
        if (!whole || whole->events.size() < 4) continue;
        for (std::size_t first = 0; first + 1 < whole->events.size(); ++first) {
            EventChain chain = *whole;
            const auto at = chain.events.begin() + static_cast<std::ptrdiff_t>(first);
            chain.events.erase(at, at + 2);
            for (int steps = 0; steps < 20; ++steps) {
                const EquationsInDoubles equations = equations_in_doubles(springs, chain);
                const Eigen::VectorXd step = equations.derivatives.partialPivLu().solve(equations.residuals);
                for (std::size_t i = 0; i < chain.events.size(); ++i) {
                    chain.events[i].time -= step[static_cast<Eigen::Index>(2 * i)];
                    chain.events[i].along -= step[static_cast<Eigen::Index>(2 * i + 1)];
                }
            }
            const Springs<Interval> exact(rig);
            const auto box = orbit_box(exact, springs, chain);
            if (!box) continue;
            ++enclosed;
            bool is_free = true;
            for (std::size_t i = 0; i < chain.events.size(); ++i) is_free &= leg_is_free(exact, chain, *box, i);
            EXPECT_FALSE(is_free);
        }
    }
    EXPECT_GT(enclosed, 20);
}

// Another gap, another stop, another damping: what is proved then has to be what an engine finds there.
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
            if (!regime::same_label(again, place.cell)) continue;  // the start led elsewhere
            const double force = again.peak_force * scene::scales_of(numbers).force_ratio();
            EXPECT_LT(std::abs(force / certificate.force_ratio.middle() - 1), 1e-8);
        }
    }
    EXPECT_GT(refused, 20);
    EXPECT_GT(proved, 20);
}

}  // namespace
}  // namespace peterka::certificate
