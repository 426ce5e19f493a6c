// The position of a cell in words: frequency and gap, and any other quantity that the axes vary.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka {

// "Omega/omega 2 (9 Hz), gap/A0 0.5 (0.445 mm), contact.damping_ns_per_m 1200 N s/m"
[[nodiscard]] std::string place_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column);

// "Omega/omega 2 (9 Hz), gap/A0 0.5 (0.445 mm)": that of a basin.
[[nodiscard]] std::string place_in_words(const job::Job& job);

// "x/A0 1 (0.89 mm), x'/(A0 omega) 2 (50.3 mm/s)", of a cell of a basin.
[[nodiscard]] std::string start_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column);

// One value of an axis, with its unit: "2 (9 Hz)" of a frequency in either unit, "1200 N s/m".
[[nodiscard]] std::string value_in_words(const scene::Scene& scene, std::string_view key, double value);

// The label before it: "Omega/omega", "contact.damping_ns_per_m"; "frequency" for a value in SI units alone.
[[nodiscard]] std::string label_in_words(const scene::Scene& scene, std::string_view key);

// "excitation frequencies and gaps", "values of contact.stiffness_n_per_m and contact.damping_ns_per_m"
[[nodiscard]] std::string plane_in_words(const job::Job& job);

// "lowest frequency", "largest gap", "highest contact.damping_ns_per_m"
[[nodiscard]] std::string end_in_words(std::string_view key, bool is_last);

}  // namespace peterka
