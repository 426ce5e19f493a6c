#include "curves/proof_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "certificate/rig.hpp"
#include "curves/asked_gaps.hpp"
#include "job/axis_key.hpp"
#include "job/axis_quantity.hpp"
#include "support/readable.hpp"

namespace peterka::curves {

namespace {

using certificate::Crossed;
using certificate::Interval;

const char* reason_of(Crossed verdict) {
    switch (verdict) {
        case Crossed::not_surely_crossed:
            return "it can't be told on which side of it an orbit is";
        case Crossed::near_grazing:
            return "the orbit can't be told from one with another contact (near a second grazing)";
        case Crossed::no_orbit_enclosed:
            return "no box around it holds one orbit alone";
        case Crossed::other_label:
            return "the orbit that is there has a smaller period";
        case Crossed::no_orbit_found:
            return "the search for it doesn't converge";
        case Crossed::other_stop:
            return "there is no theorem for this law of the stop";
        case Crossed::cubic_spring:
            return "the springs' cubic term is too strong for the bounds that the proof rests on";
        case Crossed::not_tried:
        case Crossed::proved:
            break;
    }
    return "";
}

// With as many decimals as the distance of the bounds justifies, and rounded outward.
std::string outward_text(const Interval& x) {
    const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(x.hi - x.lo))), 0, 16);
    const double half = 0.5 * std::pow(10, -decimals) * (1 + 1e-12);
    return fmt::format("{:.{}f} to {:.{}f}", certificate::down(x.lo - half), decimals,
                       certificate::up(x.hi + half), decimals);
}

bool has_cubic_spring(const job::Job& job) {
    return job.hammer.cubic_stiffness_n_per_m3 != 0;
}

// How far a number lies outside of its bounds, relative to it.
double outside(double number, const Interval& bounds) {
    return std::max({0.0, bounds.lo - number, number - bounds.hi}) / std::abs(number);
}

}  // namespace

std::string proof_in_words(const job::Job& job, std::string_view key, const certificate::CrossingProof& proof) {
    if (!proof.proved()) return "";
    const bool is_ratio = job::is_frequency(key) && !job::is_in_si(key);
    const Interval at =
        is_ratio ? proof.at * certificate::natural_frequency_hz(job::numbers_in(job)) : proof.at;
    return fmt::format(" (proved{}: {})", has_cubic_spring(job) ? ", with the cubic spring" : "",
                       outward_text(at));
}

std::string proofs_in_words(const scene::Scene& scene, const CurveSearchResult& found) {
    const job::Job& job = scene.job();
    if (job.certificate.cells == 0) return "";
    const Rig rig(job);
    const std::size_t axis = 1 - gap_axis(job);
    std::vector<double> widths;
    std::map<Crossed, std::int64_t, std::greater<>> others;
    std::int64_t tried = 0;
    double furthest = 0;
    for (const Curve& curve : found.curves) {
        for (const Crossing& crossing : curve.crossings) {
            ++tried;
            const Interval& at = crossing.proof.at;
            if (!crossing.proof.proved()) {
                ++others[crossing.proof.verdict];
                continue;
            }
            widths.push_back((at.hi - at.lo) / at.size());
            furthest = std::max(furthest, outside(coordinate(rig.values_at(crossing.place), axis), at));
        }
    }
    if (tried == 0) return "Proofs in interval arithmetic: no curve has one of these gaps\n";
    std::string text = fmt::format(
        "Proofs in interval arithmetic, of {} places where curves have these gaps, {:.1f} ms each\n"
        "  proved              {} ({})",
        readable_count(tried), 1e3 * found.proof_seconds / static_cast<double>(tried),
        readable_count(std::ssize(widths)), readable_share(std::ssize(widths), tried));
    if (!widths.empty()) {
        std::ranges::sort(widths);
        text += fmt::format(
            ", between bounds {:.1e} apart (median; {:.1e} at most), relative\n"
            "  numbers told        outside their proved bounds by {:.1e} at most, relative{}",
            widths[widths.size() / 2], widths.back(), furthest,
            has_cubic_spring(job) ? " (the bounds are with the cubic spring)" : "");
    }
    text += "\n";
    for (const auto& [verdict, count] : others) {
        text += fmt::format("  not proved          {}: {}\n", readable_count(count), reason_of(verdict));
    }
    return text;
}

}  // namespace peterka::curves
