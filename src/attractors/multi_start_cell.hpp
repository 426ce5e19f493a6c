// One cell of a map: its start and, where the job has [starts], all of these, in rounds; if requested, the
// kicks of the attractors on which they end; and, where the job has [uncertainty], the ends of the rigs drawn.
//
// The searches of a round know the attractors found in previous rounds: they end once they are seen to converge
// to a known orbit (regime/known_orbit.hpp) or, where starts are many, once inside its proven neighbourhood
// (regime/neighbourhood.hpp). Rounds have fixed sizes, so what a start knows does not depend on how long other
// starts take. [start] itself is solved as in a map without [starts].
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "attractors/kicks.hpp"
#include "attractors/mean_life.hpp"
#include "attractors/outcomes.hpp"
#include "attractors/prospects.hpp"
#include "attractors/search_broker.hpp"
#include "attractors/solved_cell.hpp"
#include "attractors/tally.hpp"
#include "regime/attractor_table.hpp"
#include "scene/scene.hpp"
#include "scene/uncertain_cells.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

// Whether a solved cell also reports the end of each start, or that of the first start on each attractor, for
// all attractors.
enum class Ends { counted, told, firsts };

// Shared by the cells of a map; must outlive their searches.
struct MapContext {
    MapContext(const scene::Scene& map, const regime::AttractorTable& known_before, Ends ends_of_starts);

    const scene::Scene& scene;
    const regime::AttractorTable& known;             // for [start]: empty except in a basin
    job::Job of_starts;                              // measures only what is kept for attractors
    job::Job of_short_starts;                        // the same, with a smaller budget
    std::optional<scene::UncertainCells> uncertain;  // of a job with [uncertainty]
    job::Job of_rigs;                                // what is measured of their ends
    Ends ends;
};

class MultiStartCell {
  public:
    MultiStartCell(const MapContext& context, std::int64_t row, std::int64_t column);
    // `start` takes the place of [start].
    MultiStartCell(const MapContext& context, std::int64_t row, std::int64_t column,
                   const scene::State<double>& start);

    // Solves the whole cell, round by round; the broker and this must outlive the task.
    [[nodiscard]] Task<SolvedCell> solve(SearchBroker& broker);

  private:
    // The searches of the drawn rigs that need one, and the ends of those that don't.
    struct DrawnRigs {
        std::vector<scene::Scales> scales;  // of each draw
        std::vector<std::optional<regime::CellResult>> ends;
        std::vector<SearchFactory> searches;  // of draws without an end, in their order
    };
    // An attractor on one map, and how often it was found.
    struct CountedAttractor {
        regime::FoundAttractor found;
        std::int64_t times = 0;
        bool followed = false;
        bool tried = false;  // to prove its neighbourhood
    };

    [[nodiscard]] std::vector<SearchFactory> next_starts();
    [[nodiscard]] std::vector<SearchFactory> attractors_worth_knowing();
    [[nodiscard]] std::vector<SearchFactory> orbits_to_kick();
    void learn(std::size_t known, bool follows, bool proves, std::vector<SearchFactory>& searches);
    [[nodiscard]] double expected(const CountedAttractor& known) const;
    [[nodiscard]] bool is_worth_following(const CountedAttractor& known) const;
    [[nodiscard]] bool is_worth_proving(const CountedAttractor& known) const;
    void know_more(std::vector<SearchOutcome> learned);
    void tell_attractors();
    void tell_mean_life();
    [[nodiscard]] EarlyVerdict sooner() const;
    void take_starts(std::span<const SearchOutcome> ended);
    void take_found(std::span<const regime::FoundAttractor> found);
    [[nodiscard]] KickedCell kicked() const;
    void tell_kicks(std::span<const cell::Kick> kicks);
    [[nodiscard]] DrawnRigs drawn_rigs() const;
    void tell_outcomes(const DrawnRigs& rigs, const std::vector<SearchOutcome>& ended);
    [[nodiscard]] SearchFactory search_from(const scene::State<double>& start, EarlyVerdict sooner = {}) const;
    [[nodiscard]] scene::Oscillator<double> oscillator_of(const regime::FoundAttractor& found) const;
    [[nodiscard]] std::int64_t count() const { return context_.of_starts.starts.count; }

    const MapContext& context_;
    std::int64_t row_;
    std::int64_t column_;
    scene::Cell cell_;
    std::int64_t begun_ = 0;  // starts begun
    std::int64_t seen_ = 0;
    Tally tally_;
    Prospects prospects_;
    bool chaos_may_end_;  // an impact-free or permanent-contact motion also exists
    MeanLife life_;
    std::vector<CountedAttractor> known_;
    std::vector<std::size_t> learning_;  // indices into known_: the subject of each search under way
    regime::AttractorTable table_;
    Tally::Entry own_;  // of [start]
    std::vector<Tally::Entry> kept_;
    SolvedCell solved_;
};

}  // namespace peterka::attractors
