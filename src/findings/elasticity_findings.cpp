#include "findings/elasticity_findings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "job/cell_numbers.hpp"
#include "job/first_order_spread.hpp"
#include "job/stored_quantities.hpp"

namespace peterka::findings {
namespace {

constexpr double smallest = 1e-9;  // what is smaller counts as 0
constexpr double width = 0.001;    // of a bin, in the logarithm: finer than the digits that are told

std::int32_t bin_of(double value) {
    const double size = std::abs(value);
    if (!(size >= smallest)) return 0;
    const auto bin = 1 + static_cast<std::int32_t>(std::min(std::log(size / smallest) / width, 1e6));
    return value < 0 ? -bin : bin;
}

double middle_of(std::int32_t bin) {
    if (bin == 0) return 0;
    const double size = smallest * std::exp(width * (std::abs(bin) - 0.5));
    return bin < 0 ? -size : size;
}

}  // namespace

void add_elasticities(ElasticityFindings& findings, const job::Job& job, const parallel::Tile& tile,
                      std::span<const quantities::StoredCell> cells) {
    std::vector<const cell::Quantity*> requested = job::stored_quantities(job);
    std::erase_if(requested,
                  [](const cell::Quantity* quantity) { return quantity->keeping.by_number == nullptr; });
    if (requested.empty()) return;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const quantities::StoredCell& cell = cells[i];
        if (cell.regime != regime::Regime::periodic) continue;
        std::vector<job::Elasticity> elasticities;
        elasticities.reserve(requested.size());
        for (const cell::Quantity* quantity : requested)
            elasticities.push_back({quantity->keeping.by_number, quantity->load(cell)});
        if (std::isnan(elasticities.front().value)) continue;
        const auto position = static_cast<std::int64_t>(i);
        const auto numbers = job::numbers_at(job, tile.row + position / tile.extent.columns,
                                             tile.column + position % tile.extent.columns);
        const auto spread = job::first_order_spread(job, numbers, elasticities);
        for (std::size_t n = 0; n < requested.size(); ++n) {
            ElasticityBin bin{cell.period, cell.impacts,
                              static_cast<std::int32_t>(requested[n] - cell::quantities.data())};
            const auto count = [&](OfElasticities what, double value) {
                bin.what = what;
                bin.bin = bin_of(value);
                ++findings[bin];
            };
            count(OfElasticities::value, elasticities[n].value);
            if (!spread) continue;
            count(OfElasticities::share, spread->shares[n]);
            count(OfElasticities::deviation, spread->deviation);
        }
    }
}

std::optional<double> median_of(const ElasticityFindings& findings, std::int32_t period, std::int32_t impacts,
                                std::int32_t quantity, OfElasticities what) {
    constexpr auto lowest = std::numeric_limits<std::int32_t>::min();
    constexpr auto highest = std::numeric_limits<std::int32_t>::max();
    const auto first = findings.lower_bound({period, impacts, quantity, what, lowest});
    const auto last = findings.upper_bound({period, impacts, quantity, what, highest});
    std::int64_t cells = 0;
    for (auto bin = first; bin != last; ++bin) cells += bin->second;
    std::int64_t passed = 0;
    for (auto bin = first; bin != last; ++bin) {
        passed += bin->second;
        if (2 * passed < cells) continue;
        const double lower = middle_of(bin->first.bin);
        return 2 * passed > cells ? lower : (lower + middle_of(std::next(bin)->first.bin)) / 2;
    }
    return std::nullopt;
}

}  // namespace peterka::findings
