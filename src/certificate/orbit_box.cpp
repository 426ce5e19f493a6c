#include "certificate/orbit_box.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "certificate/find_chain.hpp"

namespace peterka::certificate {
namespace {

using Legs = std::vector<LegEquations<Interval>>;

Legs legs_of(const Springs<Interval>& springs, const EventChain& chain,
             const std::vector<Place<Interval>>& places) {
    Legs legs;
    legs.reserve(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        legs.push_back(leg_equations(springs, chain, places, i));
    }
    return legs;
}

std::vector<Place<Interval>> box_around(const EventChain& chain, const std::vector<double>& radii) {
    std::vector<Place<Interval>> box;
    for (std::size_t i = 0; i < chain.events.size(); ++i) {
        box.push_back(
            {around(chain.events[i].time, radii[2 * i]), around(chain.events[i].along, radii[2 * i + 1])});
    }
    return box;
}

constexpr double rounding = 1 + 1e-10;

// The four nonzero numbers of a column of A: in the rows of the event's own leg and of the previous one.
class Column {
  public:
    Column(const Vector<Interval>& begins, const Vector<Interval>& ends) {
        const std::array<Interval, 4> entries{begins.position, begins.velocity, ends.position, ends.velocity};
        for (std::size_t i = 0; i < entries.size(); ++i) {
            middles_[i] = entries[i].middle();
            radii_[i] = entries[i].radius() + 1e-15 * std::abs(middles_[i]);  // and 8 roundings of a product
        }
    }
    // A bound of |identity - factors * column|.
    [[nodiscard]] double from_identity(const std::array<double, 4>& factors, double identity) const {
        double difference = identity;
        double radius = 1e-15 * identity;
        for (std::size_t i = 0; i < factors.size(); ++i) {
            difference -= factors[i] * middles_[i];
            radius += std::abs(factors[i]) * radii_[i];
        }
        return std::abs(difference) + radius;
    }

  private:
    std::array<double, 4> middles_{};
    std::array<double, 4> radii_{};
};

class Krawczyk {
  public:
    Krawczyk(const Springs<Interval>& springs, const Springs<double>& middle, const EventChain& chain)
        : springs_(springs),
          chain_(chain),
          inverse_(equations_in_doubles(middle, chain).derivatives.inverse()) {
        const std::vector<Place<Interval>> point = box_around(chain, std::vector<double>(size(), 0.0));
        std::vector<Vector<Interval>> residuals;
        for (std::size_t i = 0; i < point.size(); ++i) {
            residuals.push_back(leg_residual(springs, chain, point, i));
        }
        for (std::size_t row = 0; row < size(); ++row) {
            Interval sum;
            for (std::size_t i = 0; i < point.size(); ++i) {
                sum += at(row, 2 * i) * residuals[i].position + at(row, 2 * i + 1) * residuals[i].velocity;
            }
            correction_.push_back(sum.size());
        }
    }

    [[nodiscard]] std::size_t size() const { return 2 * chain_.events.size(); }
    // The value of C G(m).
    [[nodiscard]] const std::vector<double>& correction() const { return correction_; }

    // The largest distance from m of the operator's image of the box m -+ radii. For the many entries of I - C
    // A only bounds in doubles are needed: each is rounded at most a dozen times, which `rounding` covers.
    [[nodiscard]] std::vector<double> image(const std::vector<double>& radii) const {
        const Legs legs = legs_of(springs_, chain_, box_around(chain_, radii));
        std::vector<Column> columns;
        for (std::size_t i = 0; i < legs.size(); ++i) {
            const LegEquations<Interval>& before = legs[(i + legs.size() - 1) % legs.size()];
            columns.emplace_back(legs[i].of_time, before.of_end_time);
            columns.emplace_back(legs[i].of_along, before.of_end_along);
        }
        std::vector<double> reach;
        for (std::size_t row = 0; row < size(); ++row) {
            const auto r = static_cast<Eigen::Index>(row);
            double sum = correction_[row] + 1e-290;  // exceeds any underflow
            for (std::size_t column = 0; column < size(); ++column) {
                const std::size_t leg = column / 2;
                const std::size_t leg_before = (leg + legs.size() - 1) % legs.size();
                const auto first = static_cast<Eigen::Index>(2 * leg);
                const auto second = static_cast<Eigen::Index>(2 * leg_before);
                const std::array<double, 4> factors{inverse_(r, first), inverse_(r, first + 1),
                                                    inverse_(r, second), inverse_(r, second + 1)};
                sum += columns[column].from_identity(factors, row == column ? 1 : 0) * radii[column];
            }
            reach.push_back(sum * rounding);
        }
        return reach;
    }

  private:
    [[nodiscard]] Interval at(std::size_t row, std::size_t column) const {
        return inverse_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }

    const Springs<Interval>& springs_;
    const EventChain& chain_;
    Eigen::MatrixXd inverse_;
    std::vector<double> correction_;
};

bool inside(const std::vector<double>& image, const std::vector<double>& radii) {
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (!(image[i] < radii[i])) return false;
    }
    return true;
}

}  // namespace

std::optional<std::vector<Place<Interval>>> orbit_box(const Springs<Interval>& springs,
                                                      const Springs<double>& middle, const EventChain& chain) {
    const Krawczyk krawczyk(springs, middle, chain);
    std::vector<double> radii = krawczyk.correction();
    for (double& radius : radii) radius = 1.5 * radius + 1e-280;
    constexpr double widest =
        0.1;  // of a box that may hold a single orbit; a leg from a wide one costs seconds
    for (int tries = 0; tries < 6 && std::ranges::max(radii) < widest; ++tries) {
        const std::vector<double> image = krawczyk.image(radii);
        if (inside(image, radii)) return box_around(chain, image);
        for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = 1.5 * std::max(image[i], radii[i]);
    }
    return std::nullopt;
}

}  // namespace peterka::certificate
