// The impacts that begin within a trace, in their order.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "trace/watcher.hpp"

namespace peterka::trace {

struct Impact {
    double time = 0;                                        // tau of the first touch, since the trace began
    double speed = 0;                                       // delta' there
    double end = std::numeric_limits<double>::quiet_NaN();  // tau at which flight begins again
    trajectory::ImpactRecord<double> record{};              // unknown as long as the impact lasts
};

class Impacts : public Watcher {
  public:
    explicit Impacts(double length) : length_(length) {}

    [[nodiscard]] const std::vector<Impact>& all() const { return impacts_; }
    // The one with the largest peak force, or, on a rigid stop, with the largest speed; the first of equals.
    [[nodiscard]] std::optional<std::size_t> hardest() const;

    void touch(double speed) override;
    void leave(const trajectory::ImpactRecord<double>& impact) override;

  private:
    void look(const Stretch& /*stretch*/) override {}

    double length_;
    std::vector<Impact> impacts_;
    bool lasts_ = false;
};

}  // namespace peterka::trace
