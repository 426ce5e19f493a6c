// Through it a cell orders searches that may run side by side, to be served by the owner of a pool: one level
// above regime/cycle_broker.hpp, through which each search orders cycles.
#pragma once

#include <coroutine>
#include <cstdint>
#include <utility>
#include <vector>

#include "regime/search_outcome.hpp"
#include "support/expect.hpp"

namespace peterka::attractors {

using regime::SearchFactory;
using regime::SearchOutcome;

class SearchBroker {
  public:
    struct Served {
        SearchBroker* broker;
        [[nodiscard]] bool await_ready() const noexcept { return broker->ordered_.empty(); }
        void await_suspend(std::coroutine_handle<> cell) const noexcept { broker->cell_ = cell; }
        [[nodiscard]] std::vector<SearchOutcome> await_resume() const noexcept {
            return std::exchange(broker->outcomes_, {});
        }
    };

    // co_await broker.searches(ordered) gives their outcomes, in the same order; an empty order is served at
    // once. rigs: whether they are on the cell's rig, or each on its own.
    [[nodiscard]] auto searches(std::vector<SearchFactory> ordered,
                                regime::Rigs rigs = regime::Rigs::of_scene) {
        ordered_ = std::move(ordered);
        rigs_ = rigs;
        return Served{this};
    }
    // Cycles of all searches served.
    [[nodiscard]] std::int64_t cycles() const { return cycles_; }

    // For the pool: the searches that the cell waits for.
    [[nodiscard]] const std::vector<SearchFactory>& ordered() const { return ordered_; }
    [[nodiscard]] regime::Rigs rigs() const { return rigs_; }
    // Resumes the cell up to its next order, or to its end.
    void serve(std::vector<SearchOutcome> outcomes) {
        PETERKA_EXPECT(outcomes.size() == ordered_.size());
        for (const SearchOutcome& each : outcomes) cycles_ += each.cycles;
        outcomes_ = std::move(outcomes);
        std::exchange(cell_, {}).resume();
    }

  private:
    std::vector<SearchFactory> ordered_;
    regime::Rigs rigs_ = regime::Rigs::of_scene;
    std::vector<SearchOutcome> outcomes_;  // of the last order
    std::int64_t cycles_ = 0;
    std::coroutine_handle<> cell_;
};

}  // namespace peterka::attractors
