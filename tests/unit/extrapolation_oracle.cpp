#include "extrapolation_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <variant>

namespace peterka::testing {

using Real = ExtrapolationOracle::Real;

ExtrapolationOracle::ExtrapolationOracle(const scene::Oscillator<double>& oscillator,
                                         const scene::State<double>& start)
    : oscillator_(oscillator), y_{start[0], start[1]} {
    if (start[0] > 0) phase_ = hold(y_) > 0 ? Phase::contact : Phase::unloaded;
    if (start[0] == 0 && start[1] > 0) phase_ = Phase::contact;
}

Real ExtrapolationOracle::force(const Unknowns& y) const {
    if (const auto* law = std::get_if<scene::KelvinVoigt<double>>(&oscillator_.contact)) {
        return law->stiffness * y[0] + law->damping * y[1];
    }
    const auto& law = std::get<scene::HuntCrossley<double>>(oscillator_.contact);
    const Real spring = law.stiffness * std::pow(std::abs(y[0]), Real(law.exponent));
    return (y[0] < 0 ? -spring : spring) * (1 + law.dissipation * y[1]);
}

Real ExtrapolationOracle::hold(const Unknowns& y) const {
    if (const auto* law = std::get_if<scene::HuntCrossley<double>>(&oscillator_.contact)) {
        return 1 + law->dissipation * y[1];
    }
    return force(y);
}

ExtrapolationOracle::Unknowns ExtrapolationOracle::slope(Real time, const Unknowns& y) const {
    const Real cart = std::sin(Real(oscillator_.frequency) * time);
    const Real u = y[0] + oscillator_.gap;
    const bool absolute = oscillator_.cubic_form == job::CubicForm::absolute;
    const Real cubic =
        oscillator_.cubic * (absolute ? (u + cart) * (u + cart) * (u + cart) - cart * cart * cart : u * u * u);
    const Real f = phase_ == Phase::contact ? force(y) : Real(0);
    const Real drive = Real(oscillator_.frequency) * oscillator_.frequency * cart;
    const Real damper = 2 * Real(oscillator_.damping_ratio) * y[1];
    return {y[1], drive - damper - u - cubic - f, f, f * y[1], drive * y[1], damper * y[1]};
}

ExtrapolationOracle::Trial ExtrapolationOracle::trial(Real step) const {
    constexpr int columns = 7;
    std::array<Unknowns, columns> table{};
    const Unknowns first = slope(time_, y_);
    for (int k = 0; k < columns; ++k) {
        const int pieces = 2 * (k + 1);
        const Real h = step / pieces;
        Unknowns before = y_;
        Unknowns now = y_;
        for (std::size_t i = 0; i < now.size(); ++i) now[i] += h * first[i];
        for (int n = 1; n < pieces; ++n) {
            const Unknowns s = slope(time_ + n * h, now);
            for (std::size_t i = 0; i < now.size(); ++i) {
                const Real next = before[i] + 2 * h * s[i];
                before[i] = now[i];
                now[i] = next;
            }
        }
        // Aitken-Neville extrapolation in h^2; the table keeps the last row
        for (int j = 1; j <= k; ++j) {
            const Real ratio = Real(pieces) / Real(2 * (k - j + 1));
            Unknowns& coarser = table[static_cast<std::size_t>(j) - 1];
            for (std::size_t i = 0; i < now.size(); ++i) {
                const Real finer = now[i] + (now[i] - coarser[i]) / (ratio * ratio - 1);
                coarser[i] = now[i];
                now[i] = finer;
            }
        }
        table[static_cast<std::size_t>(k)] = now;
    }
    const Unknowns& best = table[columns - 1];
    const Unknowns& next_best = table[columns - 2];
    constexpr Real asked = 1e-16L;
    const Real velocity = std::abs(y_[1]) + std::abs(step * first[1]);
    const Real position = std::abs(y_[0]) + step * velocity;
    return {best,
            std::max(std::abs(best[0] - next_best[0]) / position, std::abs(best[1] - next_best[1]) / velocity) /
                asked};
}

Real ExtrapolationOracle::over(const Unknowns& y) const {
    const bool spring_dashpot = std::holds_alternative<scene::KelvinVoigt<double>>(oscillator_.contact);
    if (phase_ == Phase::flight) return y[0];
    if (phase_ == Phase::contact) return spring_dashpot ? -hold(y) : std::max(-hold(y), -y[0]);
    return std::max(-y[0], hold(y));
}

void ExtrapolationOracle::advance(int cycles) {
    impacts_ = 0;
    peak_force_ = impact_speed_ = reach_ = impulse_ = total_impulse_ = contact_time_ = 0;
    y_[3] = y_[4] = y_[5] = 0;
    const Real period = 2 * std::numbers::pi_v<Real> / oscillator_.frequency;
    const Real longest = 0.05L / std::max(1.0, oscillator_.frequency);
    for (int n = 0; n < cycles; ++n) {
        time_ = 0;
        Real length = longest;
        for (int budget = 3'000'000; time_ < period; --budget) {
            if (budget == 0) throw std::runtime_error("the oracle's steps vanish");
            const Real left = period - time_;
            Real step = std::min({length, longest, left});
            Trial next = trial(step);
            if (!(next.error <= 1)) {
                length = step * std::max(Real(0.1), Real(0.8) * std::pow(next.error, Real(-1) / 13));
                continue;
            }
            length = step * std::min(Real(3), Real(0.8) * std::pow(next.error + 1e-10L, Real(-1) / 13));
            const bool event = over(next.y) > 0;
            if (event) {
                Real before = 0;
                for (int halving = 0; halving < 70; ++halving) {
                    const Real middle = (before + step) / 2;
                    (over(trial(middle).y) > 0 ? step : before) = middle;
                }
                next = trial(step);
            }
            look_for_extrema(step);
            if (phase_ == Phase::contact) open_time_ += step;
            y_ = next.y;
            time_ = !event && step == left ? period : time_ + step;
            if (event) finish_phase();
        }
    }
    close_impact();
}

// If force or |u| stop growing within the next step, each has one maximum there.
void ExtrapolationOracle::look_for_extrema(Real step) {
    const auto climb = [&](auto&& value) {
        Real from = 0;
        Real to = step;
        const Real inner = step / 1024;
        if (value(trial(inner).y) < value(y_) || value(trial(step - inner).y) < value(trial(step).y)) {
            return std::max(value(y_), value(trial(step).y));
        }
        for (int n = 0; n < 70; ++n) {
            const Real third = (to - from) / 3;
            const bool later = value(trial(from + third).y) < value(trial(to - third).y);
            (later ? from : to) = later ? from + third : to - third;
        }
        return value(trial(from).y);
    };
    if (phase_ == Phase::contact) {
        peak_force_ = std::max(peak_force_, climb([&](const Unknowns& y) { return force(y); }));
    }
    for (const int sign : {1, -1}) {
        const auto outward = [&](const Unknowns& y) { return sign * (y[0] + Real(oscillator_.gap)); };
        if (outward(y_) + std::abs(y_[1] * step) * 2 > reach_) reach_ = std::max(reach_, climb(outward));
    }
}

void ExtrapolationOracle::close_impact() {
    impulse_ = std::max(impulse_, y_[2]);
    total_impulse_ += y_[2];
    contact_time_ = std::max(contact_time_, open_time_);
    y_[2] = open_time_ = 0;
}

void ExtrapolationOracle::finish_phase() {
    if (phase_ == Phase::flight) {
        y_[0] = 0;
        ++impacts_;
        impact_speed_ = std::max(impact_speed_, y_[1]);
        phase_ = Phase::contact;
        return;
    }
    const Real depth = std::abs(y_[1]) * 1e-15L;
    const bool leaves = phase_ == Phase::unloaded ? !(hold(y_) > 0) : std::abs(y_[0]) <= depth;
    if (leaves) {
        y_[0] = 0;
        close_impact();
        phase_ = Phase::flight;
        return;
    }
    phase_ = phase_ == Phase::contact ? Phase::unloaded : Phase::contact;
}

}  // namespace peterka::testing
