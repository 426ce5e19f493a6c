// The chain of events of an orbit, in doubles, from its state at forcing phase 0: the starting point of a
// proof, which trusts none of it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct StroboscopicOrbit {
    std::int64_t impacts = 0;  // p
    std::int64_t period = 0;   // q
    double displacement = 0;   // (x - y)/A0 at forcing phase 0
    double velocity = 0;       // (x' - y')/(A0 omega) there
};

inline constexpr std::size_t most_events = 400;

// nothing: no chain from this state closes after q cycles.
[[nodiscard]] std::optional<EventChain> find_chain(const Springs<double>& springs,
                                                   const StroboscopicOrbit& orbit);

[[nodiscard]] std::vector<Place<double>> places_of(const EventChain& chain);

// The legs' equations in order, two rows each; columns are (time, along) of the events.
struct EquationsInDoubles {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd derivatives;
};
[[nodiscard]] EquationsInDoubles equations_in_doubles(const Springs<double>& springs, const EventChain& chain);

}  // namespace peterka::certificate
