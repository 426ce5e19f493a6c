// The status of a cell whose cycle failed.
#pragma once

#include "regime/cell_result.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::regime {

[[nodiscard]] inline Status status_of(trajectory::Cycle<double>::Outcome outcome) {
    using enum trajectory::Cycle<double>::Outcome;
    switch (outcome) {
        case too_many_events:
            return Status::too_many_events;
        case not_finite:
            return Status::not_finite;
        case solver_failed:
        case inside_stop:
            return Status::solver_failed;
        case done:
            break;
    }
    return Status::verified;
}

}  // namespace peterka::regime
