#include "curves/mpi_packing.hpp"

namespace peterka::curves {

namespace {

template <class Integer>
double as_number(Integer value) {
    return static_cast<double>(value);
}

void pack(const PlanePoint& place, Numbers& to) {
    to.insert(to.end(), {place.column, place.row});
}

}  // namespace

void pack(const OrbitPoint& point, Numbers& to) {
    pack(point.place, to);
    to.insert(to.end(), {as_number(point.orbit.period), as_number(point.orbit.events.size())});
    for (const Event& event : point.orbit.events) {
        to.insert(to.end(), {as_number(event.kind), event.presses ? 1.0 : 0.0, event.time, event.velocity});
    }
}

OrbitPoint unpack_point(NumberReader& from) {
    OrbitPoint point;
    point.place = from.place();
    point.orbit.period = from.integer();
    point.orbit.events.resize(static_cast<std::size_t>(from.integer()));
    for (Event& event : point.orbit.events) {
        event.kind = static_cast<EventKind>(from.integer());
        event.presses = from.number() != 0;
        event.time = from.number();
        event.velocity = from.number();
    }
    return point;
}

void pack(const Seed& seed, Numbers& to) {
    to.push_back(as_number(seed.kind));
    pack(seed.point, to);
}

Seed unpack_seed(NumberReader& from) {
    const auto kind = static_cast<CurveKind>(from.integer());
    return {kind, unpack_point(from)};
}

void pack(const Curve& curve, Numbers& to) {
    to.insert(to.end(), {as_number(curve.kind), as_number(curve.impacts), as_number(curve.period),
                         as_number(curve.begins), as_number(curve.ends), as_number(curve.edge),
                         as_number(curve.points.size()), as_number(curve.specials.size()),
                         as_number(curve.crossings.size())});
    for (const CurvePoint& point : curve.points) {
        pack(point.place, to);
        to.insert(to.end(),
                  {point.multiplier, point.peak_force, point.residual, point.at_phase_0[0], point.at_phase_0[1],
                   point.trace, point.total_speed, static_cast<double>(point.impacts), as_number(point.edge)});
    }
    for (const Special& special : curve.specials) {
        to.push_back(as_number(special.kind));
        pack(special.place, to);
    }
    for (const Crossing& crossing : curve.crossings) {
        pack(OrbitPoint{crossing.orbit, crossing.place}, to);
        to.insert(to.end(), {crossing.multiplier, crossing.peak_force});
    }
}

Curve unpack_curve(NumberReader& from) {
    Curve curve;
    curve.kind = static_cast<CurveKind>(from.integer());
    curve.impacts = from.integer();
    curve.period = from.integer();
    curve.begins = static_cast<CurveEnd>(from.integer());
    curve.ends = static_cast<CurveEnd>(from.integer());
    curve.edge = static_cast<LabelEdge>(from.integer());
    curve.points.resize(static_cast<std::size_t>(from.integer()));
    curve.specials.resize(static_cast<std::size_t>(from.integer()));
    curve.crossings.resize(static_cast<std::size_t>(from.integer()));
    for (CurvePoint& point : curve.points) {
        point.place = from.place();
        point.multiplier = from.number();
        point.peak_force = from.number();
        point.residual = from.number();
        for (double& number : point.at_phase_0) number = from.number();
        point.trace = from.number();
        point.total_speed = from.number();
        point.impacts = from.integer();
        point.edge = static_cast<LabelEdge>(from.integer());
    }
    for (Special& special : curve.specials) {
        special.kind = static_cast<SpecialKind>(from.integer());
        special.place = from.place();
    }
    for (Crossing& crossing : curve.crossings) {
        const OrbitPoint point = unpack_point(from);
        crossing.orbit = point.orbit;
        crossing.place = point.place;
        crossing.multiplier = from.number();
        crossing.peak_force = from.number();
    }
    return curve;
}

void pack(const UnstableBranch& branch, Numbers& to) {
    to.insert(to.end(), {branch.gap, as_number(branch.impacts), as_number(branch.period),
                         as_number(branch.begins), as_number(branch.ends), as_number(branch.points.size())});
    for (const BranchPoint& point : branch.points) {
        to.insert(to.end(), {point.along, point.frequency, point.gap, point.force_ratio, point.multiplier,
                             point.peak_force, point.residual, as_number(point.at_phase_0.size()),
                             as_number(point.impact_times.size())});
        for (const State<double>& state : point.at_phase_0) to.insert(to.end(), {state[0], state[1]});
        to.insert(to.end(), point.impact_times.begin(), point.impact_times.end());
    }
}

UnstableBranch unpack_branch(NumberReader& from) {
    UnstableBranch branch;
    branch.gap = from.number();
    branch.impacts = from.integer();
    branch.period = from.integer();
    branch.begins = static_cast<BranchEnd>(from.integer());
    branch.ends = static_cast<BranchEnd>(from.integer());
    branch.points.resize(static_cast<std::size_t>(from.integer()));
    for (BranchPoint& point : branch.points) {
        point.along = from.number();
        point.frequency = from.number();
        point.gap = from.number();
        point.force_ratio = from.number();
        point.multiplier = from.number();
        point.peak_force = from.number();
        point.residual = from.number();
        point.at_phase_0.resize(static_cast<std::size_t>(from.integer()));
        point.impact_times.resize(static_cast<std::size_t>(from.integer()));
        for (State<double>& state : point.at_phase_0) {
            state[0] = from.number();
            state[1] = from.number();
        }
        for (double& time : point.impact_times) time = from.number();
    }
    return branch;
}

}  // namespace peterka::curves
