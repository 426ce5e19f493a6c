// The way out of a computation in the middle of it. Who may ask for it is the program's business
// (support/stop_request.hpp): this header knows nothing of signals, so that any engine can include it.
#pragma once

namespace peterka {

// Thrown in the middle of a computation that was asked to stop. What it computed is incomplete, and is dropped.
struct Stopped {};

// Throws Stopped where the program was asked to stop.
void look_for_stop_request();

// To be called in any loop that may take long, at every round: looks now and then, which costs nothing to speak
// of.
inline void stop_if_asked() {
    constexpr unsigned calls_between_looks = 16;
    static unsigned calls = 0;
    if (++calls % calls_between_looks == 0) look_for_stop_request();
}

}  // namespace peterka
