// Solves many cells at once: each is a search of its own (regime/solve_cell.hpp), and the batched engine
// integrates the cycles that they order together.
//
// Searches that need another engine, or more about an impact than the batch records, are served one after the
// other by a scalar engine. A cell's result depends only on the cell and the attractors known beforehand, not
// on what else is in the pool.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <optional>

#include "batch/batched_cycle_map.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cycle_broker.hpp"
#include "regime/free_cells.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/search_outcome.hpp"
#include "scene/scene.hpp"

namespace peterka::regime {

class SearchPool {
  public:
    // The number under which a cell or a search was added, its outcome, and its share of the computing time.
    struct NumberedOutcome {
        std::int64_t number;
        SearchOutcome outcome;
        double seconds;
    };
    // May move the outcome away.
    using Take = std::function<void(NumberedOutcome& solved)>;

    // Attractors found by the searches on the way.
    enum class Attractors { dropped, reported };

    // `take` is called for each cell when it is solved. The scene and the table must outlive the pool.
    SearchPool(const scene::Scene& scene, const AttractorTable& known, Take take,
               Attractors attractors = Attractors::dropped);
    ~SearchPool();

    // Whether there is room for more cells; the batch is best kept full.
    [[nodiscard]] bool has_room() const;
    [[nodiscard]] bool empty() const { return in_hand_ == 0; }
    void add(std::int64_t row, std::int64_t column, std::int64_t number);
    // Adds any search, on a rig of the scene or on one of its own.
    void add(const SearchFactory& begin, std::int64_t number, Rigs rigs = Rigs::of_scene);
    // Searches begun so far; cells that never meet the stop have none.
    [[nodiscard]] std::int64_t searches() const { return searches_; }

    // For `take`: what it spends on a cell that the owner charges to it himself, and the pool must not charge
    // to the other cells of its batch [s].
    void spent_elsewhere(double seconds) { elsewhere_ += seconds; }

    // Advances each batch that is large enough by a cycle, or the largest if none is; and the first of the
    // cells outside batches by a few.
    void step();

  private:
    struct Member;
    struct Group;  // a batch and the cells in it

    // What all cells of a batch share, besides the rig where there is one.
    struct Batch {
        batch::Springs springs;
        int steps;  // per cycle
        batch::Stop stop;
        bool rigs_differ = false;
        friend bool operator==(const Batch&, const Batch&) = default;
    };
    static std::optional<Batch> batch_of(const CycleBroker& broker);
    [[nodiscard]] Group& group_for(const Member& cell);
    void enter(std::unique_ptr<Member> cell);
    void advance(Group& group);
    void serve(Group& group, std::size_t slot);
    void serve_alone();
    std::unique_ptr<Member> leave(Group& group, std::size_t slot);
    void hand_over(NumberedOutcome solved) { take_(solved); }
    void finish(const Member& member);

    const scene::Scene& scene_;
    const AttractorTable& known_;
    Take take_;
    Attractors attractors_;
    FreeCells free_;
    std::list<Group> groups_;
    std::deque<std::unique_ptr<Member>> alone_;
    std::size_t in_hand_ = 0;
    std::int64_t searches_ = 0;
    double elsewhere_ = 0;  // during the present step of a batch [s]
};

}  // namespace peterka::regime
