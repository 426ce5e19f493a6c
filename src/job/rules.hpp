// Rules over several keys of a job. Each returns what is wrong, the reason and a suggestion, or an empty
// string.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "job/job.hpp"
#include "job/names.hpp"

namespace peterka::job {

[[nodiscard]] std::string rule_of_direction(std::string_view axis_name, const Axis& axis);
[[nodiscard]] std::string rule_of_logarithm(std::string_view axis_name, const Axis& axis);
[[nodiscard]] std::string rule_of_resolution(std::string_view axis_name, const Axis& axis);
[[nodiscard]] std::string rule_of_engine(const Hammer& hammer, const Contact& contact, const Solver& solver);
// A hammer cannot start beyond a rigid stop: `start` is the largest x(0)/A0 and `gap` the smallest gap/A0 of
// the job.
[[nodiscard]] std::string rule_of_rigid_stop(const Contact& contact, std::string_view start_name, double start,
                                             std::string_view gap_name, double gap);
// The same for all cells of the job.
[[nodiscard]] std::string rule_of_rigid_stop(const Job& job);
// Excitation frequency and gap of all cells, where derived from values in SI units.
[[nodiscard]] std::string rule_of_place(const Job& job);
// The same for the starts of all cells, and for the rectangle of [starts].
[[nodiscard]] std::string rule_of_starts(const Job& job);
// The message for a [contact] key of this law if the job's stop has another law.
[[nodiscard]] std::string reason_for_other_law(ContactLaw law);
[[nodiscard]] std::string rule_of_gaps(const Sweep& sweep);
// For a key of [starts].
[[nodiscard]] std::string rule_of_interval(std::string_view name, const std::vector<double>& interval);
// At the smallest gap, the stop must leave room for some of the starts.
[[nodiscard]] std::string rule_of_room(const Job& job);
// A basin's cells share their attractors, and a sweep without [starts] looks for none.
[[nodiscard]] std::string rule_of_kick(const Job& job);
// For a table of noise: something must disturb.
[[nodiscard]] std::string rule_of_noise(const Noise& noise);
// Only a map's cells with many starts have attractors of their own.
[[nodiscard]] std::string rule_of_proved_starts(const Job& job);
[[nodiscard]] std::string rule_of_proved_attractors(const Job& job);
// Elasticities: of a force, or of an impact speed on a rigid stop; of orbits with linear contacts.
[[nodiscard]] std::string rule_of_elasticities(const Job& job);
[[nodiscard]] std::string rule_of_samples(const Job& job);
[[nodiscard]] std::string rule_of_cells(const Study& study);
[[nodiscard]] std::string rule_of_study(const Contact& contact);
// For a trace with its own rig: what fits a cart at rest and a vibrating one, and the length of the trace.
[[nodiscard]] std::string rule_of_trace(const Job& job);
// For the cell of a map file that [trace] or [basin] names.
[[nodiscard]] std::string rule_of_cell_of_map(const CellOfMap& cell, std::string_view table);
// For a map with borders: the rules for curves.
[[nodiscard]] std::string rule_of_borders(const Job& job);
// For curves: only stops and springs whose orbits have a closed form.
[[nodiscard]] std::string rule_of_curves(const Job& job);
// For the window of the curves, and the gaps in it.
[[nodiscard]] std::string rule_of_window(const Job& job);
// For proofs of where curves have these gaps.
[[nodiscard]] std::string rule_of_proved_crossings(const Job& job);
[[nodiscard]] std::string rule_of_coarse_map(const Job& job);
[[nodiscard]] std::string rule_of_title(std::string_view title);

}  // namespace peterka::job
