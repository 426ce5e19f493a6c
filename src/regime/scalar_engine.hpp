// Serves one search with one engine, order by order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <variant>
#include <vector>

#include "regime/cycle_broker.hpp"
#include "support/task.hpp"

namespace peterka::regime {

class ScalarEngine {
  public:
    // Serves the order pending at the broker.
    void serve(CycleBroker& broker) {
        if (!map_ || engine_ != broker.engines_used()) {
            map_.emplace(make_cycle_map(broker.oscillator(), broker.settings()));
            engine_ = broker.engines_used();
        }
        const CycleRequest& order = broker.order();
        cycles_.clear();
        std::visit(
            [&](auto& map) {
                scene::State<double> from = order.from;
                do {
                    cycles_.push_back(map(from, order.recorder));
                    from = cycles_.back().end;
                } while (cycles_.size() < order.cycles &&
                         cycles_.back().outcome == trajectory::Cycle<double>::Outcome::done);
            },
            *map_);
        broker.serve(cycles_);
    }

  private:
    std::optional<CycleMap> map_;
    std::vector<trajectory::Cycle<double>> cycles_;  // of the last order
    std::int64_t engine_ = 0;
};

// Runs a search to its end, or until `look`, called periodically, throws.
template <class Result>
void run(const Task<Result>& search, CycleBroker& broker, const std::function<void()>& look) {
    constexpr std::size_t cycles_between_looks = 64;
    ScalarEngine engine;
    search.start();
    for (std::size_t cycles = cycles_between_looks; !search.done();) {
        if (cycles >= cycles_between_looks) {
            look();
            cycles = 0;
        }
        cycles += broker.order().cycles;
        engine.serve(broker);
    }
}

// Runs a search to its end.
template <class Result>
Result complete(const Task<Result>& search, CycleBroker& broker) {
    ScalarEngine engine;
    search.start();
    while (!search.done()) engine.serve(broker);
    return search.result();
}

}  // namespace peterka::regime
