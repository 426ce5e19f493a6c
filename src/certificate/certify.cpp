#include "certificate/certify.hpp"

#include <array>

#include "certificate/chatter.hpp"
#include "certificate/leg_proof.hpp"
#include "certificate/orbit_box.hpp"
#include "certificate/peak_force.hpp"
#include "certificate/smallest_period.hpp"
#include "certificate/stability.hpp"
#include "certificate/start_way.hpp"
#include "certificate/steady_motion.hpp"

namespace peterka::certificate {
namespace {

using cell::Certified;
using Places = std::vector<Place<Interval>>;

Certificate refused(Certified reason) {
    return {.verdict = reason};
}

// In A0 omega.
Interval largest_impact_speed(const Places& places) {
    Interval largest(0);
    for (const Place<Interval>& place : places) largest = larger(largest, place.along);
    return largest;
}

// Of a way in many digits: a way that the first bits lose is followed once more with the second, where springs
// are linear. With a cubic term the order of its Taylor series would have to grow, too, and the time tenfold.
constexpr std::array<slong, 2> bits_of_ways = {448, 1792};

// What a certificate is about, and what is to be proved.
struct Case {
    Springs<Interval> springs;
    Springs<double> approximate;
    EnclosedStart<Interval> start;
    OfStart of_start;
    const job::CellNumbers* numbers;

    double followed = 0;  // cycles of the last way, as far as it is proved
    std::optional<SettledStart> elsewhere = {};

    // Whether a motion from the start is proved to lead where leads(way) says, in doubles or, if requested, in
    // many digits; if not, `elsewhere` is where it leads, if known.
    template <class Where>
    [[nodiscard]] bool start_leads(Where leads) {
        if (of_start == OfStart::if_it_keeps_its_phase) return false;
        Leads led = follow(leads, way());
        if (of_start != OfStart::in_many_digits) return led == Leads::there;
        for (const slong bits : bits_of_ways) {
            if (led != Leads::unknown) break;
            const Ball::Precision precision(bits);
            const Springs<Ball> fine(*rig_of<Ball>(*numbers));
            if (!chooses_same_direction(fine)) break;
            const double before = followed;
            led = follow(leads, fine_way(fine));
            if (followed <= before || approximate.rig.cubic != 0) break;
        }
        return led == Leads::there;
    }
    [[nodiscard]] StartWay way() const { return {springs, approximate, from(start, springs.rig)}; }

  private:
    template <class Where>
    [[nodiscard]] Leads follow(Where where, StartWay way) {
        const Leads leads = where(way);
        followed = way.cycles();
        if (leads == Leads::elsewhere) {
            const Vector<double> settled = way.at_phase_0();
            elsewhere = {settled.position + approximate.rig.gap, settled.velocity, followed};
        }
        return leads;
    }
    // Not so where rounding chose another direction of the surface of releases, kappa and chi being next to
    // equal.
    [[nodiscard]] bool chooses_same_direction(const Springs<Ball>& fine) const {
        return fine.release.velocity.positive() == springs.release.velocity.positive();
    }
    [[nodiscard]] StartWay fine_way(const Springs<Ball>& fine) const {
        return {SpringsOf{&springs, &approximate, &fine}, from(start_of<Ball>(*numbers), fine.rig)};
    }
    // A start on the surface is distinguished from one next to it only if both numbers are exact.
    template <class Number>
    [[nodiscard]] Vector<Number> from(const EnclosedStart<Number>& begin, const RigOf<Number>& rig) const {
        const bool touches = springs.rig.gap.lo == springs.rig.gap.hi &&
                             start.displacement.lo == springs.rig.gap.lo &&
                             start.displacement.hi == springs.rig.gap.hi;
        return {touches ? Number(0) : begin.displacement - rig.gap, begin.velocity - rig.frequency};
    }
};

// An orbit that comes to rest on a rigid stop (chatter.hpp).
Certificate certify_chatter(Case& it, const StroboscopicOrbit& orbit) {
    Springs<Interval>& springs = it.springs;
    if (!find_lift_off(springs)) return refused(Certified::no_orbit_found);
    it.approximate.lift_off = springs.lift_off.middle();
    const std::optional<EventChain> chain = find_chatter(springs, it.approximate, orbit);
    if (!chain) return refused(Certified::no_orbit_found);
    const std::optional<Places> places = orbit_box(springs, it.approximate, *chain);
    if (!places) return refused(Certified::no_orbit_enclosed);
    for (std::size_t i = 0; i + 1 < places->size(); ++i) {
        if (!leg_is_free(springs, *chain, *places, i)) return refused(Certified::near_grazing);
    }
    const std::optional<double> later_speed = comes_to_rest(springs, *chain, *places);
    if (!later_speed) return refused(Certified::near_grazing);
    if (impacts_with_chatter(springs, *chain, *places) != orbit.impacts) return refused(Certified::other_label);
    const bool from_start = it.start_leads(leads_to_rest);
    return {.verdict = from_start ? Certified::start : Certified::orbit,
            .impact_speed = larger(largest_impact_speed(*places), Interval(0, *later_speed)),
            .stability_margin = 1};
}

// Whether the start of a proved orbit's cell is proved to lead to it.
bool start_leads_to(Case& it, const EventChain& chain, const Places& places) {
    if (it.of_start == OfStart::if_it_keeps_its_phase) return false;
    if (it.springs.rig.rigid && find_lift_off(it.springs))
        it.approximate.lift_off = it.springs.lift_off.middle();
    const std::optional<Trap> trap = find_trap(it.springs, it.approximate, chain, places);
    return trap && it.start_leads([&](StartWay& way) { return leads_to_orbit(way, *trap); });
}

Certificate certify_orbit(Case& it, const StroboscopicOrbit& orbit) {
    if (orbit.period < 1) return refused(Certified::no_orbit_found);
    const Springs<Interval>& springs = it.springs;
    const bool rigid = springs.rig.rigid;
    const std::optional<EventChain> chain = find_chain(it.approximate, orbit);
    const bool is_claimed = chain && chain->impacts() == orbit.impacts;
    if (!is_claimed && rigid) {
        // of a chatter rounding may leave a finite chain of bounces, all of which the label counts as one
        const Certificate chattering = certify_chatter(it, orbit);
        return chain && chattering.verdict < Certified::orbit ? refused(Certified::other_label) : chattering;
    }
    if (!is_claimed) return refused(chain ? Certified::other_label : Certified::no_orbit_found);
    const std::optional<Places> places = orbit_box(springs, it.approximate, *chain);
    if (!places) return refused(Certified::no_orbit_enclosed);
    for (std::size_t i = 0; i < places->size(); ++i) {
        if (!leg_is_free(springs, *chain, *places, i)) return refused(Certified::near_grazing);
    }
    if (!has_no_smaller_period(*chain, *places)) return refused(Certified::other_label);
    const double margin = stability_margin(springs, *chain, *places);
    if (!(margin > 0)) return refused(Certified::not_surely_stable);
    Certificate certificate{.verdict = Certified::orbit, .stability_margin = margin};
    if (rigid) {
        certificate.impact_speed = largest_impact_speed(*places);
    } else {
        certificate.force_ratio = peak_force(springs, *chain, *places);
        if (!certificate.force_ratio.positive()) return refused(Certified::force_not_bounded);
    }
    if (start_leads_to(it, *chain, *places)) certificate.verdict = Certified::start;
    return certificate;
}

Certificate certify_steady(Case& it, bool presses) {
    const Springs<Interval>& springs = it.springs;
    const std::optional<SteadyMotion> motion = steady_motion(springs, presses);
    if (!motion) return refused(Certified::near_grazing);
    if (!(motion->margin > 0)) return refused(Certified::not_surely_stable);
    const bool from_start =
        keeps_to_phase(springs, presses, *motion, it.way().leg(presses), std::nullopt) ||
        it.start_leads([&](StartWay& way) { return leads_to_steady(springs, way, presses, *motion); });
    return {.verdict = from_start ? Certified::start : Certified::orbit,
            .force_ratio = motion->force,
            .impact_speed = springs.rig.rigid ? Interval(0) : nothing(),
            .stability_margin = motion->margin,
            .last_event = it.followed};
}

bool has_theorem(cell::Regime regime) {
    return regime == cell::Regime::no_impact || regime == cell::Regime::periodic ||
           regime == cell::Regime::sustained_contact;
}

}  // namespace

Certificate certify(const job::CellNumbers& numbers, const Claim& claim, OfStart of_start) {
    if (!has_theorem(claim.regime)) return {};
    const std::optional<Rig> rig = rig_of(numbers);
    if (!rig) return refused(Certified::other_stop);
    Case it{Springs<Interval>(*rig), Springs<double>(middle(*rig)), start_of(numbers), of_start, &numbers};
    if (it.springs.flight.is_too_bent()) return refused(Certified::cubic_spring);
    Certificate certificate = claim.regime == cell::Regime::periodic
                                  ? certify_orbit(it, claim.orbit)
                                  : certify_steady(it, claim.regime == cell::Regime::sustained_contact);
    if (certificate.verdict != Certified::start) certificate.elsewhere = it.elsewhere;
    if (certificate.force_ratio.hi > 0)
        certificate.force_ratio = certificate.force_ratio * force_ratio(numbers);
    if (certificate.impact_speed.hi > 0)
        certificate.impact_speed = certificate.impact_speed * speed_unit(numbers);
    return certificate;
}

}  // namespace peterka::certificate
