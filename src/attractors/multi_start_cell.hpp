// One cell of a map: its start, and, where the job has [starts], all of these, in rounds; and the kicks of what
// they end on, where the job asks for these.
//
// The searches of a round know the attractors that rounds before it found: they end where they are seen to
// converge to the orbit of one (regime/known_orbit.hpp), or, where starts are many, in its proven neighbourhood
// (regime/neighbourhood.hpp). Rounds have fixed sizes, so what a start knows doesn't depend on how long others
// take. [start] itself is solved as in a map without [starts].
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "attractors/kicks.hpp"
#include "attractors/mean_life.hpp"
#include "attractors/prospects.hpp"
#include "attractors/solved_cell.hpp"
#include "attractors/tally.hpp"
#include "attractors/work.hpp"
#include "regime/attractor_table.hpp"
#include "scene/scene.hpp"

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

    // The next searches, once the last ones have ended, whose ends are given in their order; none: it is
    // solved.
    [[nodiscard]] std::vector<SearchFactory> next(std::span<const SearchOutcome> ended);
    [[nodiscard]] SolvedCell result() const;

  private:
    enum class Stage { begin, starts, attractors, orbits_to_kick, kicks };
    // An attractor on one map, and how often it was found.
    struct Known {
        regime::FoundAttractor found;
        std::int64_t times = 0;
        bool followed = false;
        bool tried = false;  // to prove its neighbourhood
    };

    [[nodiscard]] std::vector<SearchFactory> next_round();
    [[nodiscard]] std::vector<SearchFactory> attractors_worth_knowing();
    [[nodiscard]] std::vector<SearchFactory> orbits_to_kick();
    void learn(std::size_t known, bool follows, bool proves);
    [[nodiscard]] std::vector<SearchFactory> learn_all();
    [[nodiscard]] double expected(const Known& known) const;
    [[nodiscard]] bool is_worth_following(const Known& known) const;
    [[nodiscard]] bool is_worth_proving(const Known& known) const;
    void know_more();
    [[nodiscard]] std::vector<SearchFactory> finish_starts();
    void tell_attractors();
    void tell_mean_life();
    [[nodiscard]] EarlyVerdict sooner() const;
    void take_starts(std::span<const SearchOutcome> ended);
    void take_found(std::span<const regime::FoundAttractor> found);
    [[nodiscard]] std::vector<SearchFactory> begin_kicks();
    void take_kicks();
    [[nodiscard]] SearchFactory search_from(const scene::State<double>& start, EarlyVerdict sooner = {}) const;
    [[nodiscard]] scene::Oscillator<double> oscillator_of(const regime::FoundAttractor& found) const;
    [[nodiscard]] std::int64_t count() const { return context_.of_starts.starts.count; }

    const MapContext& context_;
    scene::Cell cell_;
    Stage stage_ = Stage::begin;
    std::int64_t begun_ = 0;  // of the starts
    std::int64_t seen_ = 0;
    std::int64_t cycles_ = 0;  // of all searches
    Tally tally_;
    Prospects prospects_;
    bool chaos_may_end_;  // a motion without impacts, or without end of a contact, exists, too
    MeanLife life_;
    std::vector<Known> known_;
    // Of known_, with what searches leave there.
    struct Learned {
        std::size_t known;
        bool proves;  // places; or follows its orbit
        std::optional<regime::KnownOrbit> orbit = {};
        std::vector<regime::Neighbourhood> places = {};
    };
    std::vector<Learned> learned_;
    regime::AttractorTable table_;
    Tally::Entry own_;  // of [start]
    std::vector<Tally::Entry> kept_;
    std::optional<Kicks> kicks_;
    SolvedCell solved_;
};

}  // namespace peterka::attractors
