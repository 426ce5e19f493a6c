#include "certificate/start_way.hpp"

#include <cmath>

#include "certificate/find_chain.hpp"

namespace peterka::certificate {
namespace {

constexpr int most_events_of_a_way = 20'000;
constexpr double cycles_without_event = 60;
constexpr double smallest_change = 1e-10;  // of a way that has not yet settled

// Counted from `near`: its cycle, and a time within half a cycle from there.
void sort_around(Event& event, double near, double period) {
    event.cycle = static_cast<std::int64_t>(std::floor((event.time - near) / period + 0.5));
    event.time -= static_cast<double>(event.cycle) * period;
}

// Whether a way comes back to where it was at the last power of two (R. P. Brent, BIT 20, 1980): then it never
// leads elsewhere.
class Repeats {
  public:
    explicit Repeats(double distance) : distance_(distance) {}
    [[nodiscard]] bool now(const Event& event) {
        const double change = std::hypot(event.time - before_.time, event.along - before_.along);
        const bool again = events_ > 0 && event.kind == before_.kind && change < distance_;
        ++events_;
        if ((events_ & (events_ - 1)) == 0) before_ = event;
        return again;
    }

  private:
    double distance_;
    Event before_;
    unsigned events_ = 0;
};

}  // namespace

StartWay::StartWay(const Springs<Interval>& springs, const Springs<double>& approximate,
                   const Vector<Interval>& start)
    : springs_(&springs),
      approximate_(&approximate),
      start_(start),
      presses_(!springs.rig.rigid && start.position.positive() && springs.force(start).positive()) {}

StartWay::StartWay(const SpringsOf& springs, const Vector<Ball>& start)
    : StartWay(*springs.enclosed, *springs.approximate, {start.position.hull(), start.velocity.hull()}) {
    fine_springs_ = springs.fine;
    fine_start_ = start;
}

std::optional<Patch> StartWay::next_at(const Event& next) {
    if (fine_springs_ != nullptr) {
        const SpringsOf springs{springs_, approximate_, fine_springs_};
        fine_ = fine_ ? pass(springs, *fine_, next) : pass_from_start(springs, presses_, fine_start_, next);
        return fine_ ? std::optional(fine_->coarse()) : std::nullopt;
    }
    if (!at_) return pass_from_start(*springs_, presses_, start_, next);
    const std::optional<Passage> passage = pass(*springs_, *approximate_, *at_, next);
    return passage ? std::optional(passage->end) : std::nullopt;
}

StartWay::Step StartWay::go_on(double near) {
    const double period = approximate_->rig.period;
    Walk walk = at_ ? Walk::after(*approximate_, at_->event)
                    : Walk(*approximate_, 0, {start_.position.middle(), start_.velocity.middle()});
    Event next;
    if (walk.go_on(walk.time() + cycles_without_event * period, next) != Walk::End::event)
        return Step::no_event;
    sort_around(next, near, period);
    const std::optional<Patch> end = next_at(next);
    if (!end) return Step::lost;
    at_ = end;
    cycle_ += next.cycle;
    if (springs_->lift_off.positive()) rest_if_proved();
    return Step::proved;
}

void StartWay::rest_if_proved() {
    if (at_->event.kind != EventKind::bounce) return;
    const Place<Interval> impact = at_->hull();
    const double period = approximate_->rig.period;
    const double cycles = std::ceil((impact.time.hi - approximate_->lift_off) / period);
    const Interval left = springs_->lift_off + Interval(cycles) * springs_->rig.period - impact.time;
    if (!speed_before_rest(*springs_, impact, left)) return;
    at_ = patch_of(EventKind::lift_off, {springs_->lift_off, Interval(0)});
    if (fine_) fine_ = fine_patch_of(*at_);
    cycle_ += static_cast<std::int64_t>(cycles);
}

Leg<Interval> StartWay::leg(bool presses) const {
    if (!at_) return {springs_->phase(presses), Interval(0), start_};
    const Place<Interval> place = at_->hull();
    return {springs_->phase(presses), place.time, scaled(springs_->leaving(at_->event.kind), place.along)};
}

double StartWay::cycles() const {
    return at_ ? static_cast<double>(cycle_) + at_->event.time / approximate_->rig.period : 0;
}

Vector<double> StartWay::at_phase_0() const {
    if (!at_) return {start_.position.middle(), start_.velocity.middle()};
    const double period = approximate_->rig.period;
    const double phase_0 = std::ceil(at_->event.time / period) * period;
    Walk walk = Walk::after(*approximate_, at_->event);
    Event event;
    for (int events = 0; events < most_events_of_a_way; ++events) {
        const Walk::End end = walk.go_on(phase_0, event);
        if (end != Walk::End::event) break;
    }
    return walk.state();
}

Leads leads_to_orbit(StartWay& way, const Trap& trap) {
    Repeats repeats(1e-3 * trap.radius);
    for (int events = 0; events < most_events_of_a_way; ++events) {
        const StartWay::Step step = way.go_on(trap.event.time);
        if (step == StartWay::Step::lost) return Leads::unknown;
        if (step == StartWay::Step::no_event) return Leads::elsewhere;
        if (trap.holds(*way.at())) return Leads::there;
        if (repeats.now(way.at()->event)) return Leads::elsewhere;
    }
    return Leads::unknown;
}

Leads leads_to_rest(StartWay& way) {
    Repeats repeats(smallest_change);
    for (int events = 0; events < most_events_of_a_way; ++events) {
        const StartWay::Step step = way.go_on(0);
        if (step == StartWay::Step::lost) return Leads::unknown;
        if (step == StartWay::Step::no_event) return Leads::elsewhere;
        if (way.at()->event.kind == EventKind::lift_off) return Leads::there;
        if (repeats.now(way.at()->event)) return Leads::elsewhere;
    }
    return Leads::unknown;
}

Leads leads_to_steady(const Springs<Interval>& springs, StartWay& way, bool presses,
                      const SteadyMotion& motion) {
    Repeats repeats(smallest_change);
    for (int events = 0; events < most_events_of_a_way; ++events) {
        const StartWay::Step step = way.go_on(0);
        if (step == StartWay::Step::lost) return Leads::unknown;
        if (step == StartWay::Step::proved && repeats.now(way.at()->event)) return Leads::elsewhere;
        if (step == StartWay::Step::proved) continue;
        const auto from = way.at() ? std::optional(way.at()->event.kind) : std::nullopt;
        return keeps_to_phase(springs, presses, motion, way.leg(presses), from) ? Leads::there : Leads::unknown;
    }
    return Leads::unknown;
}

}  // namespace peterka::certificate
