#include "job/meant.hpp"

#include <fmt/format.h>

#include "job/nearest.hpp"

namespace peterka::job {
namespace {

struct Unit {
    std::string_view ending;  // of a key's name
    std::string_view words;   // of units that keys have; none for those that only a user may think of
};

// Of two that end alike the longer one comes first.
constexpr Unit units[] = {
    {"_n_per_m_pow_n", "in N/m^n"},
    {"_n_per_mm3", ""},
    {"_n_per_m3", "in N/m^3"},
    {"_kn_per_mm", ""},
    {"_kn_per_m", ""},
    {"_n_per_mm", ""},
    {"_n_per_um", ""},
    {"_ns_per_mm", ""},
    {"_ns_per_m", "in Ns/m"},
    {"_n_per_m", "in N/m"},
    {"_kg_per_s", ""},
    {"_mm_per_s", ""},
    {"_cm_per_s", ""},
    {"_m_per_s", "in m/s"},
    {"_s_per_mm", ""},
    {"_s_per_m", "in s/m"},
    {"_rad_per_s", ""},
    {"_rad_s", ""},
    {"_percent", ""},
    {"_rpm", ""},
    {"_khz", ""},
    {"_hz", "in hertz"},
    {"_mm", ""},
    {"_um", ""},
    {"_cm", ""},
    {"_ms", ""},
    {"_us", ""},
    {"_kg", "in kilograms"},
    {"_g", ""},
    {"_t", ""},
    {"_m", "in metres"},
    {"_s", "in seconds"},
    {"_ratio", "a ratio"},
};

const Unit* unit_of(std::string_view key) {
    for (const Unit& unit : units) {
        if (key.ends_with(unit.ending)) return &unit;
    }
    return nullptr;
}

std::string_view quantity_in(std::string_view key) {
    const Unit* unit = unit_of(key);
    return unit == nullptr ? key : key.substr(0, key.size() - unit->ending.size());
}

// A quantity that is known in several units is meant in the physical one, unless a percentage is given.
std::string_view in_other_unit(std::string_view unknown, const std::vector<std::string_view>& known) {
    std::string_view found;
    const bool is_percentage = unknown.ends_with("_percent");
    for (const std::string_view key : known) {
        if (unit_of(key) == nullptr || quantity_in(key) != quantity_in(unknown)) continue;
        if (found.empty() || key.ends_with("_ratio") == is_percentage) found = key;
    }
    return found;
}

}  // namespace

std::string Meant::question(std::string_view before, std::string_view after) const {
    return fmt::format("did you mean {}{}{}{}{}?", before, key, after, unit.empty() ? "" : ", ", unit);
}

Meant meant_by(std::string_view unknown, const std::vector<std::string_view>& known) {
    const Unit* written = unit_of(unknown);
    std::string_view key = written == nullptr ? "" : in_other_unit(unknown, known);
    if (key.empty()) key = nearest(unknown, known);
    const Unit* right = unit_of(key);
    const bool differ = written != nullptr && right != nullptr && written != right;
    return {key, differ ? right->words : ""};
}

}  // namespace peterka::job
