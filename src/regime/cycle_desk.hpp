// Where a search leaves its orders of forcing cycles, and whoever has an engine serves them.
//
// A search is written as if it integrated by itself, but pauses at every cycle: so one engine can carry a
// thousand searches at once (regime/cell_pool.hpp), and another one alone (regime/scalar_engine.hpp).
#pragma once

#include <coroutine>
#include <cstdint>
#include <utility>

#include "regime/engine.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// One forcing cycle from a state (delta, delta') at forcing phase 0; a recorder gathers what happens on the
// way.
struct CycleOrder {
    scene::State<double> from;
    trajectory::Recorder<double>* recorder = nullptr;
};

class CycleDesk {
  public:
    // Which engine carries the cycles ordered from now on, and on which scene.
    void use(const scene::Oscillator<double>& scene, const EngineSettings& settings) {
        scene_ = scene;
        settings_ = settings;
        ++engines_used_;
    }

    // co_await desk.cycle(order) gives a trajectory::Cycle<double>.
    [[nodiscard]] auto cycle(const CycleOrder& order) {
        struct Served {
            CycleDesk* desk;
            [[nodiscard]] bool await_ready() const noexcept { return false; }
            void await_suspend(std::coroutine_handle<> searching) const noexcept {
                desk->searching_ = searching;
            }
            [[nodiscard]] const trajectory::Cycle<double>& await_resume() const noexcept {
                return *desk->answer_;
            }
        };
        order_ = order;
        return Served{this};
    }

    // For the engine.
    [[nodiscard]] const scene::Oscillator<double>& scene() const { return scene_; }
    [[nodiscard]] const EngineSettings& settings() const { return settings_; }
    [[nodiscard]] std::int64_t engines_used() const { return engines_used_; }  // another number: another engine
    [[nodiscard]] const CycleOrder& order() const { return order_; }
    // The search goes on up to its next order, or to its end.
    void serve(const trajectory::Cycle<double>& answer) {
        answer_ = &answer;
        std::exchange(searching_, {}).resume();
    }

  private:
    scene::Oscillator<double> scene_;
    EngineSettings settings_;
    std::int64_t engines_used_ = 0;
    CycleOrder order_;
    const trajectory::Cycle<double>* answer_ = nullptr;  // while a search is being served
    std::coroutine_handle<> searching_;
};

}  // namespace peterka::regime
