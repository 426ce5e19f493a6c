#include "trace/trace.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "trace/impact_window.hpp"
#include "trace/sampler.hpp"
#include "trajectory/contact_force.hpp"

namespace peterka::trace {

namespace {

// The largest frequency of the spectra, in omega.
double largest_frequency(const scene::Scene& scene) {
    return 2 * std::numbers::pi * scene.job().trace.spectrum_to_hz / scene.scales().frequency_rad_per_s;
}

// The job's width or, by default, three contact times, one of them before the touch; tau.
double width_of_window(const scene::Scene& scene, const Course& course, const Impact& impact) {
    const double asked = scene.job().trace.impact_window_s * scene.scales().frequency_rad_per_s;
    if (asked > 0) return asked;
    constexpr double share_of_period = 0.02;  // where an impact takes no time, or never ends
    const double contact = impact.end - impact.time;
    return contact > 0 ? 3 * contact : share_of_period * course.oscillator.period();
}

HardImpact look_closely(const scene::Scene& scene, const Trace& trace, std::size_t index) {
    constexpr double share_before = 1.0 / 3;
    constexpr std::int64_t lines = 1001;
    const Course& course = trace.course;
    const Impact& impact = trace.impacts[index];
    ImpactWindow window(course.oscillator,
                        plan_window(impact.touch, impact.time, width_of_window(scene, course, impact),
                                    share_before, scene.job().trace.impact_samples, course.length));
    follow(course, window);
    HardImpact seen{index, window.instants(), window.peak(), {}};
    const bool is_last = index + 1 == trace.impacts.size();
    const double next_touch = is_last ? course.length : trace.impacts[index + 1].time;
    const bool has_force = !std::isnan(impact.record.peak_force);
    if (has_force && impact.end > impact.time && next_touch > impact.end) {
        seen.spectrum = spectrum_of_impact(course, impact, next_touch, largest_frequency(scene), lines);
    }
    return seen;
}

}  // namespace

Trace make_trace(const scene::Scene& scene) {
    Trace trace{
        .course = prepare(scene), .totals = {}, .instants = {}, .impacts = {}, .hardest = {}, .spectrum = {}};
    const Course& course = trace.course;
    Sampler sampler(course.oscillator, course.length, scene.job().trace.samples_per_cycle);
    trace.totals = follow(course, sampler);
    trace.instants = sampler.instants();
    Impacts impacts(course.length);
    follow(course, impacts);
    trace.impacts = impacts.all();
    if (const auto index = impacts.hardest()) trace.hardest = look_closely(scene, trace, *index);
    trace.spectrum = spectrum_of_motion(course, largest_frequency(scene));
    return trace;
}

double force_at_touch(const scene::Oscillator<double>& oscillator, double speed) {
    return scene::is_rigid(oscillator.contact) ? regime::unknown
                                               : trajectory::contact_force(oscillator, State<double>(0, speed));
}

}  // namespace peterka::trace
