// Serves one search with one engine: the plain way, cycle by cycle.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

#include "regime/cycle_desk.hpp"
#include "support/task.hpp"

namespace peterka::regime {

class ScalarEngine {
  public:
    // Serves the order that waits at the desk.
    void serve(CycleDesk& desk) {
        if (!map_ || engine_ != desk.engines_used()) {
            map_.emplace(make_cycle_map(desk.scene(), desk.settings()));
            engine_ = desk.engines_used();
        }
        const CycleOrder& order = desk.order();
        desk.serve(std::visit([&](auto& map) { return map(order.from, order.recorder); }, *map_));
    }

  private:
    std::optional<CycleMap> map_;
    std::int64_t engine_ = 0;
};

// Runs a search to its end, or until carry_on, asked every now and then, says to give up: then false.
template <class Result>
bool run(const Task<Result>& search, CycleDesk& desk, const std::function<bool()>& carry_on) {
    constexpr int cycles_between_questions = 256;
    ScalarEngine engine;
    search.start();
    for (std::int64_t cycle = 0; !search.done(); ++cycle) {
        if (cycle % cycles_between_questions == 0 && !carry_on()) return false;
        engine.serve(desk);
    }
    return true;
}

// Runs a search to its end.
template <class Result>
Result complete(const Task<Result>& search, CycleDesk& desk) {
    ScalarEngine engine;
    search.start();
    while (!search.done()) engine.serve(desk);
    return search.result();
}

}  // namespace peterka::regime
