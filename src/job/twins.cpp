#include "job/twins.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "job/axis_key.hpp"
#include "job/derived.hpp"

namespace peterka::job {
namespace {

struct Pair {
    std::string_view ratio;
    std::string_view si;
    double (*unit)(const CellNumbers&);  // value of a ratio of 1 in SI units
};

double hertz(const CellNumbers& rig) {
    return natural_frequency_hz(rig.hammer);
}
double metres(const CellNumbers& rig) {
    return rig.cart.amplitude_m;
}
double metres_per_second(const CellNumbers& rig) {
    return rig.cart.amplitude_m * derive(rig.hammer).omega_rad_per_s;
}

constexpr Pair pairs[] = {{"frequency_ratio", "frequency_hz", hertz},
                          {"gap_ratio", "gap_m", metres},
                          {"displacement_ratio", "displacement_m", metres},
                          {"velocity_ratio", "velocity_m_per_s", metres_per_second},
                          {"start.displacement_ratio", "start.displacement_m", metres},
                          {"start.velocity_ratio", "start.velocity_m_per_s", metres_per_second}};

const Pair* find(std::string_view key) {
    const auto* found =
        std::ranges::find_if(pairs, [&](const Pair& pair) { return pair.ratio == key || pair.si == key; });
    return found == std::end(pairs) ? nullptr : found;
}

// The keys by which a job gives its coordinates, those of its axes first.
std::vector<std::string_view> keys_of_axes(const Job& job) {
    std::vector<std::string_view> keys;
    if (job.kind == Kind::trace || job.kind == Kind::study) return keys;
    keys.push_back(column_key(job));
    if (job.kind != Kind::sweep) keys.push_back(row_key(job));
    if (job.kind == Kind::sweep && !job.sweep.gaps().empty()) keys.push_back(job.sweep.gap_key());
    return keys;
}
std::vector<std::string_view> keys_of_place(const Job& job) {
    const OperatingPoint& place = job.operating_point;
    return {place.frequency_hz ? "frequency_hz" : "frequency_ratio", place.gap_m ? "gap_m" : "gap_ratio"};
}

}  // namespace

std::string_view twin_of(std::string_view key) {
    const Pair* pair = find(key);
    if (pair == nullptr) return "";
    return key == pair->ratio ? pair->si : pair->ratio;
}

bool is_in_si(std::string_view key) {
    const Pair* pair = find(key);
    return pair != nullptr && key == pair->si;
}

double unit_of(std::string_view key, const CellNumbers& rig) {
    const Pair* pair = find(key);
    return pair == nullptr ? 1 : pair->unit(rig);
}

double as_twin(std::string_view key, double value, const CellNumbers& rig) {
    return is_in_si(key) ? value / unit_of(key, rig) : value * unit_of(key, rig);
}

bool leads_in_si(const Job& job, std::string_view key) {
    std::vector<std::string_view> given = keys_of_axes(job);
    if (key.empty()) return std::ranges::any_of(given.empty() ? keys_of_place(job) : given, is_in_si);
    std::ranges::copy(keys_of_place(job), std::back_inserter(given));
    const auto* pair = find(key);
    const auto says_it = [&](std::string_view other) { return pair != nullptr && find(other) == pair; };
    const auto first = std::ranges::find_if(given, says_it);
    return first != given.end() && is_in_si(*first);
}

// Each number is monotonic along an axis, so it suffices to check its ends.
std::optional<Twin> shared_twin(const Job& job, std::string_view key) {
    const Pair* pair = find(key);
    if (pair == nullptr) return std::nullopt;
    const CellNumbers rig = numbers_in(job);
    const bool has_rows = job.kind != Kind::sweep;
    for (const double column : {job.columns.from, job.columns.to}) {
        for (const double row : {job.rows.from, job.rows.to}) {
            CellNumbers other = rig;
            if (is_of_rig(column_key(job))) set_number(other, column_key(job), column);
            if (has_rows && is_of_rig(row_key(job))) set_number(other, row_key(job), row);
            if (pair->unit(other) != pair->unit(rig)) return std::nullopt;
        }
    }
    return Twin{twin_of(key), key, rig};
}

std::optional<Twin> twin_of_columns(const Job& job) {
    return shared_twin(job, column_key(job));
}

std::optional<Twin> twin_of_rows(const Job& job) {
    return job.kind == Kind::sweep ? std::nullopt : shared_twin(job, row_key(job));
}

std::optional<Twin> twin_of_branches(const Job& job) {
    return job.kind != Kind::sweep || job.sweep.gaps().empty() ? std::nullopt
                                                               : shared_twin(job, job.sweep.gap_key());
}

}  // namespace peterka::job
