// What is proved of the places where curves have the requested gaps, in words.
#pragma once

#include <string>
#include <string_view>

#include "curves/search.hpp"

namespace peterka::curves {

// The proved interval of one such place, to follow its number: in Hz for a frequency, otherwise in the unit of
// the key, rounded outward. Empty if it is not proved.
[[nodiscard]] std::string proof_in_words(const job::Job& job, std::string_view key,
                                         const certificate::CrossingProof& proof);

// How many are proved, how narrowly, and why the others are not. Empty if no proofs are requested.
[[nodiscard]] std::string proofs_in_words(const scene::Scene& scene, const CurveSearchResult& found);

}  // namespace peterka::curves
