#include "job/cell_numbers.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <string_view>
#include <variant>

#include "job/axis.hpp"
#include "job/axis_key.hpp"
#include "job/derived.hpp"
#include "job/number_walker.hpp"
#include "job/schema_rig.hpp"
#include "job/twins.hpp"

namespace peterka::job {
namespace {

struct Settable {
    std::string_view key;
    void (*set)(CellNumbers&, double);
};

// clang-format off
constexpr Settable named[] = {
    {"frequency_ratio", [](CellNumbers& cell, double value) { cell.place.frequency_ratio = value; cell.place.frequency_hz.reset(); }},
    {"frequency_hz", [](CellNumbers& cell, double value) { cell.place.frequency_hz = value; }},
    {"gap_ratio", [](CellNumbers& cell, double value) { cell.place.gap_ratio = value; cell.place.gap_m.reset(); }},
    {"gap_m", [](CellNumbers& cell, double value) { cell.place.gap_m = value; }},
    {"displacement_ratio", [](CellNumbers& cell, double value) { cell.start.displacement_ratio = value; cell.start.displacement_m.reset(); }},
    {"displacement_m", [](CellNumbers& cell, double value) { cell.start.displacement_m = value; }},
    {"velocity_ratio", [](CellNumbers& cell, double value) { cell.start.velocity_ratio = value; cell.start.velocity_m_per_s.reset(); }},
    {"velocity_m_per_s", [](CellNumbers& cell, double value) { cell.start.velocity_m_per_s = value; }},
};
// clang-format on

// Sets one number in a table of the job by its schema name. A stop of another law has no such number: axes over
// it are refused (table_reader_axes.cpp).
class NumberSetter : public NumberWalker {
  public:
    NumberSetter(std::string_view name, double value) : name_(name), value_(value) {}

    void number(const Key& key, double& number, const Range<double>& /*range*/) {
        if (key.name == name_) number = value_;
    }
    void either(const Alternative& first, const Alternative& second, std::string_view /*meaning*/) {
        choose(first, second);
        choose(second, first);
    }

  private:
    void choose(const Alternative& one, const Alternative& other) {
        if (one.key.name != name_) return;
        one.value = value_;
        other.value.reset();
    }

    std::string_view name_;
    double value_;
};

// Finds one number in a table, if the table has it.
class NumberGetter : public NumberWalker {
  public:
    explicit NumberGetter(std::string_view name) : name_(name) {}

    void number(const Key& key, double& number, const Range<double>& /*range*/) {
        if (key.name == name_) found = &number;
    }
    void either(const Alternative& first, const Alternative& second, std::string_view /*meaning*/) {
        for (const Alternative& one : {first, second}) {
            if (one.key.name == name_ && one.value) found = &*one.value;
        }
    }
    const double* found = nullptr;

  private:
    std::string_view name_;
};

// Returns whether the job has such a table.
template <typename Walker>
bool walk(CellNumbers& numbers, std::string_view table, Walker& walker) {
    if (table == "hammer") {
        describe(walker, numbers.hammer);
    } else if (table == "cart") {
        describe(walker, numbers.cart);
    } else if (table == "contact") {
        std::visit([&](auto& stop) { describe(walker, stop); }, numbers.contact);
    } else {
        return false;
    }
    return true;
}

// Of two alternative keys of the hammer, from the one that is given.
std::optional<double> derived_number(const Hammer& hammer, std::string_view key) {
    if (key == "hammer.natural_frequency_hz") return natural_frequency_hz(hammer);
    if (key == "hammer.stiffness_n_per_m") return hammer.stiffness();
    if (key == "hammer.damping_ns_per_m") return hammer.damping();
    if (key == "hammer.damping_ratio") return derive(hammer).zeta;
    return std::nullopt;
}

}  // namespace

double CellNumbers::frequency_ratio() const {
    return place.frequency_hz ? as_twin("frequency_hz", *place.frequency_hz, *this) : place.frequency_ratio;
}

double CellNumbers::gap_ratio() const {
    return place.gap_m ? as_twin("gap_m", *place.gap_m, *this) : place.gap_ratio;
}

double CellNumbers::displacement_ratio() const {
    return start.displacement_m ? as_twin("displacement_m", *start.displacement_m, *this)
                                : start.displacement_ratio;
}

double CellNumbers::velocity_ratio() const {
    return start.velocity_m_per_s ? as_twin("velocity_m_per_s", *start.velocity_m_per_s, *this)
                                  : start.velocity_ratio;
}

CellNumbers numbers_in(const Job& job) {
    return {job.hammer, job.cart, job.contact, job.operating_point, job.start};
}

void set_number(CellNumbers& numbers, std::string_view key, double value) {
    constexpr std::string_view of_start = "start.";  // an axis of a basin omits it
    const std::string_view name = key.starts_with(of_start) ? key.substr(of_start.size()) : key;
    const auto* found = std::ranges::find(named, name, &Settable::key);
    if (found != std::end(named)) return found->set(numbers, value);
    const std::size_t dot = std::min(key.find('.'), key.size() - 1);
    NumberSetter setter(key.substr(dot + 1), value);
    if (!walk(numbers, key.substr(0, dot), setter))
        std::abort();  // a fault of the program: no job names such an axis (and the page's engine has no
                       // exceptions)
}

double number_of(const CellNumbers& numbers, std::string_view key) {
    if (key == "frequency_ratio") return numbers.frequency_ratio();
    if (key == "frequency_hz") return as_twin("frequency_ratio", numbers.frequency_ratio(), numbers);
    if (key == "gap_ratio") return numbers.gap_ratio();
    if (key == "gap_m") return as_twin("gap_ratio", numbers.gap_ratio(), numbers);
    const std::size_t dot = std::min(key.find('.'), key.size() - 1);
    NumberGetter getter(key.substr(dot + 1));
    CellNumbers copy = numbers;
    if (!walk(copy, key.substr(0, dot), getter)) std::abort();  // as above
    if (getter.found != nullptr) return *getter.found;
    return derived_number(numbers.hammer, key).value();
}

bool gives_number(const CellNumbers& numbers, std::string_view key) {
    if (is_frequency(key) || is_gap(key)) return true;
    const std::size_t dot = std::min(key.find('.'), key.size() - 1);
    NumberGetter getter(key.substr(dot + 1));
    CellNumbers copy = numbers;
    return walk(copy, key.substr(0, dot), getter) && getter.found != nullptr && *getter.found != 0;
}

CellNumbers numbers_at(const Job& job, std::int64_t row, std::int64_t column) {
    CellNumbers numbers = numbers_in(job);
    set_number(numbers, column_key(job), axis_value(job.columns, column));
    if (job.kind != Kind::sweep) {
        set_number(numbers, row_key(job), axis_value(job.rows, row));
    } else if (const auto gap = job.sweep.branch(row).gap) {
        set_number(numbers, job.sweep.gap_key(), *gap);
    }
    return numbers;
}

std::vector<CellNumbers> numbers_of_cells(const Job& job) {
    std::vector<CellNumbers> cells;
    const Study& study = job.study;
    for (std::size_t n = 0; n < study.frequencies().size(); ++n) {
        CellNumbers& cell = cells.emplace_back(numbers_in(job));
        set_number(cell, study.frequency_key(), study.frequencies()[n]);
        set_number(cell, study.gap_key(), study.gaps()[n]);
    }
    return cells;
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
