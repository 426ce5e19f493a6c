// One cell, solved a few forcing cycles at a time so that the search can be cancelled, and its motion.
#pragma once

#include <cstdint>
#include <vector>

#include "regime/scalar_engine.hpp"
#include "regime/steady_motion.hpp"
#include "scene/scene.hpp"
#include "trace/carrier.hpp"
#include "trace/impacts.hpp"
#include "trace/quantities.hpp"

namespace peterka::page {

// Consecutive forcing cycles, as far as the engine follows them.
struct Motion {
    std::int64_t cycles = 0;
    std::vector<trace::Instant> instants;      // evenly spaced, both ends included
    std::vector<trace::Impact> impacts;        // that begin within these cycles
    std::vector<scene::State<double>> points;  // (delta, delta') at the end of each cycle
    scene::Jacobian<double> jacobian = scene::Jacobian<double>::Identity();  // d(end)/d(start)
};

Motion follow(const trace::Carrier& carrier, const scene::State<double>& start, std::int64_t cycles,
              std::int64_t samples_per_cycle);

// Samples of the impact with this index, a third of them before its first touch. The window is three times its
// contact, or `width` tau if that takes no time or never ends.
std::vector<trace::Instant> look_closely(const trace::Carrier& carrier, const scene::State<double>& start,
                                         const Motion& motion, std::size_t impact, std::int64_t samples,
                                         double width);

class LiveCell {
  public:
    // job: of kind trace. points: how many stroboscopic points of the steady motion are kept.
    LiveCell(const job::Job& job, std::size_t points);

    // Advances by this many forcing cycles, or a few more; true once the cell is solved.
    bool advance(std::int64_t cycles);

    // For a solved cell.
    [[nodiscard]] regime::CellResult result() const { return result_; }
    [[nodiscard]] trace::Carrier carrier() const { return trace::carrier_of(broker_, result_); }
    [[nodiscard]] const regime::SteadyMotion& steady_motion() const { return motion_; }
    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    [[nodiscard]] const scene::State<double>& start() const { return cell_.start; }
    // Where the steady motion can be followed from: an orbit's point of smallest displacement, or where the
    // search gave up.
    [[nodiscard]] scene::State<double> steady_start() const;

  private:
    scene::Scene scene_;
    scene::Cell cell_;
    regime::SteadyMotion motion_;
    regime::CycleBroker broker_;
    Task<regime::CellResult> search_;
    regime::ScalarEngine engine_;
    regime::CellResult result_;
};

}  // namespace peterka::page
