// Rules over several keys of a job. Each returns what is wrong with the reason and a suggestion, or an empty
// text.
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
// The same of all cells of the job.
[[nodiscard]] std::string rule_of_rigid_stop(const Job& job);
// Excitation frequency and gap of all cells, where they follow from values in SI units.
[[nodiscard]] std::string rule_of_place(const Job& job);
// The same of the starts of all cells, and of the rectangle of [starts].
[[nodiscard]] std::string rule_of_starts(const Job& job);
// What to say of a key of [contact] that belongs to this law, where the job's stop has another.
[[nodiscard]] std::string reason_for_other_law(ContactLaw law);
[[nodiscard]] std::string rule_of_gaps(const Sweep& sweep);
// Of a key of [starts].
[[nodiscard]] std::string rule_of_interval(std::string_view name, const std::vector<double>& interval);
// The stop must leave some of the starts where it stands closest.
[[nodiscard]] std::string rule_of_room(const Job& job);
// A basin's cells share their attractors, and a sweep without [starts] looks for none.
[[nodiscard]] std::string rule_of_kick(const Job& job);
[[nodiscard]] std::string rule_of_samples(const Job& job);
[[nodiscard]] std::string rule_of_cells(const Study& study);
[[nodiscard]] std::string rule_of_study(const Contact& contact);
// Of a trace with a rig of its own: what fits to a cart at rest and to one that vibrates, and how long it is.
[[nodiscard]] std::string rule_of_trace(const Job& job);
// Of the cell of a map file that [trace] or [basin] names.
[[nodiscard]] std::string rule_of_cell_of_map(const CellOfMap& cell, std::string_view table);
// Of a map that asks for borders: the same as those of curves.
[[nodiscard]] std::string rule_of_borders(const Job& job);
// Of curves: the stops and springs whose orbits have a closed form.
[[nodiscard]] std::string rule_of_curves(const Job& job);
// What lies in their window.
[[nodiscard]] std::string rule_of_window(const Job& job);
[[nodiscard]] std::string rule_of_coarse_map(const Job& job);
[[nodiscard]] std::string rule_of_title(std::string_view title);

}  // namespace peterka::job
