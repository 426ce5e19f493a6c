// Growth of small perturbations along a trajectory, from the Jacobians of its cycles.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace peterka::regime {

// What becomes of errors that come in anew with every cycle, as rounding does: their covariance, with one of
// unit size and no direction at the start and after each cycle. The growth from the start alone would miss what
// comes in after a contact that kills all memory of it.
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

    // ln of the largest size that errors had, over that of one when it comes in.
    [[nodiscard]] double largest() const {
        return std::max(log_largest_, log_scale_ + std::log(largest_square_) / 2);
    }

  private:
    // Keeps the covariance within the range of numbers; never below the errors of one cycle.
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
    double log_largest_ = 0;     // until then
};

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
        errors_.advance(jacobian);
        product_ = (jacobian * product_).eval();
        const double square = product_.squaredNorm();
        if (square == 0) {  // every direction died, as on a rigid stop: what comes knows nothing of the start
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
    // Mean of -ln |det J| per cycle: how fast whatever lies together in the plane of states is drawn together.
    // The time that transients take goes with its inverse.
    [[nodiscard]] double dissipation() const {
        return cycles_ == 0 ? 0 : -(log_area_ + std::log(area_)) / static_cast<double>(cycles_);
    }
    // How often every direction died: from the second time on the motion repeats what followed the first.
    [[nodiscard]] int resets() const { return resets_; }
    // Positive by more than three standard errors, and a perturbation really grew: blocks of a slow drift
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

    // Keeps the product within the range of numbers.
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
    double area_ = 1;  // of what had the area 1 at the start, times exp(log_area_)
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
