// Proofs of where curves have given gaps, attacked by corrupted inputs: none may be proved if the statement is
// false. On the paper's stop, a rigid one and random rigs. PETERKA_ATTACKED_RIGS: how many of these (1), for
// endurance/certificates.py, which reads the counts that are recorded.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "curves/crossing_proof.hpp"
#include "curves/search.hpp"
#include "rig.hpp"

namespace peterka::curves {
namespace {

using certificate::BranchCrossing;
using certificate::BranchEvent;
using certificate::Crossed;
using certificate::crosses_within;
using certificate::CrossingProof;
using certificate::Interval;

job::Job curves_job(const job::Contact& stop, double damping_ns_per_m = 0.06) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::curves;
    job.hammer.damping_ns_per_m = damping_ns_per_m;
    job.contact = stop;
    job.columns = {.from = 0.5, .to = 4.5, .points = 32};
    job.rows = {.from = 0, .to = 5, .points = 32};
    job.curves.gap_ratio = {0, 0.5, 1.125, 3.375};
    job.certificate.cells = job::every_cell;
    return job;
}

int random_rigs() {
    const char* asked = std::getenv("PETERKA_ATTACKED_RIGS");
    return asked == nullptr ? 1 : std::stoi(asked);
}

std::vector<job::Job> attacked_jobs() {
    std::vector<job::Job> jobs{curves_job(job::KelvinVoigt{5.5e6, 1.2e3}), curves_job(job::Restitution{0.7})};
    std::mt19937_64 random(36);
    std::uniform_real_distribution<double> part(0, 1);
    const auto between = [&](double low, double high) { return low * std::pow(high / low, part(random)); };
    for (int rig = 0; rig < random_rigs(); ++rig) {
        const double damping = between(0.03, 1);
        const double stiffness = between(1e4, 1e7);
        const double stop_damping = between(1, 2e3);
        const double restitution = 0.2 + 0.7 * part(random);
        jobs.push_back(rig % 3 == 2 ? curves_job(job::Restitution{restitution}, damping)
                                    : curves_job(job::KelvinVoigt{stiffness, stop_damping}, damping));
    }
    return jobs;
}

struct Known {
    job::Job job;
    CrossingGuess guess;
    CrossingProof proof;
    double told;  // by the curve
};

std::vector<Curve> curves_of(const job::Job& job) {
    const Deal deal = [](std::int64_t count, const Task& task, const Done&) {
        std::vector<Numbers> results;
        for (std::int64_t i = 0; i < count; ++i) results.push_back(task(i));
        return results;
    };
    return find_curves(scene::Scene(job), deal).curves;
}

const std::vector<Known>& known_crossings() {
    static const std::vector<Known> known = [] {
        std::vector<Known> all;
        for (const job::Job& job : attacked_jobs()) {
            const Rig rig(job);
            for (const Curve& curve : curves_of(job)) {
                for (const Crossing& crossing : curve.crossings) {
                    const auto guess = guess_of(job, rig, curve.kind, crossing);
                    all.push_back({job, *guess, crossing.proof, crossing.place.column});
                }
            }
        }
        return all;
    }();
    return known;
}

void record(std::string_view kind, int tried, int refused) {
    std::cout << "attacks: crossings: " << kind << ": " << tried << " tried, " << refused << " refused\n";
}

// The orbit near the true place, but an interval that it is not in: which is claimed to hold it.
int refused_within(const job::CellNumbers& numbers, const BranchCrossing& crossing, const Interval& within,
                   int& tried) {
    ++tried;
    const Crossed verdict = crosses_within(numbers, crossing, within);
    EXPECT_NE(verdict, Crossed::proved) << within.lo << " " << within.hi;
    return verdict == Crossed::proved ? 0 : 1;
}

TEST(CrossingProofThorough, NineOfTenAreProvedAndHoldTheNumberTold) {
    int proved = 0;
    int narrow = 0;
    int again = 0;
    for (const Known& each : known_crossings()) {
        if (!each.proof.proved()) continue;
        ++proved;
        const Interval& at = each.proof.at;
        narrow += (at.hi - at.lo) < 1e-9 * at.hi ? 1 : 0;
        const double rounding = 1e-11 * each.told;  // of the curve
        EXPECT_GE(each.told, at.lo - rounding);
        EXPECT_LE(each.told, at.hi + rounding);
        // From a chain whose numbers are an ulp elsewhere, boxes that barely suffice may not: 1 of 1302 is
        // known.
        again += crosses_within(each.guess.numbers, each.guess.crossing, at) == Crossed::proved ? 1 : 0;
    }
    const auto tried = static_cast<int>(known_crossings().size());
    std::cout << "proved crossings: " << proved << " of " << tried << ", " << narrow << " to 1e-9\n";
    EXPECT_GE(tried, 100);
    EXPECT_GE(proved, tried * 9 / 10);
    EXPECT_GE(narrow, proved * 9 / 10);
    EXPECT_GE(again, proved * 99 / 100);
}

TEST(CrossingProofThorough, MovedIntervalsAreRefused) {
    int tried = 0;
    int refused = 0;
    for (const Known& each : known_crossings()) {
        if (!each.proof.proved()) continue;
        const Interval& at = each.proof.at;
        const double width = at.hi - at.lo;
        for (const double by : {-1e5, -100., -3., -1.1, 1.1, 3., 100., 1e5}) {
            if (std::abs(by) * width > 1e-5) continue;
            refused += refused_within(each.guess.numbers, each.guess.crossing,
                                      {at.lo + by * width, at.hi + by * width}, tried);
        }
    }
    record("another frequency", tried, refused);
    EXPECT_GT(refused, 300);
}

// Whether a curve of this rig, found without a proof, has the gap of `numbers` in an interval.
bool is_told_within(job::Job job, const job::CellNumbers& numbers, const Interval& at) {
    job.hammer = numbers.hammer;
    job.contact = numbers.contact;
    job.curves.gap_ratio = {numbers.gap_ratio()};
    for (const Curve& curve : curves_of(job)) {
        for (const Crossing& crossing : curve.crossings) {
            if (at.lo <= crossing.place.column && crossing.place.column <= at.hi) return true;
        }
    }
    return false;
}

// The crossing of another gap, or rig, in the interval proved for the right one. Near a resonance a wide
// interval may hold both: the statement is true then.
TEST(CrossingProofThorough, OtherGapsAndRigsAreRefused) {
    int tried = 0;
    int refused = 0;
    for (const Known& each : known_crossings()) {
        if (!each.proof.proved()) continue;
        for (const int kind : {0, 1, 2}) {
            job::CellNumbers numbers = each.guess.numbers;
            if (kind == 0) numbers.place.gap_ratio += 1e-4;
            if (kind == 1) numbers.hammer.damping_ns_per_m = *numbers.hammer.damping_ns_per_m * 1.02;
            if (kind == 2) {
                if (auto* stop = std::get_if<job::KelvinVoigt>(&numbers.contact)) {
                    stop->stiffness_n_per_m *= 1.01;
                } else {
                    std::get<job::Restitution>(numbers.contact).coefficient *= 1.001;
                }
            }
            // A free swing knows nothing of the stop.
            if (kind == 2 && each.guess.crossing.chain.impacts() == 0) continue;
            ++tried;
            if (crosses_within(numbers, each.guess.crossing, each.proof.at) == Crossed::proved) {
                EXPECT_TRUE(is_told_within(each.job, numbers, each.proof.at))
                    << each.guess.crossing.near << " " << kind;
                continue;
            }
            ++refused;
            // Where it then is, is another place.
            const CrossingProof there = prove_crossing(numbers, each.guess.crossing);
            if (there.proved()) {
                EXPECT_TRUE(there.at.apart(each.proof.at));
            }
        }
    }
    record("another gap, damping or stop", tried, refused);
    EXPECT_GT(refused, 200);
}

TEST(CrossingProofThorough, OtherKindsAreRefused) {
    int tried = 0;
    int refused = 0;
    for (const Known& each : known_crossings()) {
        if (!each.proof.proved()) continue;
        for (const BranchEvent event :
             {BranchEvent::fold, BranchEvent::period_doubling, BranchEvent::grazing}) {
            BranchCrossing other = each.guess.crossing;
            if (event == other.event) continue;
            other.event = event;
            std::erase_if(other.chain.events,
                          [](const certificate::Event& one) { return certificate::is_grazing(one.kind); });
            if (event == BranchEvent::grazing) {  // in the middle of a flight
                const std::size_t last = other.chain.events.size() - 1;
                certificate::Event grazing = other.chain.events[last];
                grazing.kind = certificate::EventKind::graze;
                grazing.time += 0.3;
                grazing.along = 0;
                other.chain.events.push_back(grazing);
            }
            refused += refused_within(each.guess.numbers, other, each.proof.at, tried);
        }
    }
    record("another kind", tried, refused);
    EXPECT_GT(refused, 200);
}

// A flight's largest delta taken for its smallest beyond the surface, or the other way round.
TEST(CrossingProofThorough, OtherGrazingsAreRefused) {
    int tried = 0;
    int refused = 0;
    int beyond_surface = 0;
    for (const Known& each : known_crossings()) {
        if (!each.proof.proved() || each.guess.crossing.event != BranchEvent::grazing) continue;
        BranchCrossing other = each.guess.crossing;
        for (certificate::Event& event : other.chain.events) {
            using certificate::EventKind;
            if (!certificate::is_grazing(event.kind)) continue;
            const bool is_beyond = event.kind == EventKind::resume_at_graze;
            beyond_surface += is_beyond ? 1 : 0;
            event.kind = is_beyond ? EventKind::graze : EventKind::resume_at_graze;
        }
        refused += refused_within(each.guess.numbers, other, each.proof.at, tried);
    }
    record("another grazing", tried, refused);
    EXPECT_GT(refused, 50);
    EXPECT_GT(beyond_surface, 0);
}

// A contact, or a bounce, removed from the chain.
TEST(CrossingProofThorough, AContactLeftOutIsRefused) {
    int tried = 0;
    int refused = 0;
    for (const Known& each : known_crossings()) {
        const bool rigid = std::holds_alternative<job::Restitution>(each.guess.numbers.contact);
        const std::size_t per_contact = rigid ? 1 : 2;
        for (std::size_t first = 0; first + per_contact <= each.guess.crossing.chain.events.size(); ++first) {
            BranchCrossing fewer = each.guess.crossing;
            const auto at = fewer.chain.events.begin() + static_cast<std::ptrdiff_t>(first);
            if (certificate::is_grazing(at->kind)) continue;
            fewer.chain.events.erase(at, at + static_cast<std::ptrdiff_t>(per_contact));
            if (!each.proof.proved()) continue;
            refused += refused_within(each.guess.numbers, fewer, each.proof.at, tried);
        }
    }
    record("a contact left out", tried, refused);
    EXPECT_GT(refused, 100);
}

// The same orbit, twice: q is not its smallest period.
TEST(CrossingProofThorough, TheDoubleOfAPeriodIsRefused) {
    int tried = 0;
    int refused = 0;
    for (const Known& each : known_crossings()) {
        if (!each.proof.proved() || each.guess.crossing.event == BranchEvent::grazing) continue;
        BranchCrossing twice = each.guess.crossing;
        for (certificate::Event event : each.guess.crossing.chain.events) {
            event.cycle += twice.chain.period;
            twice.chain.events.push_back(event);
        }
        twice.chain.period *= 2;
        refused += refused_within(each.guess.numbers, twice, each.proof.at, tried);
    }
    record("a multiple of the period", tried, refused);
    EXPECT_GT(refused, 30);
}

}  // namespace
}  // namespace peterka::curves
