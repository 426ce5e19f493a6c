#include "job/axis_key.hpp"

#include <algorithm>
#include <utility>

namespace peterka::job {

bool says_the_same(std::string_view key, std::string_view other) {
    constexpr std::pair<std::string_view, std::string_view> pairs[] = {
        {"frequency_ratio", "frequency_hz"},
        {"gap_ratio", "gap_m"},
        {"hammer.natural_frequency_hz", "hammer.stiffness_n_per_m"},
        {"hammer.damping_ns_per_m", "hammer.damping_ratio"}};
    return key == other || std::ranges::any_of(pairs, [&](const auto& pair) {
               return (key == pair.first && other == pair.second) ||
                      (key == pair.second && other == pair.first);
           });
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

bool is_of_rig(std::string_view key) {
    return key.starts_with("hammer.") || key.starts_with("cart.") || key.starts_with("contact.");
}

bool has_axis(const Job& job, bool (*is_it)(std::string_view key)) {
    if (job.kind == Kind::trace || job.kind == Kind::basin) return false;
    return is_it(column_key(job)) || (job.kind != Kind::sweep && is_it(row_key(job)));
}

}  // namespace peterka::job
