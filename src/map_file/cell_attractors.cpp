#include "map_file/cell_attractors.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "quantities/fields.hpp"

namespace peterka::map_file {

namespace {

struct AttractorColumn {
    hdf5::Variable variable;
    double (*load)(const StoredAttractor&);
    void (*store)(StoredAttractor&, double);
};

template <auto Pointer>
constexpr AttractorColumn column(const hdf5::Variable& variable) {
    return {variable, [](const StoredAttractor& from) { return static_cast<double>(from.*Pointer); },
            [](StoredAttractor& to, double value) {
                to.*Pointer = static_cast<std::remove_reference_t<decltype(to.*Pointer)>>(value);
            }};
}

// clang-format off
constexpr AttractorColumn attractor_columns[] = {
    column<&StoredAttractor::regime>({"attractor_regime", hdf5::Number::int8, regime::regime_not_computed, "", "regime of an attractor of the cell, those with the largest shares first", quantities::regime_names}),
    column<&StoredAttractor::impacts>({"attractor_impacts", hdf5::Number::int32, -1, "1", "impacts p of its z = p/q"}),
    column<&StoredAttractor::period>({"attractor_period", hdf5::Number::int32, -1, "1", "period q of its z = p/q in forcing cycles"}),
    column<&StoredAttractor::peak_force>({"attractor_peak_force_ratio", hdf5::Number::float64, regime::unknown, "1", "its peak impact force over hammer weight, F/(m g0)"}),
    column<&StoredAttractor::share>({"basin_share", hdf5::Number::float64, 0, "1", "share of the cell's starts that end on it"}),
    column<&StoredAttractor::critical_kick>({"critical_kick", hdf5::Number::float64, regime::unknown, "m/s", "smallest sudden change of the hammer's velocity at forcing phase 0 after which its settled motion ends elsewhere"}),
};
// clang-format on

const AttractorColumn& column_of(const hdf5::Variable& variable) {
    return *std::ranges::find_if(
        attractor_columns, [&](const AttractorColumn& each) { return each.variable.name == variable.name; });
}

}  // namespace

std::vector<hdf5::Variable> attractor_variables(const job::Job& job) {
    std::vector<hdf5::Variable> variables;
    if (job.starts.count == 0) return variables;
    for (const AttractorColumn& each : attractor_columns) variables.push_back(each.variable);
    if (!job.output.has(job::OptionalField::critical_kick)) variables.pop_back();  // the last one
    return variables;
}

std::vector<StoredAttractor> in_file_units(std::span<const attractors::SolvedCell> cells, std::int64_t kept,
                                           std::span<const scene::Scales> scales) {
    std::vector<StoredAttractor> stored(static_cast<std::size_t>(kept) * cells.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        for (std::size_t slot = 0; slot < cells[cell].attractors.size(); ++slot) {
            StoredAttractor& attractor = stored[slot * cells.size() + cell];
            attractor = cells[cell].attractors[slot];
            attractor.peak_force *= scales[cell].force_ratio();
            attractor.critical_kick *= scales[cell].length_m * scales[cell].frequency_rad_per_s;
            // every NaN the same NaN, so that equal results are equal bytes
            if (std::isnan(attractor.peak_force)) attractor.peak_force = regime::unknown;
            if (std::isnan(attractor.critical_kick)) attractor.critical_kick = regime::unknown;
        }
    }
    return stored;
}

std::vector<std::byte> encode(std::span<const hdf5::Variable> variables,
                              std::span<const StoredAttractor> attractors) {
    std::vector<std::byte> bytes;
    for (const hdf5::Variable& variable : variables) {
        const AttractorColumn& stored = column_of(variable);
        hdf5::visit_number(variable.number, [&](auto zero) {
            for (const StoredAttractor& attractor : attractors) {
                const auto value = static_cast<decltype(zero)>(stored.load(attractor));
                const auto* first = reinterpret_cast<const std::byte*>(&value);
                bytes.insert(bytes.end(), first, first + sizeof value);
            }
        });
    }
    return bytes;
}

std::vector<StoredAttractor> decode(std::span<const hdf5::Variable> variables, std::span<const std::byte> bytes,
                                    std::size_t count) {
    std::vector<StoredAttractor> attractors(count);
    const std::byte* next = bytes.data();
    for (const hdf5::Variable& variable : variables) {
        const AttractorColumn& stored = column_of(variable);
        hdf5::visit_number(variable.number, [&](auto value) {
            for (StoredAttractor& attractor : attractors) {
                std::memcpy(&value, next, sizeof value);
                next += sizeof value;
                stored.store(attractor, static_cast<double>(value));
            }
        });
    }
    return attractors;
}

}  // namespace peterka::map_file
