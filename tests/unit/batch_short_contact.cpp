// Impacts that are short compared with the forcing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "batch/short_contact-inl.hpp"
#include "batch_one_cell.hpp"
#include "rig.hpp"

namespace peterka::testing {
namespace {

// The mean over the contact of eta^2 sin(theta) less the springs' pull; what is neglected is quadratic in the
// contact's share of a cycle.
TEST(BatchShortContact, ItsMeanPullIsThatHalfWay) {
    const auto oscillator = paper_rig(beam_170mm, 3, 0.7);
    const OneCell cell(oscillator, 16);
    const double turn = oscillator.frequency * cell.rig.exit_time;
    for (const double phase : {0.0, 0.8, 2.5}) {
        const double mean =
            oscillator.drive() * (std::cos(phase) - std::cos(phase + turn)) / turn - oscillator.gap;
        const double told =
            one_of(lanes::mean_pull(cell.rig, cell, moments({0, 1}, phase), lanes::all(oscillator.gap)));
        EXPECT_NEAR(told, mean, oscillator.drive() * turn * turn / 4) << phase;
    }
}

// What a contact needs of its cell besides.
struct CellInContact : OneCell {
    explicit CellInContact(const scene::Oscillator<double>& oscillator)
        : OneCell(oscillator, 16), response(oscillator.drive() / impedance(oscillator)) {
        re_in_lanes.fill(response.real());
        im_in_lanes.fill(response.imag());
        arrays.arrays[batch::index_of(batch::Field::contact_re)] = re_in_lanes.data();
        arrays.arrays[batch::index_of(batch::Field::contact_im)] = im_in_lanes.data();
    }
    static std::complex<double> impedance(const scene::Oscillator<double>& oscillator) {
        const auto& stop = oscillator.kelvin_voigt();
        return {1 + stop.stiffness - oscillator.drive(),
                (2 * oscillator.damping_ratio + stop.damping) * oscillator.frequency};
    }

    std::complex<double> response;
    std::array<double, batch::widest_vector> re_in_lanes{};
    std::array<double, batch::widest_vector> im_in_lanes{};
    batch::Lanes arrays;
    lanes::Index index = lanes::index_from(0);
    lanes::V contact_static_position = -gap / lanes::all(rig.contact_square);
    lanes::V contact_square = lanes::all(rig.contact_square);
    lanes::V contact_rate = lanes::all(rig.contact_rate);
    lanes::V inverse_contact_rate = lanes::all(1 / rig.contact_rate);
};

// The springs pull the hammer out of the stop nearly as hard as a short contact allows: from its guess,
// Newton's method needs six rounds more.
TEST(BatchShortContact, EndsWhereItsForceVanishesEvenUnderTheLargestPull) {
    const scene::Oscillator<double> oscillator{
        .contact = scene::KelvinVoigt<double>{30, 1.3 * std::sqrt(30)}, .frequency = 0.5, .gap = 3};
    constexpr double phase = 0.5;
    constexpr double speed = 2.348;
    const CellInContact cell(oscillator);
    const double pull = (oscillator.drive() * std::sin(phase) - oscillator.gap) / speed;
    ASSERT_GT(pull, cell.rig.least_pull);
    ASSERT_LT(pull, cell.rig.least_pull / 2);

    // delta = Im(response exp(i theta)) - gap/w2 + exp(-b t) (x cos(rate t) + (v + b x)/rate sin(rate t))
    const double b = cell.rig.contact_decay;
    const double rate = cell.rig.contact_rate;
    const auto steady = [&](double t) {
        const std::complex<double> swing = cell.response * std::polar(1.0, phase + oscillator.frequency * t);
        return scene::State<double>(swing.imag() - oscillator.gap / cell.rig.contact_square,
                                    oscillator.frequency * swing.real());
    };
    const scene::State<double> free = scene::State<double>(0, speed) - steady(0);
    const auto force = [&](double t) {
        const double x = free[0] * std::cos(rate * t) + (free[1] + b * free[0]) / rate * std::sin(rate * t);
        const double v = free[1] * std::cos(rate * t) -
                         (b * free[1] + cell.rig.contact_square * free[0]) / rate * std::sin(rate * t);
        const scene::State<double> at = steady(t) + std::exp(-b * t) * scene::State<double>(x, v);
        return cell.rig.stiffness * at[0] + cell.rig.damping * at[1];
    };
    double pressing = 0;
    while (force(pressing) > 0) pressing += 1e-4;
    double over = pressing;
    pressing -= 1e-4;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = (pressing + over) / 2;
        (force(middle) > 0 ? pressing : over) = middle;
    }

    const lanes::Moments touch = moments({0, speed}, phase);
    const lanes::ContactOf<false, CellInContact> contact(cell.arrays, cell, touch);
    const double guess = std::clamp(pull / cell.rig.pull_scale, -1.0, 1.0);
    const lanes::Release end = lanes::short_release(cell.rig, contact, lanes::all(guess), lanes::every());
    EXPECT_TRUE(lanes::everywhere(end.sure));
    EXPECT_NEAR(one_of(end.time), over, 1e-13);
}

}  // namespace
}  // namespace peterka::testing
