#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include "report/axis_words.hpp"
#include "support/readable.hpp"

namespace peterka {

namespace {

std::string line(std::int64_t cells, std::int64_t all, const std::string& what) {
    return cells == 0 ? "" : fmt::format("  {:>9} of these cells: {}\n", readable_share(cells, all), what);
}

// Long chaotic returns end the search earlier, so cells may differ widely.
std::string none_found(const findings::KickCounts& counts) {
    const std::string least = readable_amount(counts.least_tried, "m/s", 3);
    const std::string most = readable_amount(counts.most_tried, "m/s", 3);
    return least == most ? fmt::format("none found up to {}", least)
                         : fmt::format("none found up to {} to {}, by cell", least, most);
}

std::string smallest(const scene::Scene& scene, const findings::KickCounts& counts) {
    return fmt::format("a kick leads elsewhere, the smallest one found {} at phase {:.3f} cycles, at {}{}",
                       readable_amount(counts.smallest, "m/s", 3), counts.phase,
                       place_in_words(scene, counts.row, counts.column),
                       counts.by_rounding != 0 ? ", where rounding may decide the label" : "");
}

}  // namespace

std::string kicks_summary(const scene::Scene& scene, const findings::KickCounts& counts) {
    const job::Job& job = scene.job();
    if (!job.output.has(job::OptionalField::critical_kick)) return "";
    const std::string head = "\nWhat throws the settled hammer out of its orbit\n";
    if (counts.kicked == 0) return head + "  no cell has an orbit\n";
    const std::string which = job.starts.count > 0 ? ", of its orbit with the largest share" : "";
    return head +
           fmt::format("  kicks at all phases of the orbit, in {} {}{}\n", readable_count(counts.kicked),
                       counts.kicked == 1 ? "cell" : "cells", which) +
           line(counts.thrown, counts.kicked, counts.thrown == 0 ? "" : smallest(scene, counts)) +
           line(counts.kicked - counts.thrown - counts.alone, counts.kicked, none_found(counts)) +
           line(counts.alone, counts.kicked, "one motion alone is known, and " + none_found(counts)) +
           line(counts.bounded, counts.kicked,
                fmt::format("small kicks are verified to lead back, up to {} in each",
                            readable_amount(counts.least_bound, "m/s", 3)));
}

}  // namespace peterka
