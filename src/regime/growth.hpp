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
        product_ = (jacobian * product_).eval();
        const double square = product_.squaredNorm();
        if (square == 0) {  // every direction died, as on a rigid stop: what comes knows nothing of the start
            *this = Growth(sensitivity(), resets_ + 1);
            return;
        }
        if (!(square > 0)) return;
        largest_square_ = std::max(largest_square_, square);
        ++cycles_;
        if (cycles_ == settling_cycles) block_start_ = log_settled_ = log_size();
        if (cycles_ > settling_cycles && (cycles_ - settling_cycles) % block_cycles == 0) close_block();
        if (square > 1e60 || square < 1e-60) normalise();
    }

    // ln G: the largest growth of a start perturbation so far. Above about 20 a label hangs on rounding.
    [[nodiscard]] double sensitivity() const {
        return std::max(log_largest_, log_scale_ + std::log(largest_square_) / 2);
    }
    [[nodiscard]] double exponent() const { return mean_; }  // per forcing cycle
    // How often every direction died: from the second time on the motion repeats what followed the first.
    [[nodiscard]] int resets() const { return resets_; }
    // Positive by more than three standard errors, and a perturbation really grew: blocks of a slow drift
    // scatter little.
    [[nodiscard]] bool surely_positive() const {
        return blocks_ > 1 && block_start_ - log_settled_ > least_growth &&
               mean_ > 3 * std::sqrt(squares_ / (blocks_ - 1.0) / blocks_);
    }

  private:
    Growth(double log_largest, int resets) : log_largest_(log_largest), resets_(resets) {}

    [[nodiscard]] double log_size() const { return log_scale_ + std::log(product_.squaredNorm()) / 2; }

    // Keeps the product within the range of numbers.
    void normalise() {
        log_largest_ = sensitivity();
        const double size = product_.norm();
        log_scale_ += std::log(size);
        product_ /= size;
        largest_square_ = 1;
    }

    void close_block() {
        const double size = log_size();
        const double rate = (size - block_start_) / block_cycles;
        block_start_ = size;
        ++blocks_;
        const double deviation = rate - mean_;
        mean_ += deviation / blocks_;
        squares_ += deviation * (rate - mean_);
    }

    Eigen::Matrix2d product_ = Eigen::Matrix2d::Identity() / std::sqrt(2.0);  // times exp(log_scale_)
    double log_scale_ = 0;
    double largest_square_ = 1;  // of the product's norm since log_scale_ changed
    double log_largest_ = 0;     // until then
    double block_start_ = 0;     // ln of the growth when the present block began
    double log_settled_ = 0;     // ln of the growth while settling
    double mean_ = 0;            // of the blocks' rates
    double squares_ = 0;         // sum of their squared deviations
    long cycles_ = 0;
    int blocks_ = 0;
    int resets_ = 0;
};

}  // namespace peterka::regime
