// What the elasticities of a map's cells say together: the median of each number's, label by label, and, with
// [uncertainty], of its share of the variance to first order.
//
// Medians are of values in bins 0.1 % wide, whose counts are sums: independent of the grouping of cells.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "findings/start_findings.hpp"
#include "job/job.hpp"
#include "parallel/tiles.hpp"
#include "quantities/fields.hpp"

namespace peterka::findings {

enum class OfElasticities : std::int8_t {
    value,
    share,      // of the variance
    deviation,  // relative standard deviation of the result, the same for all numbers
};

struct ElasticityBin {
    std::int32_t period = 0;
    std::int32_t impacts = 0;
    std::int32_t quantity = 0;  // in the table of quantities
    OfElasticities what = OfElasticities::value;
    std::int32_t bin = 0;
    friend auto operator<=>(const ElasticityBin&, const ElasticityBin&) = default;
};
using ElasticityFindings = std::map<ElasticityBin, std::int64_t>;  // cells

// Adds the cells of a tile, row by row; cells not yet computed are skipped.
void add_elasticities(ElasticityFindings& findings, const job::Job& job, const parallel::Tile& tile,
                      std::span<const quantities::StoredCell> cells);

// Of the orbits p/q; nothing where none has one.
[[nodiscard]] std::optional<double> median_of(const ElasticityFindings& findings, std::int32_t period,
                                              std::int32_t impacts, std::int32_t quantity, OfElasticities what);

}  // namespace peterka::findings
