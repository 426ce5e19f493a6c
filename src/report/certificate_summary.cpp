#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

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

// In the order of the enum, from cubic_spring down.
std::string reasons(const findings::ProofFindings& proofs) {
    std::string text;
    for (int number = -1; number >= cell::first_certified; --number) {
        const auto certified = static_cast<Certified>(number);
        if (const std::int64_t motions = proofs.count(certified); motions > 0) {
            text += fmt::format("  not proved          {}: {}\n", readable_count(motions), reason(certified));
        }
    }
    return text;
}

// With as many decimals as the distance of the bounds justifies, and rounded outwards.
std::string largest(const scene::Scene& scene, const findings::ProvedPeak& proved, const char* of) {
    if (!(proved.upper > 0) || scene.rigs_differ()) return "";
    const bool rigid = job::is_rigid(scene.job().contact);
    const bool in_newton = !rigid && job::leads_in_si(scene.job());
    const double unit = in_newton ? scene::scales_of(scene.job()).weight_n : 1;
    const double lower = proved.lower * unit;
    const double upper = proved.upper * unit;
    const double width = std::max(upper - lower, 1e-15 * upper);
    const int decimals = std::clamp(static_cast<int>(-std::log10(width)), 0, 15);
    const double half = 0.5 * std::pow(10, -decimals) + 1e-15 * upper;
    return fmt::format("  {:<20}from {:.{}f} to {:.{}f} {}, of the {} that are proved\n",
                       rigid ? "largest speed" : "largest force", lower - half, decimals, upper + half,
                       decimals,
                       rigid       ? "m/s of an impact"
                       : in_newton ? "N"
                                   : "weights",
                       of);
}

std::int64_t tried_of(const findings::ProofFindings& proofs) {
    return std::accumulate(proofs.by_verdict.begin(), proofs.by_verdict.end(), std::int64_t{0}) -
           proofs.count(Certified::not_tried);
}

// of: cells or attractors.
std::string proofs_in_words(const scene::Scene& scene, const findings::ProofFindings& proofs, const char* of) {
    const std::int64_t tried = tried_of(proofs);
    const std::int64_t from_start = proofs.count(Certified::start);
    const std::int64_t proved = proofs.count(Certified::orbit) + from_start;
    std::string text = fmt::format("{} {}\n  proved              {} ({})", readable_count(tried), of,
                                   readable_count(proved), readable_share(proved, tried));
    if (from_start > 0)
        text += fmt::format(", in {} that the start leads there, too", readable_count(from_start));
    return text + "\n" + reasons(proofs) + largest(scene, proofs.largest, of);
}

std::string comparison(const scene::Scene& scene, const findings::ProofFindings& proofs, const char* of) {
    if (!(proofs.largest.upper >= 0)) return "";
    return fmt::format("  {} of the {}   outside their proved bounds by {:.1e} at most, relative{}\n",
                       job::is_rigid(scene.job().contact) ? "speeds" : "forces", of, proofs.furthest_outside,
                       scene.cell(0, 0).oscillator.cubic == 0 ? "" : " (the bounds are with the cubic spring)");
}

std::string attractors_in_words(const scene::Scene& scene, const findings::ProofFindings& proofs) {
    if (!scene.job().certificate.attractors || tried_of(proofs) == 0) return "";
    const std::string compared =
        job::is_rigid(scene.job().contact) ? "" : comparison(scene, proofs, "attractors");
    return "of " + proofs_in_words(scene, proofs, "attractors") + compared;
}

}  // namespace

std::string certificate_summary(const scene::Scene& scene, const findings::Statistics& statistics) {
    const job::Job& job = scene.job();
    if (job.certificate.cells == 0) return "";
    const std::string of_attractors = attractors_in_words(scene, statistics.starts.counts.proofs);
    if (tried_of(statistics.proofs) == 0) {
        const std::string none = "\nProofs in interval arithmetic: no cell tried has a motion that settles\n";
        return of_attractors.empty() ? none : none + of_attractors;
    }
    const bool tells_peak = !job::is_rigid(job.contact) || job.output.has(cell::OptionalField::impact_speed);
    return "\nProofs in interval arithmetic, of " + proofs_in_words(scene, statistics.proofs, "cells") +
           (tells_peak ? comparison(scene, statistics.proofs, "map") : "") + of_attractors;
}

}  // namespace peterka
