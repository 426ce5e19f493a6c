// Aborts a computation part-way. Who may request it is up to the program (support/stop_request.hpp): this
// header does not depend on signals, so that any engine can include it.
#pragma once

namespace peterka {

// Thrown in the middle of a computation that was asked to stop. Its result is incomplete and is discarded.
struct Stopped {};

// Throws Stopped if the program was asked to stop.
void look_for_stop_request();

// To be called in every iteration of a loop that may take long: checks only now and then, at negligible cost.
inline void stop_if_asked() {
    constexpr unsigned calls_between_looks = 16;
    static unsigned calls = 0;
    if (++calls % calls_between_looks == 0) look_for_stop_request();
}

}  // namespace peterka
