#include "job/axis_key.hpp"

#include <algorithm>
#include <utility>

#include "job/twins.hpp"

namespace peterka::job {

bool says_the_same(std::string_view key, std::string_view other) {
    constexpr std::pair<std::string_view, std::string_view> pairs[] = {
        {"hammer.natural_frequency_hz", "hammer.stiffness_n_per_m"},
        {"hammer.damping_ns_per_m", "hammer.damping_ratio"}};
    return key == other || (!other.empty() && twin_of(key) == other) ||
           std::ranges::any_of(pairs, [&](const auto& pair) {
               return (key == pair.first && other == pair.second) ||
                      (key == pair.second && other == pair.first);
           });
}

std::string_view axis_key_of(std::string_view key_in_tables) {
    constexpr std::string_view place = "operating_point.";
    return key_in_tables.starts_with(place) ? key_in_tables.substr(place.size()) : key_in_tables;
}

std::string_view column_key(const Job& job) {
    if (!job.columns.over.empty()) return job.columns.over;
    return job.kind == Kind::basin ? "displacement_ratio" : "frequency_ratio";
}

std::string_view row_key(const Job& job) {
    if (!job.rows.over.empty()) return job.rows.over;
    return job.kind == Kind::basin ? "velocity_ratio" : "gap_ratio";
}

bool is_frequency(std::string_view key) {
    return key == "frequency_ratio" || key == "frequency_hz";
}

bool is_gap(std::string_view key) {
    return key == "gap_ratio" || key == "gap_m";
}

bool is_displacement(std::string_view key) {
    return key == "displacement_ratio" || key == "displacement_m";
}

bool is_velocity(std::string_view key) {
    return key == "velocity_ratio" || key == "velocity_m_per_s";
}

bool is_of_rig(std::string_view key) {
    return key.starts_with("hammer.") || key.starts_with("cart.") || key.starts_with("contact.");
}

std::string_view why_no_curves_over(std::string_view key) {
    if (key.starts_with("start."))
        return "is for maps and sweeps; a curve is where motions end, wherever the hammer starts";
    if (key == "hammer.cubic_stiffness_n_per_m3")
        return "is for maps and sweeps; curves leave the cubic part of the springs out";
    return "";
}

bool has_axis(const Job& job, bool (*is_it)(std::string_view key)) {
    if (job.kind == Kind::trace || job.kind == Kind::basin) return false;
    return is_it(column_key(job)) || (job.kind != Kind::sweep && is_it(row_key(job)));
}

}  // namespace peterka::job
