// Growth of small perturbations along a trajectory, from the Jacobians of its cycles.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace peterka::regime {

// Growth of errors that enter anew with every cycle, as rounding errors do: their covariance, with an isotropic
// error of unit size added at the start and after each cycle. The growth from the start alone would miss errors
// that enter after a contact that erases all memory of the start.
class ErrorGrowth {
  public:
    void advance(const Eigen::Matrix2d& jacobian) {
        const double a = jacobian(0, 0) * xx_ + jacobian(0, 1) * xv_;
        const double b = jacobian(0, 0) * xv_ + jacobian(0, 1) * vv_;
        const double c = jacobian(1, 0) * xx_ + jacobian(1, 1) * xv_;
        const double d = jacobian(1, 0) * xv_ + jacobian(1, 1) * vv_;
        xx_ = a * jacobian(0, 0) + b * jacobian(0, 1) + new_;
        xv_ = a * jacobian(1, 0) + b * jacobian(1, 1);
        vv_ = c * jacobian(1, 0) + d * jacobian(1, 1) + new_;
        const double square = xx_ + vv_;
        largest_square_ = std::max(largest_square_, square);
        if (square > 1e60 || square < 1e-60) rescale(square);
    }

    // ln of the largest size of the errors, relative to that of a new one.
    [[nodiscard]] double largest() const {
        return std::max(log_largest_, log_scale_ + std::log(largest_square_) / 2);
    }

  private:
    // Keeps the covariance within the range of doubles; its scale never falls below the error of one cycle.
    void rescale(double square) {
        log_largest_ = largest();
        const double log_size = std::max(log_scale_ + std::log(square) / 2, 0.0);
        const double factor = std::exp(2 * (log_scale_ - log_size));
        xx_ *= factor;
        xv_ *= factor;
        vv_ *= factor;
        log_scale_ = log_size;
        new_ = std::exp(-2 * log_size) / 2;
        largest_square_ = xx_ + vv_;
    }

    // The covariance over exp(2 log_scale_), and what each cycle adds.
    double xx_ = 0.5;
    double xv_ = 0;
    double vv_ = 0.5;
    double new_ = 0.5;
    double log_scale_ = 0;
    double largest_square_ = 1;  // of the errors' size since log_scale_ changed
    double log_largest_ = 0;     // before that
};

// Largest Lyapunov exponent per forcing cycle (cf. Benettin et al. 1980), with a standard error from blocks of
// cycles, and ln G.
class Growth {
  public:
    static constexpr int settling_cycles = 100;  // left out of the exponent: the transient's own growth
    static constexpr int block_cycles = 25;      // long enough that blocks scatter independently
    static constexpr double least_growth =
        20;  // ln of the growth that separates chaos from a transient that merely drifts

    Growth() = default;

    // Advances by one cycle, whose Jacobian is given in scaled coordinates.
    void advance(const Eigen::Matrix2d& jacobian) {
        errors_.advance(jacobian);
        product_ = (jacobian * product_).eval();
        const double square = product_.squaredNorm();
        if (square == 0) {  // every direction vanished, as on a rigid stop: the start is forgotten
            *this = Growth(errors_, resets_ + 1);
            return;
        }
        if (!(square > 0)) return;
        ++cycles_;
        shrink(std::abs(jacobian.determinant()));
        if (cycles_ == settling_cycles) block_start_ = log_settled_ = log_size();
        if (cycles_ > settling_cycles && (cycles_ - settling_cycles) % block_cycles == 0) close_block();
        if (square > 1e60 || square < 1e-60) normalise();
    }

    // ln G, see ErrorGrowth. Above about 20 a label depends on rounding.
    [[nodiscard]] double sensitivity() const { return errors_.largest(); }
    [[nodiscard]] double exponent() const { return mean_; }  // per forcing cycle
    // Mean of -ln |det J| per cycle: the rate at which areas in the plane of states contract. The duration of
    // transients scales with its inverse.
    [[nodiscard]] double dissipation() const {
        return cycles_ == 0 ? 0 : -(log_area_ + std::log(area_)) / static_cast<double>(cycles_);
    }
    // How often every direction vanished: from the second time on the motion repeats what followed the first.
    [[nodiscard]] int resets() const { return resets_; }
    // Positive by more than three standard errors, and a perturbation really grew: the blocks of a slow drift
    // scatter little.
    [[nodiscard]] bool surely_positive() const {
        return blocks_ > 1 && block_start_ - log_settled_ > least_growth &&
               mean_ > 3 * std::sqrt(squares_ / (blocks_ - 1.0) / blocks_);
    }

  private:
    Growth(const ErrorGrowth& errors, int resets) : errors_(errors), resets_(resets) {}

    [[nodiscard]] double log_size() const { return log_scale_ + std::log(product_.squaredNorm()) / 2; }

    void shrink(double determinant) {
        area_ *= determinant;
        if (area_ < 1e-100 || area_ > 1e100) {
            log_area_ += std::log(area_);  // minus infinity where a contact kills a direction
            area_ = 1;
        }
    }

    // Keeps the product within the range of doubles.
    void normalise() {
        const double size = product_.norm();
        log_scale_ += std::log(size);
        product_ /= size;
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
    ErrorGrowth errors_;
    double area_ = 1;  // of the image of a unit area at the start, times exp(log_area_)
    double log_area_ = 0;
    double block_start_ = 0;  // ln of the growth when the present block began
    double log_settled_ = 0;  // ln of the growth while settling
    double mean_ = 0;         // of the blocks' rates
    double squares_ = 0;      // sum of their squared deviations
    long cycles_ = 0;
    int blocks_ = 0;
    int resets_ = 0;
};

}  // namespace peterka::regime
