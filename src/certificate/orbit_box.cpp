#include "certificate/orbit_box.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

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
    // Their product with four numbers.
    [[nodiscard]] Interval times(const std::array<double, 4>& factors) const {
        Interval sum;
        for (std::size_t i = 0; i < factors.size(); ++i) {
            sum += Interval(factors[i]) * around(middles_[i], radii_[i]);
        }
        return sum;
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

// The derivatives by the unknowns, in doubles.
Eigen::MatrixXd derivatives_of(const Springs<double>& middle, const EventChain& chain,
                               const std::optional<Relaxation>& relaxed) {
    Eigen::MatrixXd derivatives = equations_in_doubles(middle, chain).derivatives;
    if (relaxed) {
        const auto unknown = static_cast<Eigen::Index>(relaxed->unknown);
        derivatives.col(unknown).setZero();
        derivatives(static_cast<Eigen::Index>(relaxed->equation), unknown) = 1;
    }
    return derivatives;
}

// For a relaxed chain the unknown that is held is not one of x: mu takes its place.
class Krawczyk {
  public:
    Krawczyk(const Springs<Interval>& springs, const Springs<double>& middle, const EventChain& chain,
             const std::optional<Relaxation>& relaxed = std::nullopt)
        : springs_(springs),
          chain_(chain),
          relaxed_(relaxed),
          inverse_(derivatives_of(middle, chain, relaxed).inverse()) {
        if (relaxed_) unknown_of(chain_, relaxed_->unknown) = relaxed_->held.middle();
        const std::vector<Place<Interval>> point = box_around(chain_, std::vector<double>(size(), 0.0));
        std::vector<Vector<Interval>> residuals;
        for (std::size_t i = 0; i < point.size(); ++i) {
            residuals.push_back(leg_residual(springs, chain_, point, i));
        }
        const auto product = [&](std::size_t row) {
            Interval sum;
            for (std::size_t i = 0; i < point.size(); ++i) {
                sum += at(row, 2 * i) * residuals[i].position + at(row, 2 * i + 1) * residuals[i].velocity;
            }
            return sum;
        };
        if (relaxed_) {
            slack_ = -product(relaxed_->unknown).middle();
            Vector<Interval>& of_leg = residuals[relaxed_->equation / 2];
            (relaxed_->equation % 2 == 0 ? of_leg.position : of_leg.velocity) += slack_;
        }
        for (std::size_t row = 0; row < size(); ++row) correction_.push_back(product(row).size());
    }

    [[nodiscard]] std::size_t size() const { return 2 * chain_.events.size(); }
    // The value of C G(m).
    [[nodiscard]] const std::vector<double>& correction() const { return correction_; }

    // The places of the box m -+ radii.
    [[nodiscard]] std::vector<Place<Interval>> places(std::vector<double> radii) const {
        if (relaxed_) radii[relaxed_->unknown] = held_radius();
        return box_around(chain_, radii);
    }

    // The largest distance from m of the operator's image of the box m -+ radii. For the many entries of I - C
    // A only bounds in doubles are needed: each is rounded at most a dozen times, which `rounding` covers.
    [[nodiscard]] std::vector<double> image(const std::vector<double>& radii) const {
        const std::vector<Column> columns = columns_of(places(radii));
        std::vector<double> reach;
        for (std::size_t row = 0; row < size(); ++row) {
            double sum = correction_[row] + 1e-290;  // exceeds any underflow
            for (std::size_t column = 0; column < size(); ++column) {
                sum += from_identity(columns, row, column) * radii[column];
            }
            if (relaxed_) {
                const std::size_t held = relaxed_->unknown;
                sum += columns[held].from_identity(factors(row, held), 0) * held_radius();
            }
            reach.push_back(sum * rounding);
        }
        return reach;
    }

    // Of a relaxed chain, for a box that contains the image of a larger one: mu, and mu', the last of the
    // unknowns z of A z = -dG/ds. With y = -C dG/ds and E = I - C A, z = y + E z and |z| <= |y| + |E| max|y|/(1
    // - |E|).
    [[nodiscard]] RelaxedOrbits relaxed(EnclosedOrbits orbits, const std::vector<double>& radii) const {
        RelaxedOrbits result{std::move(orbits), around(slack_, radii[relaxed_->unknown]), nothing()};
        const std::vector<Column> columns = columns_of(result.orbits.places);
        const std::size_t held = relaxed_->unknown;
        std::vector<Interval> y;
        double longest = 0;
        double norm = 0;
        for (std::size_t row = 0; row < size(); ++row) {
            y.push_back(-columns[held].times(factors(row, held)));
            longest = std::max(longest, y[row].size());
            double sum = 0;
            for (std::size_t column = 0; column < size(); ++column) sum += from_identity(columns, row, column);
            norm = std::max(norm, sum * rounding);
        }
        if (!(norm < 0.5)) return result;
        const double more = norm * longest / (1 - norm);
        double reach = 1e-290;
        for (std::size_t column = 0; column < size(); ++column) {
            reach += from_identity(columns, held, column) * (y[column].size() + more);
        }
        result.slope = y[held] + Interval(-reach, reach) * Interval(rounding);
        return result;
    }

  private:
    [[nodiscard]] Interval at(std::size_t row, std::size_t column) const {
        return inverse_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
    }
    [[nodiscard]] double held_radius() const { return relaxed_->held.radius(); }

    [[nodiscard]] std::vector<Column> columns_of(const std::vector<Place<Interval>>& box) const {
        const Legs legs = legs_of(springs_, chain_, box);
        std::vector<Column> columns;
        for (std::size_t i = 0; i < legs.size(); ++i) {
            const LegEquations<Interval>& before = legs[(i + legs.size() - 1) % legs.size()];
            columns.emplace_back(legs[i].of_time, before.of_end_time);
            columns.emplace_back(legs[i].of_along, before.of_end_along);
        }
        return columns;
    }

    // The entries of C by which a column's nonzero numbers are multiplied.
    [[nodiscard]] std::array<double, 4> factors(std::size_t row, std::size_t column) const {
        const std::size_t legs = chain_.events.size();
        const std::size_t leg = column / 2;
        const auto r = static_cast<Eigen::Index>(row);
        const auto first = static_cast<Eigen::Index>(2 * leg);
        const auto second = static_cast<Eigen::Index>(2 * ((leg + legs - 1) % legs));
        return {inverse_(r, first), inverse_(r, first + 1), inverse_(r, second), inverse_(r, second + 1)};
    }

    // A bound of an entry of |I - C A|.
    [[nodiscard]] double from_identity(const std::vector<Column>& columns, std::size_t row,
                                       std::size_t column) const {
        const double identity = row == column ? 1 : 0;
        if (!relaxed_ || column != relaxed_->unknown)
            return columns[column].from_identity(factors(row, column), identity);
        const auto r = static_cast<Eigen::Index>(row);
        return std::abs(identity - inverse_(r, static_cast<Eigen::Index>(relaxed_->equation)));
    }

    const Springs<Interval>& springs_;
    EventChain chain_;
    std::optional<Relaxation> relaxed_;
    Eigen::MatrixXd inverse_;
    std::vector<double> correction_;
    double slack_ = 0;  // mu of m
};

bool inside(const std::vector<double>& image, const std::vector<double>& radii) {
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (!(image[i] < radii[i])) return false;
    }
    return true;
}

// Radii of a box that contains its image, and of the image.
struct Enclosure {
    std::vector<double> alone;
    std::vector<double> image;

    [[nodiscard]] EnclosedOrbits orbits(const Krawczyk& krawczyk) const {
        return {krawczyk.places(image), krawczyk.places(alone)};
    }
};

std::optional<Enclosure> enclose(const Krawczyk& krawczyk, std::vector<double> radii) {
    for (double& radius : radii) radius = 1.5 * radius + 1e-280;
    constexpr double widest =
        0.1;  // of a box that may hold a single orbit; a leg from a wide one costs seconds
    for (int tries = 0; tries < 6 && std::ranges::max(radii) < widest; ++tries) {
        const std::vector<double> image = krawczyk.image(radii);
        if (inside(image, radii)) return Enclosure{radii, image};
        for (std::size_t i = 0; i < radii.size(); ++i) radii[i] = 1.5 * std::max(image[i], radii[i]);
    }
    return std::nullopt;
}

}  // namespace

std::optional<EnclosedOrbits> enclosed_orbits(const Springs<Interval>& springs, const Springs<double>& middle,
                                              const EventChain& chain) {
    const Krawczyk krawczyk(springs, middle, chain);
    const auto found = enclose(krawczyk, krawczyk.correction());
    return found ? std::optional(found->orbits(krawczyk)) : std::nullopt;
}

std::optional<std::vector<Place<Interval>>> orbit_box(const Springs<Interval>& springs,
                                                      const Springs<double>& middle, const EventChain& chain) {
    auto found = enclosed_orbits(springs, middle, chain);
    return found ? std::optional(std::move(found->places)) : std::nullopt;
}

// All members of the family have to fit in the first box. mu, of second order in their spread, needs no box of
// its own size, since the equations are linear in it.
std::optional<RelaxedOrbits> relaxed_orbits(const Springs<Interval>& springs, const Springs<double>& middle,
                                            const EventChain& chain, const Relaxation& relaxation) {
    const Krawczyk krawczyk(springs, middle, chain, relaxation);
    std::vector<double> first = krawczyk.image(std::vector<double>(krawczyk.size(), 0.0));
    first[relaxation.unknown] = std::ranges::max(first);
    const auto found = enclose(krawczyk, first);
    if (!found) return std::nullopt;
    return krawczyk.relaxed(found->orbits(krawczyk), found->image);
}

}  // namespace peterka::certificate
