// Solves many cells of a map at once, with all the starts of each, in one pool of searches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "attractors/multi_start_cell.hpp"
#include "attractors/solved_cell.hpp"
#include "regime/search_pool.hpp"

namespace peterka::attractors {

class MultiStartPool {
  public:
    // The number under which a cell was added, the solved cell, and its share of the computing time in seconds.
    struct NumberedCell {
        std::int64_t number;
        SolvedCell cell;
        double seconds;
    };
    // May move the cell away.
    using Take = std::function<void(NumberedCell& solved)>;

    // `take` is called for each cell when it is solved. The scene and the table must outlive this.
    MultiStartPool(const scene::Scene& scene, const regime::AttractorTable& known, Take take,
                   Ends ends = Ends::counted);

    [[nodiscard]] bool has_room() const { return waiting_.empty() && pool_.has_room(); }
    [[nodiscard]] bool empty() const { return cells_.empty() && pool_.empty(); }
    void add(std::int64_t row, std::int64_t column, std::int64_t number);
    // `start` takes the place of [start].
    void add(std::int64_t row, std::int64_t column, const scene::State<double>& start, std::int64_t number);
    void step();
    void spent_elsewhere(double seconds) { pool_.spent_elsewhere(seconds); }  // as in regime::SearchPool
    // Searches begun so far; in a cell with a single start, one that never meets the stop has none.
    [[nodiscard]] std::int64_t searches() const { return pool_.searches(); }

  private:
    struct Open {
        explicit Open(MultiStartCell begun) : cell(std::move(begun)), task(cell.solve(broker)) {}

        SearchBroker broker;
        MultiStartCell cell;
        Task<SolvedCell> task;
        std::vector<SearchOutcome> ended = {};  // of the running searches
        std::size_t running = 0;
        double seconds = 0;
    };
    struct Waiting {
        SearchFactory begin;
        std::int64_t number;
        regime::Rigs rigs;
    };

    void open(std::int64_t number, MultiStartCell begun);
    void begin_searches(std::int64_t number, Open& cell);
    void keep(regime::SearchPool::NumberedOutcome& search);
    void fill_pool();

    MapContext context_;
    bool searches_many_;
    Take take_;
    std::unordered_map<std::int64_t, std::unique_ptr<Open>> cells_;  // by number
    std::unordered_map<std::int64_t, std::pair<std::int64_t, std::size_t>>
        searches_;  // cell and place, by number of the search
    std::int64_t next_search_ = 0;
    std::deque<Waiting> waiting_;
    regime::SearchPool pool_;
};

}  // namespace peterka::attractors
