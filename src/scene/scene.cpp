#include "scene/scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>
#include <variant>

#include "job/axis_key.hpp"
#include "job/cell_numbers.hpp"
#include "support/expect.hpp"

namespace peterka::scene {
namespace {

// A law consists of its numbers alone.
template <class Law>
auto numbers_of(const Law& law) {
    static_assert(sizeof(Law) % sizeof(double) == 0);
    return std::bit_cast<std::array<double, sizeof(Law) / sizeof(double)>>(law);
}

bool same_numbers(const ContactLaw<double>& a, const ContactLaw<double>& b) {
    const auto same = []<class One, class Other>(const One& one, const Other& other) {
        if constexpr (std::is_same_v<One, Other>) return numbers_of(one) == numbers_of(other);
        return false;
    };
    return std::visit(same, a, b);
}

bool any_differs(const job::Job& job) {
    const auto corners = job::numbers_at_corners(job);
    const Oscillator<double> first = oscillator_of(corners.front());
    return !std::ranges::all_of(
        corners, [&](const job::CellNumbers& other) { return same_rig(first, oscillator_of(other)); });
}

}  // namespace

bool same_rig(const Oscillator<double>& a, const Oscillator<double>& b) {
    return a.damping_ratio == b.damping_ratio && a.cubic == b.cubic && a.cubic_form == b.cubic_form &&
           same_numbers(a.contact, b.contact);
}

Scene::Scene(const job::Job& job)
    : job_(job),
      scales_(scales_of(job)),
      oscillator_(oscillator_of(job)),
      varies_(has_axis(job, job::is_of_rig)),
      rigs_differ_(varies_ && any_differs(job)) {}

// At forcing phase 0 the cart passes its mid-position at full speed: y = 0 and y' = A0 Omega.
Cell Scene::cell(std::int64_t row, std::int64_t column) const {
    const bool is_alone = job_.kind == job::Kind::trace;
    PETERKA_EXPECT(is_alone || (0 <= row && row < rows() && 0 <= column && column < columns()));
    const job::CellNumbers numbers = is_alone ? numbers_in(job_) : numbers_at(job_, row, column);
    Cell cell = varies_ ? Cell{oscillator_of(numbers), {}, scales_of(numbers)} : Cell{oscillator_, {}, scales_};
    const double frequency = numbers.frequency_ratio();
    const double gap = numbers.gap_ratio();
    cell.oscillator.frequency = frequency;
    cell.oscillator.gap = gap;
    cell.start = {numbers.displacement_ratio() - gap, numbers.velocity_ratio() - frequency};
    return cell;
}

}  // namespace peterka::scene
