#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "job/axis_quantity.hpp"
#include "job/stored_quantities.hpp"

namespace peterka {
namespace {

using findings::ImpactClass;
using findings::OfElasticities;

struct Ranked {
    std::string_view key;
    double median = 0;
};

// The numbers of which an orbit's medians are largest, largest first.
std::vector<Ranked> largest_of(const job::Job& job, const findings::ElasticityFindings& findings,
                               const ImpactClass& z, OfElasticities what) {
    constexpr std::size_t shown = 3;
    std::vector<Ranked> ranked;
    for (const cell::Quantity* quantity : job::stored_quantities(job)) {
        if (quantity->keeping.by_number == nullptr) continue;
        const auto place = static_cast<std::int32_t>(quantity - cell::quantities.data());
        const auto median = median_of(findings, z.period, z.impacts, place, what);
        if (median) ranked.push_back({quantity->keeping.by_number, *median});
    }
    std::ranges::stable_sort(ranked, std::ranges::greater{},
                             [](const Ranked& one) { return std::abs(one.median); });
    ranked.resize(std::min(shown, ranked.size()));
    std::erase_if(ranked, [](const Ranked& one) { return one.median == 0; });
    return ranked;
}

std::string dependence(const job::Job& job, const findings::ElasticityFindings& findings,
                       const ImpactClass& z) {
    const std::vector<Ranked> ranked = largest_of(job, findings, z, OfElasticities::value);
    if (ranked.empty()) return "";
    std::string text =
        fmt::format("  the {} of {}/{} depends most on ",
                    job::is_rigid(job.contact) ? "impact speed" : "peak force", z.impacts, z.period);
    for (const Ranked& one : ranked) {
        const bool first = &one == &ranked.front();
        text += fmt::format("{}{}: {:.2g} %{}", first ? "" : "; ", job::key_in_tables(one.key), one.median,
                            first ? " per 1 %" : "");
    }
    return text + "\n";
}

std::string variance(const job::Job& job, const findings::ElasticityFindings& findings, const ImpactClass& z) {
    const std::vector<Ranked> ranked = largest_of(job, findings, z, OfElasticities::share);
    const std::vector<Ranked> deviation = largest_of(job, findings, z, OfElasticities::deviation);
    if (ranked.empty() || deviation.empty()) return "";
    std::string text;
    for (const Ranked& one : ranked) {
        text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", job::key_in_tables(one.key),
                            100 * one.median);
    }
    return fmt::format(
        "    to first order the drawn rigs spread it by {:.2g} % (standard deviation); of that variance, each "
        "in the median of these orbits: {}\n",
        100 * deviation.front().median, text);
}

}  // namespace

std::string elasticities_summary(const job::Job& job, const findings::Statistics& statistics) {
    using Entry = std::pair<ImpactClass, std::int64_t>;
    constexpr std::size_t shown = 3;
    if (statistics.elasticities.empty()) return "";
    std::vector<Entry> orbits(statistics.periodic_cells.begin(), statistics.periodic_cells.end());
    std::ranges::stable_sort(orbits, std::ranges::greater{}, &Entry::second);
    orbits.resize(std::min(shown, orbits.size()));
    std::string text = "\nWhat it depends on (medians over the cells of the commonest orbits)\n";
    for (const auto& [z, cells] : orbits) {
        text += dependence(job, statistics.elasticities, z) + variance(job, statistics.elasticities, z);
    }
    return text;
}

}  // namespace peterka
