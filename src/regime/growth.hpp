// Growth of a small perturbation along a trajectory, from the Jacobians of its cycles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace peterka::regime {

// Largest Lyapunov exponent per forcing cycle, with a standard error from blocks of cycles, and ln G.
class Growth {
  public:
    static constexpr int settling_cycles = 100;  // left out of the exponent: the transient's own growth
    static constexpr int block_cycles = 25;      // long enough that blocks scatter independently
    static constexpr double least_growth =
        20;  // ln of what separates chaos from a transient that merely drifts

    Growth() = default;

    // Advances by one cycle, whose Jacobian is given in scaled coordinates.
    void advance(const Eigen::Matrix2d& jacobian) {
        product_ = jacobian * product_;
        const double size = product_.norm();
        if (size == 0) {  // every direction died, as on a rigid stop: what comes knows nothing of the start
            *this = Growth(log_largest_, resets_ + 1);
            return;
        }
        if (!(size > 0)) return;
        product_ /= size;
        log_size_ += std::log(size);
        log_largest_ = std::max(log_largest_, log_size_);
        ++cycles_;
        if (cycles_ == settling_cycles) block_start_ = log_settled_ = log_size_;
        if (cycles_ > settling_cycles && (cycles_ - settling_cycles) % block_cycles == 0) close_block();
    }

    // ln G: the largest growth of a start perturbation so far. Above about 20 a label hangs on rounding.
    [[nodiscard]] double sensitivity() const { return log_largest_; }
    [[nodiscard]] double exponent() const { return mean_; }  // per forcing cycle
    // How often every direction died: from the second time on the motion repeats what followed the first.
    [[nodiscard]] int resets() const { return resets_; }
    [[nodiscard]] bool block_just_closed() const {
        return blocks_ > 1 && (cycles_ - settling_cycles) % block_cycles == 0;
    }
    // Positive by more than three standard errors, and a perturbation really grew: blocks of a slow drift
    // scatter little.
    [[nodiscard]] bool surely_positive() const {
        return blocks_ > 1 && log_size_ - log_settled_ > least_growth &&
               mean_ > 3 * std::sqrt(squares_ / (blocks_ - 1.0) / blocks_);
    }

  private:
    Growth(double log_largest, int resets) : log_largest_(log_largest), resets_(resets) {}

    void close_block() {
        const double rate = (log_size_ - block_start_) / block_cycles;
        block_start_ = log_size_;
        ++blocks_;
        const double deviation = rate - mean_;
        mean_ += deviation / blocks_;
        squares_ += deviation * (rate - mean_);
    }

    Eigen::Matrix2d product_ = Eigen::Matrix2d::Identity() / std::sqrt(2.0);
    double log_size_ = 0;
    double log_largest_ = 0;
    double block_start_ = 0;
    double log_settled_ = 0;  // ln of the growth while settling
    double mean_ = 0;         // of the blocks' rates
    double squares_ = 0;      // sum of their squared deviations
    long cycles_ = 0;
    int blocks_ = 0;
    int resets_ = 0;
};

}  // namespace peterka::regime
