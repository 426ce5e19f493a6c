#include "refine/fill_attractors.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "cell/quantities.hpp"

namespace peterka::refine {
namespace {

using attractors::CellAttractor;
using attractors::CellOutcome;

constexpr double steps_between_neighbours = 2;  // steps of a share, in starts or rigs, that count as smooth

// What a cell has several of, each with a label and a share of what was tried.
struct Attractors {
    using Slot = CellAttractor;
    static const auto& at(const Surroundings& around, std::size_t i, std::size_t j) {
        return around.attractors_at(i, j);
    }
    static std::int32_t count(const cell::CellResult& cell) { return cell.attractors; }
    static auto& share(auto& slot) { return slot.share; }
    static constexpr auto quantities = cell::attractor_quantities;
};
struct Outcomes {
    using Slot = CellOutcome;
    static const auto& at(const Surroundings& around, std::size_t i, std::size_t j) {
        return around.outcomes_at(i, j);
    }
    static std::int32_t count(const cell::CellResult& cell) { return cell.outcomes; }
    static auto& share(auto& slot) { return slot.probability; }
    static constexpr auto quantities = cell::outcome_quantities;
};

template <class Slot>
auto label_of(const Slot& slot) {
    return std::tuple(slot.regime, slot.period, slot.impacts);
}

template <class Kind, class Slot>
bool goes_before(const Slot& a, const Slot& b) {
    const double first = Kind::share(a);
    const double second = Kind::share(b);
    return first != second ? first > second : label_of(a) < label_of(b);
}

// The slots with one label of all cells around; nothing if a cell has none or two, or another number in all.
template <class Kind>
class SameLabel {
  public:
    using Slot = typename Kind::Slot;

    static std::optional<SameLabel> find(const Surroundings& around, const Slot& like, std::size_t of_each) {
        SameLabel found;
        for (std::size_t i = 0; i < around.rows().size; ++i) {
            for (std::size_t j = 0; j < around.columns().size; ++j) {
                const auto& here = Kind::at(around, i, j);
                const auto is_one = [&](const Slot& each) { return label_of(each) == label_of(like); };
                const bool complete = here.size() == of_each &&
                                      Kind::count(around.at(i, j)) == static_cast<std::int32_t>(of_each);
                if (!complete || std::ranges::count_if(here, is_one) != 1) return std::nullopt;
                found.slots_[i][j] = &*std::ranges::find_if(here, is_one);
            }
        }
        return found;
    }
    template <class Number>
    [[nodiscard]] std::optional<double> interpolated(const Surroundings& around, const Number& number,
                                                     double rough = 0) const {
        const auto value_at = [&](auto i, auto j) { return number(*slots_[i][j]); };
        return refine::interpolated(around, values_around(around, value_at), rough);
    }

  private:
    std::array<std::array<const Slot*, 4>, 4> slots_{};
};

template <class Kind>
std::optional<typename Kind::Slot> filled_one(const Surroundings& around, const typename Kind::Slot& like,
                                              std::size_t of_each, std::int64_t tried) {
    const auto same = SameLabel<Kind>::find(around, like, of_each);
    if (!same) return std::nullopt;
    typename Kind::Slot slot;
    for (const auto& quantity : Kind::quantities) {
        if (quantity.filled == cell::Filled::as_around) quantity.store(slot, quantity.load(like));
    }
    const double step = steps_between_neighbours / static_cast<double>(tried);
    const auto share = same->interpolated(
        around, [](const auto& each) { return Kind::share(each); }, step);
    if (!share || *share < 0) return std::nullopt;
    Kind::share(slot) = *share;
    if (!regime::has_period(like.regime)) return slot;  // no smooth numbers
    for (const auto& quantity : Kind::quantities) {
        if (quantity.filled != cell::Filled::interpolated) continue;
        const auto value = same->interpolated(around, [&](const auto& each) { return quantity.load(each); });
        if (!value) return std::nullopt;
        quantity.store(slot, *value);
    }
    return slot;
}

template <class Kind>
std::optional<std::vector<typename Kind::Slot>> filled_slots(const Surroundings& around, std::int64_t tried) {
    const auto& next = Kind::at(around, around.rows().before, around.columns().before);
    std::vector<typename Kind::Slot> filled;
    for (const auto& like : next) {
        const auto slot = filled_one<Kind>(around, like, next.size(), tried);
        if (!slot) return std::nullopt;
        filled.push_back(*slot);
    }
    std::ranges::sort(filled, [](const auto& a, const auto& b) { return goes_before<Kind>(a, b); });
    return filled;
}

}  // namespace

std::optional<std::vector<CellAttractor>> filled_attractors(const Surroundings& around, std::int64_t starts) {
    return filled_slots<Attractors>(around, starts);
}

std::optional<std::vector<CellOutcome>> filled_outcomes(const Surroundings& around, std::int64_t rigs) {
    return filled_slots<Outcomes>(around, rigs);
}

}  // namespace peterka::refine
