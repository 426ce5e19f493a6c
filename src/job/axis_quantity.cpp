#include "job/axis_quantity.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "job/number_walker.hpp"
#include "job/schema_plane.hpp"
#include "job/schema_rig.hpp"

namespace peterka::job {
namespace {

// Spaced like other units: "Ns/m" becomes "N s/m".
std::string spaced(std::string unit) {
    if (unit.starts_with("Ns")) unit.insert(1, " ");
    return unit;
}

AxisQuantity made(std::string key, std::string_view meaning, const Range<double>& range) {
    AxisQuantity quantity;
    quantity.key = std::move(key);
    quantity.meaning = meaning;
    quantity.range = range;
    quantity.coordinate = quantity.key;
    std::ranges::replace(quantity.coordinate, '.', '_');
    const std::size_t bracket = meaning.rfind(" [");
    quantity.long_name = meaning.substr(0, bracket);
    if (bracket != std::string_view::npos) {
        quantity.units = spaced(std::string(meaning.substr(bracket + 2, meaning.size() - bracket - 3)));
    }
    return quantity;
}

// Collects the numbers of a table, and its non-numeric keys.
class Collector : public NumberWalker {
  public:
    Collector(std::string table, std::vector<AxisQuantity>& numbers, std::vector<std::string>& others)
        : table_(std::move(table)), numbers_(numbers), others_(others) {}

    void number(const Key& key, double&, const Range<double>& range) { add(key, range); }
    void either(const Alternative& first, const Alternative& second, std::string_view) {
        add(first.key, first.range);
        add(second.key, second.range);
    }
    template <typename Choice>
    bool choice(const Key& key, Choice&) {
        others_.push_back(fmt::format("{}.{}", table_, key.name));
        return true;
    }

  private:
    void add(const Key& key, const Range<double>& range) {
        numbers_.push_back(made(fmt::format("{}.{}", table_, key.name), key.meaning, range));
        numbers_.back().from = numbers_.back().to = key.is_required() ? key.example : "0.0";
    }

    std::string table_;
    std::vector<AxisQuantity>& numbers_;
    std::vector<std::string>& others_;
};

struct Quantities {
    std::vector<AxisQuantity> numbers;
    std::vector<std::string> others{"contact.law"};

    Quantities() {
        for (const Quantity& plain : {frequency_ratio, gap_ratio, frequency_hz, gap_m, displacement_ratio,
                                      velocity_ratio, displacement_m, velocity_m_per_s}) {
            numbers.push_back(made(std::string(plain.name), plain.meaning, plain.range));
            numbers.back().from = plain.from;
            numbers.back().to = plain.to;
        }
        Hammer hammer;
        Cart cart;
        Start start;
        collect("hammer", hammer);
        collect("cart", cart);
        collect_laws(static_cast<const Contact*>(nullptr));
        collect("start", start);
    }

  private:
    template <class... Laws>
    void collect_laws(const std::variant<Laws...>* /*contact*/) {
        (collect("contact", Laws()), ...);
    }
    template <typename Part>
    void collect(const char* table, Part part) {
        const std::size_t before = numbers.size();
        Collector collector(table, numbers, others);
        describe(collector, part);
        if constexpr (std::is_constructible_v<Contact, Part>) {
            for (std::size_t i = before; i < numbers.size(); ++i) numbers[i].law = law_of(Contact(part));
        }
    }
};

const Quantities& quantities() {
    static const Quantities all;
    return all;
}

}  // namespace

std::vector<std::string_view> axis_keys(ContactLaw law) {
    std::vector<std::string_view> keys;
    for (const AxisQuantity& each : quantities().numbers) {
        if (!is_start_of_basin(each.key) && (!each.law || each.law == law)) keys.emplace_back(each.key);
    }
    return keys;
}

const std::vector<AxisQuantity>& axis_quantities() {
    return quantities().numbers;
}

std::string key_in_tables(std::string_view key) {
    if (is_frequency(key) || is_gap(key)) return fmt::format("operating_point.{}", key);
    return is_start_of_basin(key) ? fmt::format("start.{}", key) : std::string(key);
}

bool is_no_number(std::string_view key) {
    return std::ranges::find(quantities().others, key) != quantities().others.end();
}

const AxisQuantity* find_quantity(std::string_view key) {
    const auto& all = quantities().numbers;
    const auto found = std::ranges::find(all, key, &AxisQuantity::key);
    return found == all.end() ? nullptr : &*found;
}

const AxisQuantity& quantity(std::string_view key) {
    if (const AxisQuantity* found = find_quantity(key)) return *found;
    throw std::logic_error(fmt::format("no axis runs over {}", key));
}

AxisNames axis_names(const Job& job) {
    return {quantity(column_key(job)).coordinate,
            job.kind == Kind::sweep ? std::string_view("branch") : quantity(row_key(job)).coordinate};
}

}  // namespace peterka::job
