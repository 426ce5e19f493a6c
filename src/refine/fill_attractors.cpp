#include "refine/fill_attractors.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>

#include "cell/quantities.hpp"

namespace peterka::refine {
namespace {

using attractors::CellAttractor;
using regime::Regime;

constexpr double steps_between_neighbours = 2;  // steps of a share, in starts, that count as smooth

auto label_of(const CellAttractor& attractor) {
    return std::tuple(attractor.regime, attractor.period, attractor.impacts);
}

bool goes_before(const CellAttractor& a, const CellAttractor& b) {
    return a.share != b.share ? a.share > b.share : label_of(a) < label_of(b);
}

bool is_like(const CellAttractor& a, const CellAttractor& b) {
    return label_of(a) == label_of(b);
}

// The attractors with one label of all cells around; nothing if a cell has none or two, or another number in
// all.
class SameLabel {
  public:
    static std::optional<SameLabel> find(const Surroundings& around, const CellAttractor& like,
                                         std::size_t of_each) {
        SameLabel found;
        for (std::size_t i = 0; i < around.rows().size; ++i) {
            for (std::size_t j = 0; j < around.columns().size; ++j) {
                const auto& here = around.attractors_at(i, j);
                const auto is_one = [&](const CellAttractor& each) { return is_like(each, like); };
                const bool complete =
                    here.size() == of_each && around.at(i, j).attractors == static_cast<std::int32_t>(of_each);
                if (!complete || std::ranges::count_if(here, is_one) != 1) return std::nullopt;
                found.attractors_[i][j] = &*std::ranges::find_if(here, is_one);
            }
        }
        return found;
    }
    template <class Number>
    [[nodiscard]] std::optional<double> interpolated(const Surroundings& around, const Number& number,
                                                     double rough = 0) const {
        const auto value_at = [&](auto i, auto j) { return number(*attractors_[i][j]); };
        return refine::interpolated(around, values_around(around, value_at), rough);
    }

  private:
    std::array<std::array<const CellAttractor*, 4>, 4> attractors_{};
};

std::optional<CellAttractor> filled_one(const Surroundings& around, const CellAttractor& like,
                                        std::size_t of_each, std::int64_t starts) {
    const auto same = SameLabel::find(around, like, of_each);
    if (!same) return std::nullopt;
    CellAttractor attractor;
    for (const cell::AttractorQuantity& quantity : cell::attractor_quantities) {
        if (quantity.filled == cell::Filled::as_around) quantity.store(attractor, quantity.load(like));
    }
    const double step = steps_between_neighbours / static_cast<double>(starts);
    const auto share = same->interpolated(around, std::mem_fn(&CellAttractor::share), step);
    if (!share || *share < 0) return std::nullopt;
    attractor.share = *share;
    if (!regime::has_period(like.regime)) return attractor;  // no smooth numbers
    for (const cell::AttractorQuantity& quantity : cell::attractor_quantities) {
        if (quantity.filled != cell::Filled::interpolated) continue;
        const auto value =
            same->interpolated(around, [&](const CellAttractor& each) { return quantity.load(each); });
        if (!value) return std::nullopt;
        quantity.store(attractor, *value);
    }
    return attractor;
}

}  // namespace

std::optional<std::vector<CellAttractor>> filled_attractors(const Surroundings& around, std::int64_t starts) {
    const std::vector<CellAttractor>& next =
        around.attractors_at(around.rows().before, around.columns().before);
    std::vector<CellAttractor> filled;
    for (const CellAttractor& like : next) {
        const auto attractor = filled_one(around, like, next.size(), starts);
        if (!attractor) return std::nullopt;
        filled.push_back(*attractor);
    }
    std::ranges::sort(filled, goes_before);
    return filled;
}

}  // namespace peterka::refine
