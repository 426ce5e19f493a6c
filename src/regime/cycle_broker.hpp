// Where a search leaves its orders of forcing cycles, and whoever has an engine serves them.
//
// A search is written as if it integrated by itself, but pauses at every order: so one engine can carry a
// thousand searches at once (regime/search_pool.hpp), and another one alone (regime/scalar_engine.hpp).
#pragma once

#include <coroutine>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "regime/engine.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// Forcing cycles in a row, from a state (delta, delta') at forcing phase 0; a recorder gathers what happens on
// the way. After a cycle that fails there are no more.
struct CycleRequest {
    scene::State<double> from;
    trajectory::Recorder<double>* recorder = nullptr;
    std::size_t cycles = 1;
};

class CycleBroker {
  public:
    struct Served {
        CycleBroker* broker;
        [[nodiscard]] bool await_ready() const noexcept { return false; }
        void await_suspend(std::coroutine_handle<> searching) const noexcept { broker->searching_ = searching; }
        [[nodiscard]] std::span<const trajectory::Cycle<double>> await_resume() const noexcept {
            return broker->served_;
        }
    };

    // Which engine carries the cycles ordered from now on, and on which scene.
    void use(const scene::Oscillator<double>& oscillator, const EngineSettings& settings) {
        oscillator_ = oscillator;
        settings_ = settings;
        ++engines_used_;
    }

    // co_await broker.cycles(order) gives the cycles, for as long as no others are ordered.
    [[nodiscard]] auto cycles(const CycleRequest& order) {
        order_ = order;
        return Served{this};
    }

    // For the engine.
    [[nodiscard]] const scene::Oscillator<double>& oscillator() const { return oscillator_; }
    [[nodiscard]] const EngineSettings& settings() const { return settings_; }
    [[nodiscard]] std::int64_t engines_used() const { return engines_used_; }  // another number: another engine
    [[nodiscard]] const CycleRequest& order() const { return order_; }
    // The search goes on up to its next order, or to its end.
    void serve(std::span<const trajectory::Cycle<double>> cycles) {
        served_ = cycles;
        std::exchange(searching_, {}).resume();
    }

  private:
    scene::Oscillator<double> oscillator_;
    EngineSettings settings_;
    std::int64_t engines_used_ = 0;
    CycleRequest order_;
    std::span<const trajectory::Cycle<double>> served_;  // of the last order
    std::coroutine_handle<> searching_;
};

}  // namespace peterka::regime
