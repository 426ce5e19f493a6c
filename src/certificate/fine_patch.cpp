#include "certificate/fine_patch.hpp"

#include <cmath>

namespace peterka::certificate {
namespace {

constexpr int most_sharpenings = 20;

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

}  // namespace

Patch FinePatch::coarse() const {
    const Vector<Interval> around = frame * spread;
    return patch_of(kind, {middle.time.hull() + around.position, middle.along.hull() + around.velocity});
}

FinePatch fine_patch_of(const Patch& patch) {
    return {patch.event.kind, {Ball(patch.event.time), Ball(patch.event.along)}, patch.frame, patch.spread};
}

std::optional<FinePatch> pass(const SpringsOf& springs, const FinePatch& from, const Event& to) {
    const auto passage = pass(*springs.enclosed, *springs.approximate, from.coarse(), to);
    if (!passage) return std::nullopt;
    const Leg<Ball> leg(springs.fine->phase(presses_after(from.kind)), from.middle.time,
                        scaled(springs.fine->leaving(from.kind), from.middle.along));
    const Ball before = Ball(static_cast<double>(to.cycle)) * springs.fine->rig.period - from.middle.time;
    const auto end = sharpened(*springs.fine, leg, before, to.kind, as_balls(passage->end.hull()));
    if (!end) return std::nullopt;
    FinePatch next{to.kind, middle_of(*end), {}, {}};
    const Vector<Interval> rounding{Interval(-end->time.radius(), end->time.radius()),
                                    Interval(-end->along.radius(), end->along.radius())};
    const Matrix<Interval> directions = passage->derivative * from.frame;
    next.frame = frame_along(directions, from.spread);
    const Matrix<Interval> turned = inverse(next.frame);
    next.spread = (turned * directions) * from.spread + turned * rounding;
    return next;
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
    return FinePatch{to.kind,
                     middle_of(*end),
                     {},
                     {Interval(-end->time.radius(), end->time.radius()),
                      Interval(-end->along.radius(), end->along.radius())}};
}

}  // namespace peterka::certificate
