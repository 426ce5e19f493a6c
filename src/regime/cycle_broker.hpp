// Where a search places its orders of forcing cycles, and an engine serves them.
//
// A search is written as if it integrated by itself, but is suspended at every order: so one engine can carry a
// thousand searches at once (regime/search_pool.hpp), and another a single one (regime/scalar_engine.hpp).
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

// Consecutive forcing cycles from a state (delta, delta') at forcing phase 0; a recorder collects the events on
// the way. A failed cycle is the last.
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

    // Sets the engine and the oscillator for the cycles ordered from now on.
    void use(const scene::Oscillator<double>& oscillator, const EngineSettings& settings) {
        oscillator_ = oscillator;
        settings_ = settings;
        ++engines_used_;
    }

    // co_await broker.cycles(order) gives the cycles, valid until the next order.
    [[nodiscard]] auto cycles(const CycleRequest& order) {
        order_ = order;
        return Served{this};
    }

    // For the engine.
    [[nodiscard]] const scene::Oscillator<double>& oscillator() const { return oscillator_; }
    [[nodiscard]] const EngineSettings& settings() const { return settings_; }
    [[nodiscard]] std::int64_t engines_used() const { return engines_used_; }  // changes with the engine
    [[nodiscard]] const CycleRequest& order() const { return order_; }
    // Resumes the search up to its next order, or to its end.
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
