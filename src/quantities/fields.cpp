#include "quantities/fields.hpp"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "job/stored_quantities.hpp"

namespace peterka::quantities {

namespace {

hdf5::Number number_of(cell::NumberKind kind) {
    switch (kind) {
        case cell::NumberKind::label:
            return hdf5::Number::int8;
        case cell::NumberKind::count:
            return hdf5::Number::int32;
        case cell::NumberKind::real:
            break;
    }
    return hdf5::Number::float64;
}

// The value before anything is computed.
double fill_of(const cell::Quantity& quantity) {
    switch (quantity.member.kind) {
        case cell::NumberKind::label:
            return cell::regime_not_computed;
        case cell::NumberKind::count:
            return cell::goes_on;
        case cell::NumberKind::real:
            break;
    }
    return cell::unknown;
}

// For slots beyond a cell's number of attractors or outcomes.
template <template <cell::Units> class Numbers>
double fill_of(const cell::QuantityOf<Numbers>& quantity) {
    return quantity.load(Numbers<cell::Units::of_file>{});
}

template <template <cell::Units> class Numbers>
FieldOf<Numbers> field_of(const cell::QuantityOf<Numbers>& quantity) {
    return {{.name = quantity.name,
             .number = number_of(quantity.member.kind),
             .fill = fill_of(quantity),
             .units = cell::unit_of(quantity.dimension),
             .long_name = quantity.words,
             .flags = quantity.names_of_values,
             .first_flag = quantity.first_value},
            &quantity};
}

// A row of the table as a constant: its members and its dimension are known at compile time.
template <const auto& rows, std::size_t n, template <cell::Units> class Numbers>
void put_in_unit_of_file(Numbers<cell::Units::of_file>& stored,
                         const Numbers<cell::Units::nondimensional>& numbers, const scene::Scales& scales) {
    constexpr const auto& row = rows[n];
    constexpr bool has_unit =
        row.dimension != cell::Dimension::label && row.dimension != cell::Dimension::number;
    double value = row.load(numbers);
    if constexpr (has_unit) value = scales.in_unit_of_file(value, row.dimension);
    row.store(stored, std::isnan(value) ? cell::unknown : value);
}

template <const auto& rows, template <cell::Units> class Numbers>
Numbers<cell::Units::of_file> in_units_of_file(const Numbers<cell::Units::nondimensional>& numbers,
                                               const scene::Scales& scales) {
    Numbers<cell::Units::of_file> stored;
    [&]<std::size_t... n>(std::index_sequence<n...> /*numbers*/) {
        (put_in_unit_of_file<rows, n, Numbers>(stored, numbers, scales), ...);
    }
    (std::make_index_sequence<std::size(rows)>());
    return stored;
}

}  // namespace

std::vector<Field> stored_fields(const job::Job& job) {
    std::vector<Field> stored;
    for (const cell::Quantity* quantity : job::stored_quantities(job)) stored.push_back(field_of(*quantity));
    return stored;
}

std::vector<AttractorField> stored_attractor_fields(const job::Job& job) {
    std::vector<AttractorField> stored;
    for (const cell::AttractorQuantity* quantity : job::stored_attractor_quantities(job)) {
        stored.push_back(field_of(*quantity));
    }
    return stored;
}

std::vector<OutcomeField> stored_outcome_fields(const job::Job& job) {
    std::vector<OutcomeField> stored;
    for (const cell::OutcomeQuantity& quantity : job::stored_outcome_quantities(job)) {
        stored.push_back(field_of(quantity));
    }
    return stored;
}

std::vector<Field> attractor_fields() {
    std::vector<Field> columns;
    for (const cell::Quantity& quantity : cell::quantities) {
        if (quantity.in_attractor_table == cell::InAttractorTable::yes) columns.push_back(field_of(quantity));
    }
    return columns;
}

StoredCell in_file_units(const cell::CellResult& cell, const scene::Scales& scales) {
    return in_units_of_file<cell::table::rows, cell::Result>(cell, scales);
}

StoredAttractor in_file_units(const cell::CellAttractor& attractor, const scene::Scales& scales) {
    return in_units_of_file<cell::table::attractor_rows, cell::Attractor>(attractor, scales);
}

StoredOutcome in_file_units(const cell::CellOutcome& outcome, const scene::Scales& scales) {
    return in_units_of_file<cell::table::outcome_rows, cell::Outcome>(outcome, scales);
}

}  // namespace peterka::quantities
