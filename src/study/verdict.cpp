#include "study/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace peterka::study {

namespace {

using scene::State;

constexpr std::size_t longest_period = 64;
constexpr Extended recurred = 1e-15L;
constexpr std::int64_t flight_window = 1000;  // cycles
constexpr Extended apart = 1e-7L;             // least distance between points of one orbit

Extended distance(const State<Extended>& a, const State<Extended>& b) {
    const State<Extended> size = a.cwiseAbs().array() + 1;
    return (a - b).cwiseQuotient(size).cwiseAbs().maxCoeff();
}

class Motion {
  public:
    Motion(const scene::Oscillator<double>& oscillator, const State<double>& start)
        : reference_(oscillator), x_(start.cast<Extended>()) {}

    // False if the reference can't continue.
    bool advance() {
        const ReferenceCycle cycle = reference_(x_);
        if (cycle.outcome != ReferenceCycle::Outcome::done) return false;
        x_ = cycle.end;
        note_flight(cycle);
        cycles_.push_back(cycle);
        if (cycles_.size() > 4 * longest_period)
            cycles_.erase(cycles_.begin(), cycles_.begin() + 2 * longest_period);
        return true;
    }

    // The smallest lag at which all states of the last q cycles recurred.
    [[nodiscard]] std::optional<std::size_t> period() const {
        for (std::size_t q = 1; q <= longest_period && 2 * q < cycles_.size(); ++q) {
            if (!recurs(q)) continue;
            for (std::size_t divisor = 1; divisor < q; ++divisor) {
                if (q % divisor == 0 && lag(divisor, 0) < apart) return std::nullopt;
            }
            return q;
        }
        return std::nullopt;
    }

    [[nodiscard]] Verdict settled(std::size_t period) const {
        Verdict verdict{.kind = Verdict::Kind::settled};
        bool touched = false;
        bool separated = false;
        for (std::size_t n = cycles_.size() - period; n < cycles_.size(); ++n) {
            const ReferenceCycle& cycle = cycles_[n];
            verdict.impacts += cycle.impacts;
            verdict.peak_force = std::max(verdict.peak_force, cycle.peak_force);
            if (std::isnan(cycle.peak_force)) verdict.peak_force = cycle.peak_force;
            touched |= cycle.touched || cycle.impacts > 0;
            separated |= cycle.separated;
        }
        verdict.regime = !touched     ? regime::Regime::no_impact
                         : !separated ? regime::Regime::sustained_contact
                                      : regime::Regime::periodic;
        const bool impacts = verdict.regime == regime::Regime::periodic;
        if (!impacts) verdict.impacts = 0;
        verdict.period = impacts ? static_cast<std::int64_t>(period) : 1;
        return verdict;
    }

    // Mean logarithmic growth per cycle of the distance to a neighbour, rescaled after each cycle (Benettin et
    // al. 1980).
    [[nodiscard]] Extended growth(int cycles) {
        constexpr Extended near = 1e-9L;
        State<Extended> away(near, 0);
        Extended sum = 0;
        for (int n = 0; n < cycles; ++n) {
            const ReferenceCycle other = reference_(x_ + away);
            if (!advance() || other.outcome != ReferenceCycle::Outcome::done) return 0;
            const Extended size = (other.end - x_).norm();
            if (!(size > 0)) return -1;
            sum += std::log(size / near);
            away = (other.end - x_) * (near / size);
        }
        return sum / Extended(cycles);
    }

    // No contact for the last half of the run, in whose last window the motion went no further than in the
    // first.
    [[nodiscard]] bool never_touches_again() const {
        return untouched_ > total_ / 2 && reach_.back() <= Extended(1.001) * reach_.front();
    }

    [[nodiscard]] bool is_closed_form() const { return reference_.is_closed_form(); }

  private:
    [[nodiscard]] Extended lag(std::size_t q, std::size_t back) const {
        const std::size_t last = cycles_.size() - 1 - back;
        return distance(cycles_[last].end, cycles_[last - q].end);
    }
    [[nodiscard]] bool recurs(std::size_t q) const {
        for (std::size_t back = 0; back < q; ++back) {
            if (!(lag(q, back) < recurred)) return false;
        }
        return true;
    }

    void note_flight(const ReferenceCycle& cycle) {
        ++total_;
        if (cycle.touched || cycle.impacts > 0) {
            untouched_ = 0;
            reach_.clear();
            return;
        }
        ++untouched_;
        const auto window = static_cast<std::size_t>(untouched_ / flight_window);
        reach_.resize(window + 1, 0);
        reach_[window] = std::max(reach_[window], x_.cwiseAbs().maxCoeff());
    }

    Reference reference_;
    State<Extended> x_;
    std::vector<ReferenceCycle> cycles_;
    std::int64_t total_ = 0;
    std::int64_t untouched_ = 0;        // cycles since the last contact
    std::vector<Extended> reach_ = {};  // largest state in each window of cycles without contact
};

}  // namespace

Verdict judge(const scene::Oscillator<double>& oscillator, const State<double>& start) {
    constexpr int growth_cycles = 500;
    constexpr Extended least_growth = 0.02L;
    Motion motion(oscillator, start);
    const int budget = motion.is_closed_form() ? 100'000 : 5'000;
    const int look_for_chaos_at = motion.is_closed_form() ? 10'000 : 2'000;
    for (int n = 0; n < budget; ++n) {
        if (!motion.advance()) return {};
        if (const auto period = motion.period()) return motion.settled(*period);
        if (n == look_for_chaos_at && motion.growth(growth_cycles) > least_growth) {
            return {.kind = Verdict::Kind::chaotic};
        }
    }
    if (motion.never_touches_again()) {
        return {.kind = Verdict::Kind::settled, .regime = regime::Regime::no_impact, .period = 1};
    }
    return {};
}

}  // namespace peterka::study
