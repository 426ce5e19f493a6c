// One cell of a map: its start, and, where the job has [starts], all of these, in rounds; and the kicks of what
// they end on, where the job asks for these.
//
// The searches of a round know the attractors that rounds before it found: they end where they are seen to
// converge to the orbit of one (regime/known_orbit.hpp), or, where starts are many, in its proven neighbourhood
// (regime/neighbourhood.hpp). Rounds have fixed sizes, so what a start knows doesn't depend on how long others
// take. [start] itself is solved as in a map without [starts].
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "attractors/kicks.hpp"
#include "attractors/mean_life.hpp"
#include "attractors/prospects.hpp"
#include "attractors/search_broker.hpp"
#include "attractors/solved_cell.hpp"
#include "attractors/tally.hpp"
#include "regime/attractor_table.hpp"
#include "scene/scene.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

// Whether a solved cell tells the end of each start, too, or of the first one on each attractor, and then all
// of these.
enum class Ends { counted, told, firsts };

// What the cells of a map share; outlives their searches.
struct MapContext {
    MapContext(const scene::Scene& map, const regime::AttractorTable& known_before, Ends ends_of_starts);

    const scene::Scene& scene;
    const regime::AttractorTable& known;  // for [start]: none but in a basin
    job::Job of_starts;                   // measures nothing that is not kept of attractors
    job::Job of_short_starts;             // the same, with a smaller budget
    Ends ends;
};

class MultiStartCell {
  public:
    MultiStartCell(const MapContext& context, std::int64_t row, std::int64_t column);

    // All of it, round by round; the broker and this must outlive the task.
    [[nodiscard]] Task<SolvedCell> solve(SearchBroker& broker);

  private:
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
    [[nodiscard]] Kicks kicks() const;
    void tell_kicks(Kicks& kicks);
    [[nodiscard]] SearchFactory search_from(const scene::State<double>& start, EarlyVerdict sooner = {}) const;
    [[nodiscard]] scene::Oscillator<double> oscillator_of(const regime::FoundAttractor& found) const;
    [[nodiscard]] std::int64_t count() const { return context_.of_starts.starts.count; }

    const MapContext& context_;
    scene::Cell cell_;
    std::int64_t begun_ = 0;  // of the starts
    std::int64_t seen_ = 0;
    Tally tally_;
    Prospects prospects_;
    bool chaos_may_end_;  // a motion without impacts, or without end of a contact, exists, too
    MeanLife life_;
    std::vector<CountedAttractor> known_;
    std::vector<std::size_t> learning_;  // of known_: what each search in hand is about
    regime::AttractorTable table_;
    Tally::Entry own_;  // of [start]
    std::vector<Tally::Entry> kept_;
    SolvedCell solved_;
};

}  // namespace peterka::attractors
