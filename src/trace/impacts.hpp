// The impacts that begin within a trace, in their order.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "regime/cell_result.hpp"
#include "trace/watcher.hpp"

namespace peterka::trace {

// A chatter on a rigid stop, with the rest that ends it, is one.
struct Impact {
    std::size_t touch = 0;                                  // number of its first touch, counted from 0
    double time = 0;                                        // tau of the first touch, since the trace began
    double speed = 0;                                       // delta' there
    double end = std::numeric_limits<double>::quiet_NaN();  // tau at which flight begins again
    trajectory::ImpactRecord<double> record{regime::unknown, regime::unknown, regime::unknown,
                                            regime::unknown};  // NaN where the impact outlasts the trace
};

class Impacts : public Watcher {
  public:
    explicit Impacts(double length) : length_(length) {}

    [[nodiscard]] const std::vector<Impact>& all() const { return impacts_; }
    // The impact with the largest peak force or, on a rigid stop, the largest speed; the first of equals. One
    // that outlasts the trace only if there is no other.
    [[nodiscard]] std::optional<std::size_t> hardest() const;

    void touch(double speed) override;
    void rest(std::int64_t impacts) override;
    void leave(const trajectory::ImpactRecord<double>& impact) override;

  private:
    double length_;
    std::vector<Impact> impacts_;
    std::size_t touches_ = 0;
    bool lasts_ = false;
    std::optional<double> work_before_rest_;  // of an impact that is a chatter
};

}  // namespace peterka::trace
