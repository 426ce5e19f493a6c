// Seeds and curves as plain numbers, to be sent between ranks.
#pragma once

#include <span>
#include <vector>

#include "curves/trace_curve.hpp"
#include "curves/unstable_branch.hpp"

namespace peterka::curves {

using Numbers = std::vector<double>;

// Reads numbers one after the other.
class NumberReader {
  public:
    explicit NumberReader(std::span<const double> numbers) : left_(numbers) {}
    [[nodiscard]] bool done() const { return left_.empty(); }
    double number() {
        const double first = left_.front();
        left_ = left_.subspan(1);
        return first;
    }
    std::int64_t integer() { return static_cast<std::int64_t>(number()); }
    PlanePoint place() {
        const double column = number();
        return {column, number()};
    }

  private:
    std::span<const double> left_;
};

void pack(const OrbitPoint& point, Numbers& to);
[[nodiscard]] OrbitPoint unpack_point(NumberReader& from);
void pack(const Seed& seed, Numbers& to);
[[nodiscard]] Seed unpack_seed(NumberReader& from);
void pack(const Curve& curve, Numbers& to);
[[nodiscard]] Curve unpack_curve(NumberReader& from);
void pack(const UnstableBranch& branch, Numbers& to);
[[nodiscard]] UnstableBranch unpack_branch(NumberReader& from);

}  // namespace peterka::curves
