#include "curves/crossing_proof.hpp"

#include <cmath>

#include "curves/asked_gaps.hpp"

namespace peterka::curves {

namespace {

certificate::EventKind kind_of(const Event& event, bool rigid) {
    switch (event.kind) {
        case EventKind::touch:
            return rigid ? certificate::EventKind::bounce : certificate::EventKind::touch;
        case EventKind::release:
            return certificate::EventKind::release;
        case EventKind::resume:
            return certificate::EventKind::resume;
        case EventKind::graze:
            break;
    }
    return event.presses ? certificate::EventKind::resume_at_graze : certificate::EventKind::graze;
}

certificate::BranchEvent event_of(CurveKind kind) {
    if (kind == CurveKind::fold) return certificate::BranchEvent::fold;
    return kind == CurveKind::grazing ? certificate::BranchEvent::grazing
                                      : certificate::BranchEvent::period_doubling;
}

certificate::EventChain chain_of(const certificate::Springs<double>& springs, const PlacedRig& rig,
                                 const Orbit& orbit) {
    certificate::EventChain chain{orbit.period, {}};
    for (const Event& event : orbit.events) {
        const State<double> state = rig.arrival(event);
        certificate::Event same{.kind = kind_of(event, rig.is_rigid()), .time = event.time};
        same.along = springs.along(same.kind, {state[0], state[1]});
        sort_into_cycle(same, springs.rig.period);
        chain.events.push_back(same);
    }
    return chain;
}

// The gap of the job's list at which the crossing was sought, in the unit of the list.
double asked_gap(const job::Job& job, const Rig& rig, const Crossing& crossing) {
    const double at = coordinate(crossing.place, gap_axis(job));
    const std::vector<double> gaps = asked_gaps(rig, job);
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < gaps.size(); ++i) {
        if (std::abs(gaps[i] - at) < std::abs(gaps[nearest] - at)) nearest = i;
    }
    return job.curves.gaps()[nearest];
}

}  // namespace

std::optional<CrossingGuess> guess_of(const job::Job& job, const Rig& rig, CurveKind kind,
                                      const Crossing& crossing) {
    const std::size_t along = 1 - gap_axis(job);
    const std::string& key = rig.key(along);
    const double near = coordinate(rig.values_at(crossing.place), along);
    CrossingGuess guess{job::numbers_in(job), {event_of(kind), {}, key, near}};
    job::set_number(guess.numbers, job.curves.gap_key(), asked_gap(job, rig, crossing));
    job::CellNumbers there = guess.numbers;
    job::set_number(there, key, near);
    const std::optional<certificate::Rig> enclosed = certificate::rig_of(there);
    if (!enclosed) return std::nullopt;
    const certificate::Springs<double> springs(certificate::middle(*enclosed));
    guess.crossing.chain = chain_of(springs, rig.at(crossing.place), crossing.orbit);
    return guess;
}

certificate::CrossingProof proof_of(const job::Job& job, const Rig& rig, CurveKind kind,
                                    const Crossing& crossing) {
    const std::optional<CrossingGuess> guess = guess_of(job, rig, kind, crossing);
    if (!guess) return {certificate::Crossed::other_stop};
    return certificate::prove_crossing(guess->numbers, guess->crossing);
}

}  // namespace peterka::curves
