#include "report/certificate_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "job/twins.hpp"
#include "scene/scales.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using cell::Certified;

const char* reason(Certified certified) {
    switch (certified) {
        case Certified::force_not_bounded:
            return "the peak force isn't bounded within reasonable effort";
        case Certified::not_surely_stable:
            return "a multiplier can't be told from the unit circle";
        case Certified::near_grazing:
            return "it can't be told from a motion with another contact (near a grazing)";
        case Certified::no_orbit_enclosed:
            return "no box around it holds one orbit alone (near where it ends)";
        case Certified::other_label:
            return "the orbit that is there has another p or q";
        case Certified::no_orbit_found:
            return "the cell's state leads to no orbit to begin with (long periods, strong growth)";
        case Certified::other_stop:
            return "there is no theorem for this law of the stop";
        case Certified::cubic_spring:
            return "the springs' cubic term is too strong for the bounds that the proof rests on";
        case Certified::not_tried:
        case Certified::orbit:
        case Certified::start:
            break;
    }
    return "";
}

std::int64_t count(const findings::Counts& counts, Certified certified) {
    return counts.by_certificate[static_cast<std::size_t>(static_cast<int>(certified) - cell::first_certified)];
}

// In the order of the enum, from cubic_spring down.
std::string reasons(const findings::Counts& counts) {
    std::string text;
    for (int number = -1; number >= cell::first_certified; --number) {
        const auto certified = static_cast<Certified>(number);
        if (const std::int64_t cells = count(counts, certified); cells > 0) {
            text += fmt::format("  not proved          {}: {}\n", readable_count(cells), reason(certified));
        }
    }
    return text;
}

// With as many decimals as the distance of the bounds justifies, and rounded outwards.
std::string largest(const scene::Scene& scene, const findings::ProvedPeak& proved) {
    if (!(proved.upper > 0) || scene.rigs_differ()) return "";
    const bool rigid = job::is_rigid(scene.job().contact);
    const bool in_newton = !rigid && job::leads_in_si(scene.job());
    const double unit = in_newton ? scene::scales_of(scene.job()).weight_n : 1;
    const double lower = proved.lower * unit;
    const double upper = proved.upper * unit;
    const double width = std::max(upper - lower, 1e-15 * upper);
    const int decimals = std::clamp(static_cast<int>(-std::log10(width)), 0, 15);
    const double half = 0.5 * std::pow(10, -decimals) + 1e-15 * upper;
    return fmt::format("  {:<20}from {:.{}f} to {:.{}f} {}, of the cells that are proved\n",
                       rigid ? "largest speed" : "largest force", lower - half, decimals, upper + half,
                       decimals,
                       rigid       ? "m/s of an impact"
                       : in_newton ? "N"
                                   : "weights");
}

}  // namespace

std::string certificate_summary(const scene::Scene& scene, const findings::Statistics& statistics) {
    if (scene.job().certificate.cells == 0) return "";
    const findings::Counts& counts = statistics.counts;
    const std::int64_t from_start = count(counts, Certified::start);
    const std::int64_t proved = count(counts, Certified::orbit) + from_start;
    const std::int64_t tried = counts.cells - count(counts, Certified::not_tried);
    if (tried == 0) return "\nProofs in interval arithmetic: no cell tried has a motion that settles\n";
    std::string text =
        fmt::format("\nProofs in interval arithmetic, of {} cells\n  proved              {} ({})",
                    readable_count(tried), readable_count(proved), readable_share(proved, tried));
    if (from_start > 0)
        text += fmt::format(", in {} that the start leads there, too", readable_count(from_start));
    text += "\n" + reasons(counts) + largest(scene, statistics.proved);
    const bool rigid = job::is_rigid(scene.job().contact);
    if (proved > 0 && (!rigid || scene.job().output.has(cell::OptionalField::impact_speed))) {
        text += fmt::format(
            "  {} of the map   outside their proved bounds by {:.1e} at most, relative{}\n",
            rigid ? "speeds" : "forces", statistics.proved.furthest_outside,
            scene.cell(0, 0).oscillator.cubic == 0 ? "" : " (the bounds are with the cubic spring)");
    }
    return text;
}

}  // namespace peterka
