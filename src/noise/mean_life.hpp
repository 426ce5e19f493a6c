// How long a settled motion lasts that is disturbed at random.
//
// It is home where, at forcing phase 0, it is about as near to its orbit as disturbances keep it
// (noise/home.hpp). While it is away, it is asked at random, once in 64 cycles on average, or three times its
// relaxation time, at most 2000, whether it would return within 500 cycles, or twenty times its relaxation
// time, without disturbances. If not, it has left. Its mean life is the mean time until then, without
// those cycles since it was last home or seen to return from whose ends it wouldn't have returned, either;
// excursions from which disturbances brought it home before it was asked don't count. Strong disturbances bring
// it back by chance, and the longer this is waited for, the more often: so it is asked on average after at most
// a quarter of the mean time until it would first not return (the first exit from its basin at phase 0, of
// which up to 200 are followed before), or each cycle. Since it is asked at random, lives grow at most in
// proportion to that time, whose error theirs has.
//
// Where it leaves often, many lives are followed. Where it leaves rarely, the rate at which it departs from
// home is multiplied by the probability that a departure leaves, by adaptive multilevel splitting (Cerou &
// Guyader 2007, Stoch. Anal. Appl. 25, 417): of paths from departures that half which comes less far from home
// is ended, again and again, and others are followed from where the rest got further. Between the ends of
// cycles, the distance is that at the next end without further disturbances. The standard error follows from
// how many departures those that leave descend from; that of as many levels of independent paths is added,
// since a few paths may all miss the ways on which most lives end.
//
// Where no path gets beyond a level, as a motion that forgets within a cycle may do, where the budget ends, or
// where the error were above 63 % or that of four or more lives that were followed, these count. Fewer than
// four tell a bound alone (95 %, Poisson): it is those seen by chance of which a mean would be told, and it
// would be too short. Of none, it is known, too, how rarely paths get as far as is known within 50 %: the
// motion lasts at least that long, roughly.
#pragma once

#include <cstdint>
#include <optional>

#include "cell/result.hpp"
#include "noise/disturbed_map.hpp"
#include "noise/home.hpp"

namespace peterka::noise {

// In forcing cycles.
struct MeanLife {
    double mean = cell::unknown;   // NaN: hardly anything was seen to leave
    double error = cell::unknown;  // standard error
    double least = cell::unknown;  // there: it lasts at least that long, roughly
};

// budget: how many disturbed cycles to compute, roughly. Nothing where home is a tiny part of what disturbances
// reach, or where the engine fails on the way.
[[nodiscard]] std::optional<MeanLife> mean_life(DisturbedMap& map, const Home& home, std::int64_t budget,
                                                std::uint64_t seed);

// The same by following lives with this budget, without splitting.
[[nodiscard]] std::optional<MeanLife> mean_life_followed(DisturbedMap& map, const Home& home,
                                                         std::int64_t budget, std::uint64_t seed);

}  // namespace peterka::noise
