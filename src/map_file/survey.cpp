#include "map_file/survey.hpp"

#include <cmath>
#include <string_view>
#include <vector>

#include "job/axis_key.hpp"
#include "job/cell_numbers.hpp"
#include "parallel/collective.hpp"
#include "support/stop_if_asked.hpp"

namespace peterka::map_file {

namespace {

// The parts of Statistics that travel as plain bytes.
struct Totals {
    findings::Counts counts;
    findings::ProofFindings proofs;
    findings::Observed chaos;
    findings::LongestChaos longest;
    findings::Extremes largest;
    findings::Transients transients;
    findings::StartCounts starts;
    findings::OutcomeCounts outcomes;
    double tile_seconds = 0;
};

struct PairCount {
    findings::AttractorPair pair;
    std::int64_t cells = 0;
};

struct LikelyCount {
    findings::AttractorLabel label;
    std::int64_t cells = 0;
};

struct BinCount {
    findings::ElasticityBin bin;
    std::int64_t cells = 0;
};

struct ClassCount {
    findings::ImpactClass impact_class;
    std::int64_t cells = 0;
};

// Of each cell's hammer [kg], row by row; empty where all have the same.
std::vector<double> masses_of(const job::Job& job, const parallel::Tile& tile) {
    if (!job::has_axis(job, [](std::string_view key) { return key == "hammer.mass_kg"; })) return {};
    std::vector<double> masses;
    for (std::int64_t row = tile.row; row < tile.row + tile.extent.rows; ++row) {
        for (std::int64_t column = tile.column; column < tile.column + tile.extent.columns; ++column) {
            masses.push_back(job::numbers_at(job, row, column).hammer.mass_kg);
        }
    }
    return masses;
}

findings::Statistics survey_share(const TileStore& tiles, const job::Job& job, parallel::Share share) {
    findings::Statistics mine;
    for (std::int64_t index = share.first; index < share.end; ++index) {
        look_for_stop_request();
        const parallel::Tile tile = tiles.tiling().tile(index);
        const std::vector<quantities::StoredCell> cells = tiles.read(tile);
        findings::add_tile(mine, tile, cells, masses_of(job, tile));
        findings::add_attractors(mine.starts, tile, cells, tiles.read_attractors(tile));
        findings::add_outcomes(mine.outcomes, cells, tiles.read_outcomes(tile));
        findings::add_elasticities(mine.elasticities, job, tile, cells);
        const double seconds = tiles.seconds(tile);
        if (!std::isnan(seconds)) mine.tile_seconds += seconds;
    }
    return mine;
}

}  // namespace

findings::Statistics survey(const TileStore& tiles, const job::Job& job, MPI_Comm communicator) {
    findings::Statistics mine;
    parallel::together(communicator, [&] {
        mine = survey_share(tiles, job, parallel::share_of(tiles.tiling().count(), communicator));
    });
    const Totals totals{mine.counts,        mine.proofs,          mine.chaos,
                        mine.longest,       mine.largest,         mine.transients,
                        mine.starts.counts, mine.outcomes.counts, mine.tile_seconds};
    std::vector<LikelyCount> likely;
    for (const auto& [label, cells] : mine.outcomes.by_likely) likely.push_back({label, cells});
    std::vector<PairCount> pairs;
    for (const auto& [pair, cells] : mine.starts.pairs) pairs.push_back({pair, cells});
    std::vector<BinCount> bins;
    for (const auto& [bin, cells] : mine.elasticities) bins.push_back({bin, cells});
    std::vector<ClassCount> classes;
    for (const auto& [impact_class, cells] : mine.periodic_cells) classes.push_back({impact_class, cells});

    findings::Statistics all;
    for (const Totals& share : parallel::gather<Totals>(std::span(&totals, 1), communicator)) {
        all.counts.add(share.counts);
        all.proofs.add(share.proofs);
        all.chaos.take(share.chaos);
        all.longest.take(share.longest);
        all.largest.take(share.largest);
        all.transients.add(share.transients);
        all.starts.counts.add(share.starts);
        all.outcomes.counts.add(share.outcomes);
        all.tile_seconds += share.tile_seconds;
    }
    for (const PairCount& share : parallel::gather<PairCount>(pairs, communicator)) {
        all.starts.pairs[share.pair] += share.cells;
    }
    for (const LikelyCount& share : parallel::gather<LikelyCount>(likely, communicator)) {
        all.outcomes.by_likely[share.label] += share.cells;
    }
    for (const BinCount& share : parallel::gather<BinCount>(bins, communicator)) {
        all.elasticities[share.bin] += share.cells;
    }
    for (const ClassCount& share : parallel::gather<ClassCount>(classes, communicator)) {
        all.periodic_cells[share.impact_class] += share.cells;
    }
    return all;
}

}  // namespace peterka::map_file
