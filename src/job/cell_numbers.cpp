#include "job/cell_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <variant>

#include "job/axis.hpp"
#include "job/axis_key.hpp"
#include "job/derived.hpp"

namespace peterka::job {
namespace {

struct Named {
    std::string_view key;
    void (*set)(CellNumbers&, double);
};

// The stop has the law to which the number belongs: axes over others are refused (table_reader_axes.cpp).
template <auto Member>
constexpr auto set_of_stop = [](CellNumbers& cell, double value) {
    const auto set = []<class Stop>(double Stop::*member, Contact& contact, double to) {
        if (auto* stop = std::get_if<Stop>(&contact)) stop->*member = to;
    };
    set(Member, cell.contact, value);
};

// clang-format off
constexpr Named named[] = {
    {"frequency_ratio", [](CellNumbers& cell, double value) { cell.place.frequency_ratio = value; cell.place.frequency_hz.reset(); }},
    {"frequency_hz", [](CellNumbers& cell, double value) { cell.place.frequency_hz = value; }},
    {"gap_ratio", [](CellNumbers& cell, double value) { cell.place.gap_ratio = value; cell.place.gap_m.reset(); }},
    {"gap_m", [](CellNumbers& cell, double value) { cell.place.gap_m = value; }},
    {"displacement_ratio", [](CellNumbers& cell, double value) { cell.start.displacement_ratio = value; }},
    {"velocity_ratio", [](CellNumbers& cell, double value) { cell.start.velocity_ratio = value; }},
    {"start.displacement_ratio", [](CellNumbers& cell, double value) { cell.start.displacement_ratio = value; }},
    {"start.velocity_ratio", [](CellNumbers& cell, double value) { cell.start.velocity_ratio = value; }},
    {"hammer.mass_kg", [](CellNumbers& cell, double value) { cell.hammer.mass_kg = value; }},
    {"hammer.natural_frequency_hz", [](CellNumbers& cell, double value) { cell.hammer.natural_frequency_hz = value; cell.hammer.stiffness_n_per_m.reset(); }},
    {"hammer.stiffness_n_per_m", [](CellNumbers& cell, double value) { cell.hammer.stiffness_n_per_m = value; cell.hammer.natural_frequency_hz.reset(); }},
    {"hammer.damping_ns_per_m", [](CellNumbers& cell, double value) { cell.hammer.damping_ns_per_m = value; cell.hammer.damping_ratio.reset(); }},
    {"hammer.damping_ratio", [](CellNumbers& cell, double value) { cell.hammer.damping_ratio = value; cell.hammer.damping_ns_per_m.reset(); }},
    {"hammer.cubic_stiffness_n_per_m3", [](CellNumbers& cell, double value) { cell.hammer.cubic_stiffness_n_per_m3 = value; }},
    {"cart.amplitude_m", [](CellNumbers& cell, double value) { cell.cart.amplitude_m = value; }},
    {"contact.stiffness_n_per_m", set_of_stop<&KelvinVoigt::stiffness_n_per_m>},
    {"contact.damping_ns_per_m", set_of_stop<&KelvinVoigt::damping_ns_per_m>},
    {"contact.coefficient", set_of_stop<&Restitution::coefficient>},
    {"contact.stiffness_n_per_m_pow_n", set_of_stop<&HuntCrossley::stiffness_n_per_m_pow_n>},
    {"contact.exponent", set_of_stop<&HuntCrossley::exponent>},
    {"contact.dissipation_s_per_m", set_of_stop<&HuntCrossley::dissipation_s_per_m>},
};
// clang-format on

}  // namespace

double CellNumbers::frequency_ratio() const {
    return place.frequency_hz ? *place.frequency_hz / natural_frequency_hz(hammer) : place.frequency_ratio;
}

double CellNumbers::gap_ratio() const {
    return place.gap_m ? *place.gap_m / cart.amplitude_m : place.gap_ratio;
}

CellNumbers numbers_in(const Job& job) {
    return {job.hammer, job.cart, job.contact, job.operating_point, job.start};
}

void set_number(CellNumbers& numbers, std::string_view key, double value) {
    const auto* found = std::ranges::find(named, key, &Named::key);
    if (found == std::end(named)) throw std::logic_error("no axis runs over " + std::string(key));
    found->set(numbers, value);
}

CellNumbers numbers_at(const Job& job, std::int64_t row, std::int64_t column) {
    CellNumbers numbers = numbers_in(job);
    set_number(numbers, column_key(job), axis_value(job.columns, column));
    if (job.kind != Kind::sweep) {
        set_number(numbers, row_key(job), axis_value(job.rows, row));
    } else if (const double gap = job.sweep.branch(row).gap_ratio; !std::isnan(gap)) {
        set_number(numbers, "gap_ratio", gap);
    }
    return numbers;
}

std::vector<CellNumbers> numbers_at_corners(const Job& job) {
    const bool has_axes = job.kind != Kind::trace && job.kind != Kind::basin;
    if (!has_axes) return {numbers_in(job)};
    std::vector<CellNumbers> numbers;
    std::vector<std::int64_t> rows{0, job.rows.points - 1};
    if (job.kind == Kind::sweep) {
        rows.clear();
        for (std::int64_t i = 0; i < job.sweep.branches(); ++i) rows.push_back(i);
    }
    for (const std::int64_t row : rows) {
        for (const std::int64_t column : {std::int64_t{0}, job.columns.points - 1}) {
            numbers.push_back(numbers_at(job, row, column));
        }
    }
    return numbers;
}

}  // namespace peterka::job
