// What a scene settles into, judged independently of the decision procedure: by a long run in extended
// precision from the same start, and plain recurrence of its states.
//
// The motion has settled once every state of the last q cycles equals that of q cycles before, to 1e-15; q is
// the smallest such period, unless the distance at a divisor of q is still shrinking. If nothing recurs, two
// neighbours that keep diverging indicate chaos, and a motion that has long ceased touching and doesn't grow
// impacts no more. Everything else is open: a motion that never settles.
#pragma once

#include <cstdint>

#include "study/reference.hpp"

namespace peterka::study {

struct Verdict {
    enum class Kind { settled, chaotic, open };
    Kind kind = Kind::open;
    // of a settled motion
    regime::Regime regime = regime::Regime::unresolved;
    std::int64_t impacts = 0;  // p and q of z = p/q; 0 and 1 for motions without impacts
    std::int64_t period = 0;
    Extended peak_force = 0;
};

[[nodiscard]] Verdict judge(const scene::Oscillator<double>& oscillator, const scene::State<double>& start);

}  // namespace peterka::study
