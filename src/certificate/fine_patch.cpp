#include "certificate/fine_patch.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::certificate {
namespace {

constexpr int most_sharpenings = 20;
constexpr slong smallest_exponent = -1'000'000;
constexpr slong largest_exponent = 2'000;  // of no double

Place<Ball> middle_of(const Place<Ball>& place) {
    return {place.time.middle(), place.along.middle()};
}

Place<Ball> as_balls(const Place<Interval>& place) {
    return {Ball(place.time), Ball(place.along)};
}

// Interval Newton for one motion, of which it is proved that it meets the event in `box`, and nowhere else
// there.
std::optional<Place<Ball>> sharpened(const Springs<Ball>& springs, const Leg<Ball>& leg, const Ball& before,
                                     EventKind to, Place<Ball> box) {
    const Vector<Ball> surface = springs.surface(to);
    const Vector<Ball> of_along = scaled(surface, Ball(-1));
    for (int steps = 0; steps < most_sharpenings; ++steps) {
        const Place<Ball> guess = middle_of(box);
        const Vector<Ball> residual =
            leg.end(guess.time + before, guess.time).state - scaled(surface, guess.along);
        const Moment<Ball> met = leg.end(box.time + before, box.time);
        const Vector<Ball> of_time{met.state.velocity, leg.phase().acceleration(met.state, met.angle.sine)};
        const Vector<Ball> step = inverse(columns(of_time, of_along)) * residual;
        const Place<Ball> image{guess.time - step.position, guess.along - step.velocity};
        const auto time = common_part(box.time, image.time);
        const auto along = common_part(box.along, image.along);
        if (!time || !along) return std::nullopt;
        if (!std::isfinite(time->size()) || !std::isfinite(along->size())) break;
        const bool shrinks =
            time->radius() < 0.5 * box.time.radius() || along->radius() < 0.5 * box.along.radius();
        box = {*time, *along};
        if (!shrinks) break;
    }
    return box;
}

// A box that contains 0, times 2^shift, or a larger one.
Vector<Interval> shifted(const Vector<Interval>& box, slong shift) {
    return scaled(box, Interval(std::ldexp(1.0, static_cast<int>(std::max<slong>(shift, -1000)))));
}

// The set of (time, along) `directions` R', R' being `spread` over 2^exponent, around an enclosed place.
FinePatch set_around(EventKind kind, const Place<Ball>& end, const Matrix<Interval>& directions,
                     const Vector<Interval>& spread, slong exponent) {
    FinePatch set{kind, middle_of(end), frame_along(directions, spread), {}, exponent};
    const slong of_radius = std::max(end.time.exponent_of_radius(), end.along.exponent_of_radius());
    set.exponent = std::max(exponent, std::clamp(of_radius, smallest_exponent, largest_exponent));
    const double time = end.time.radius_over(set.exponent);
    const double along = end.along.radius_over(set.exponent);
    const Matrix<Interval> turned = inverse(set.frame);
    set.spread = (turned * directions) * shifted(spread, exponent - set.exponent) +
                 turned * Vector<Interval>{Interval(-time, time), Interval(-along, along)};
    const double size = std::max(set.spread.position.size(), set.spread.velocity.size());
    if (!(size > 0) || !std::isfinite(size)) return set;
    const int shift = std::clamp(-std::ilogb(size), -1000, 1000);
    set.spread = shifted(set.spread, shift);
    set.exponent -= shift;
    return set;
}

}  // namespace

Patch FinePatch::coarse() const {
    const Vector<Interval> around = shifted(frame * spread, exponent);
    return patch_of(kind, {middle.time.hull() + around.position, middle.along.hull() + around.velocity});
}

FinePatch fine_patch_of(const Patch& patch) {
    return {patch.event.kind, {Ball(patch.event.time), Ball(patch.event.along)}, patch.frame, patch.spread, 0};
}

std::optional<FinePatch> pass(const SpringsOf& springs, const FinePatch& from, const Event& to) {
    const auto passage = pass(*springs.enclosed, *springs.approximate, from.coarse(), to);
    if (!passage) return std::nullopt;
    const Leg<Ball> leg(springs.fine->phase(presses_after(from.kind)), from.middle.time,
                        scaled(springs.fine->leaving(from.kind), from.middle.along));
    const Ball before = Ball(static_cast<double>(to.cycle)) * springs.fine->rig.period - from.middle.time;
    const auto end = sharpened(*springs.fine, leg, before, to.kind, as_balls(passage->end.hull()));
    if (!end) return std::nullopt;
    return set_around(to.kind, *end, passage->derivative * from.frame, from.spread, from.exponent);
}

std::optional<FinePatch> pass_from_start(const SpringsOf& springs, bool presses, const Vector<Ball>& state,
                                         const Event& to) {
    const auto patch =
        pass_from_start(*springs.enclosed, presses, {state.position.hull(), state.velocity.hull()}, to);
    if (!patch) return std::nullopt;
    const Leg<Ball> leg(springs.fine->phase(presses), Ball(0), state);
    const Ball before = Ball(static_cast<double>(to.cycle)) * springs.fine->rig.period;
    const auto end = sharpened(*springs.fine, leg, before, to.kind, as_balls(patch->hull()));
    if (!end) return std::nullopt;
    return set_around(to.kind, *end, {}, {Interval(0), Interval(0)}, smallest_exponent);
}

}  // namespace peterka::certificate
