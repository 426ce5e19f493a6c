// The position of a cell in words: frequency and gap, and any other quantity that the axes vary. Each
// coordinate leads with the unit in which the job gives it (job::leads_in_si): lengths in mm.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka {

// "Omega/omega 2 (9 Hz), gap/A0 0.5 (0.445 mm), contact.damping_ns_per_m 1200 N s/m"
[[nodiscard]] std::string place_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column);

// "Omega/omega 2 (9 Hz), gap/A0 0.5 (0.445 mm)", or "frequency 9 Hz (Omega/omega 2), ...": of what has one
// place alone.
[[nodiscard]] std::string place_in_words(const job::Job& job);

// "frequency 9 Hz (Omega/omega 2)" or "Omega/omega 2 (9 Hz)".
[[nodiscard]] std::string frequency_in_words(const job::Job& job, double ratio, double hertz);

// "gap 0.445 mm (gap/A0 0.5)" or "gap/A0 0.5 (0.445 mm)".
[[nodiscard]] std::string gap_in_words(const job::Job& job, double ratio, double metres);

// "175 N" or "60 weights": over the weight of the hammer there [N].
[[nodiscard]] std::string short_force_in_words(const job::Job& job, double ratio, double weight, int digits);

// "175.3 N = 60 weights" or "60 weights = 175.3 N".
[[nodiscard]] std::string force_in_words(const job::Job& job, double ratio, double weight, int digits = 4);

// "x/A0 1 (0.89 mm), x'/(A0 omega) 2 (0.0503 m/s)" or "x 0.89 mm, x' 0.0503 m/s", of a cell of a basin.
[[nodiscard]] std::string start_in_words(const scene::Scene& scene, std::int64_t row, std::int64_t column);

// One value of an axis, with its unit: "2 (9 Hz)" of a ratio, "9 Hz" where that leads, "1200 N s/m".
[[nodiscard]] std::string value_in_words(const scene::Scene& scene, std::string_view key, double value,
                                         int digits = 4);

// Significant digits, 4 at least, that tell neighbouring values of an axis, and places half-way between, apart.
[[nodiscard]] int digits_apart(const job::Axis& axis);

// The label before it: "Omega/omega", "contact.damping_ns_per_m"; "frequency" for a value in SI units; "x'" or
// "x'/(A0 omega)" of a start.
[[nodiscard]] std::string label_in_words(std::string_view key);

// "excitation frequencies and gaps", "values of contact.stiffness_n_per_m and contact.damping_ns_per_m"
[[nodiscard]] std::string plane_in_words(const job::Job& job);

// "lowest frequency", "largest gap", "highest contact.damping_ns_per_m"
[[nodiscard]] std::string end_in_words(std::string_view key, bool is_last);

}  // namespace peterka
