#include "certificate/branch_crossing.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "certificate/leg_proof.hpp"
#include "certificate/smallest_period.hpp"
#include "certificate/stability.hpp"

namespace peterka::certificate {
namespace {

using Places = std::vector<Place<Interval>>;

bool lies_in(const Interval& x, const Interval& other) {
    return other.lo <= x.lo && x.hi <= other.hi;
}

bool lies_in(const Places& places, const Places& others) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool is_inside =
            lies_in(places[i].time, others[i].time) && lies_in(places[i].along, others[i].along);
        if (!is_inside) return false;
    }
    return true;
}

// A rig, and numbers within it for a search.
struct Here {
    explicit Here(const Rig& rig) : springs(rig), approximate(middle(rig)) {}
    Springs<Interval> springs;
    Springs<double> approximate;
};

// The rigs as lambda changes.
class Rigs {
  public:
    Rigs(const job::CellNumbers& numbers, std::string_view key) : numbers_(numbers), key_(key) {}

    [[nodiscard]] std::optional<Here> at(double lambda) const {
        const std::optional<Rig> rig = rig_at(lambda);
        return rig ? std::optional<Here>(*rig) : std::nullopt;
    }
    // Each number of a rig is a product of powers of the job's numbers, which have no zero between these two:
    // it is monotonic, and lies between its values at the ends.
    [[nodiscard]] std::optional<Here> over(const Interval& lambda) const {
        const std::optional<Rig> low = rig_at(lambda.lo);
        const std::optional<Rig> high = rig_at(lambda.hi);
        const bool keeps_its_sign = lambda.positive() || lambda.negative();
        if (!low || !high || !keeps_its_sign) return std::nullopt;
        Rig rig = *low;
        for (const auto number : {&Rig::damping_ratio, &Rig::stiffness, &Rig::damping, &Rig::frequency,
                                  &Rig::gap, &Rig::period, &Rig::cubic, &Rig::restitution}) {
            rig.*number = hull((*low).*number, (*high).*number);
        }
        return Here(rig);
    }

  private:
    [[nodiscard]] std::optional<Rig> rig_at(double lambda) const {
        job::CellNumbers numbers = numbers_;
        job::set_number(numbers, key_, lambda);
        return rig_of(numbers);
    }

    const job::CellNumbers& numbers_;
    std::string_view key_;
};

struct Family {
    BranchEvent event = BranchEvent::fold;
    EventChain chain;
    Fold fold;  // of a fold alone

    [[nodiscard]] std::size_t grazing() const {
        return static_cast<std::size_t>(std::ranges::find_if(chain.events, is_grazing, &Event::kind) -
                                        chain.events.begin());
    }
    // Whether the chain can be one of this stop, with a grazing where the crossing is one.
    [[nodiscard]] bool is_of(const Rig& rig) const {
        const auto grazings = std::ranges::count_if(chain.events, is_grazing, &Event::kind);
        const auto can_be = [&](EventKind kind) {
            const bool of_any = kind == EventKind::graze;
            const bool of_rigid = kind == EventKind::bounce;
            return of_any || (kind != EventKind::lift_off && of_rigid == rig.rigid);
        };
        return chain.period > 0 && !chain.events.empty() &&
               std::ranges::all_of(chain.events, can_be, &Event::kind) &&
               grazings == (event == BranchEvent::grazing ? 1 : 0);
    }
};

// mu and mu' in doubles, and their chain.
struct Slack {
    double value = 0;
    double slope = 0;
};

// Newton's method for a chain relaxed at s.
std::optional<Slack> refine(const Springs<double>& springs, EventChain& chain, const Relaxation& relaxation,
                            double s) {
    const auto held = static_cast<Eigen::Index>(relaxation.unknown);
    unknown_of(chain, relaxation.unknown) = s;
    for (int steps = 0; steps < 10; ++steps) {
        EquationsInDoubles equations = equations_in_doubles(springs, chain);
        const Eigen::VectorXd by_held = equations.derivatives.col(held);
        equations.derivatives.col(held).setZero();
        equations.derivatives(static_cast<Eigen::Index>(relaxation.equation), held) = 1;
        const Eigen::PartialPivLU<Eigen::MatrixXd> solver(equations.derivatives);
        const Eigen::VectorXd step = -solver.solve(equations.residuals);
        double largest = 0;
        for (Eigen::Index i = 0; i < step.size(); ++i) {
            if (i == held) continue;
            unknown_of(chain, static_cast<std::size_t>(i)) += step[i];
            if (i % 2 == 0) largest = std::max(largest, std::abs(step[i]));
        }
        if (!step.allFinite()) return std::nullopt;
        if (largest < 1e-12) return Slack{step[held], -solver.solve(by_held)[held]};
    }
    return std::nullopt;
}

bool settle(const Springs<double>& springs, Family& family) {
    if (family.event != BranchEvent::fold) return refine(springs, family.chain);
    return refine(springs, family.chain, family.fold.relaxation, family.fold.middle()).has_value();
}

// The family's members for all lambda of a rig, and f.
struct Members {
    EnclosedOrbits orbits;
    Interval test;

    [[nodiscard]] const Places& places() const { return orbits.places; }
    // Whether orbits for one of these lambda are among these.
    [[nodiscard]] bool hold(const EnclosedOrbits& others) const { return lies_in(others.places, orbits.alone); }
};

std::optional<Members> members_at_fold(const Here& here, const EventChain& chain, const Fold& fold) {
    const auto all = relaxed_orbits(here.springs, here.approximate, chain, fold.relaxation);
    const auto one = relaxed_orbits(here.springs, here.approximate, chain, fold.held_at(fold.middle()));
    if (!all || !one || !lies_in(one->orbits.places, all->orbits.alone)) return std::nullopt;
    const Interval sign(fold.sign);
    return Members{all->orbits, {(sign * one->slack).lo, (sign * all->slack).hi}};
}

// From a chain that is settled at the middle of the rig.
std::optional<Members> members(const Here& here, const Family& family) {
    if (family.event == BranchEvent::fold) return members_at_fold(here, family.chain, family.fold);
    const auto orbits = enclosed_orbits(here.springs, here.approximate, family.chain);
    if (!orbits) return std::nullopt;
    if (family.event == BranchEvent::grazing) return Members{*orbits, orbits->places[family.grazing()].along};
    const Multipliers of_orbit = multipliers(here.springs, family.chain, orbits->places);
    return Members{*orbits, Interval(1) + of_orbit.trace + of_orbit.determinant};
}

// Whether +-mu surely rises at the lower end of S, and falls at the upper one.
bool has_its_maximum_inside(const Here& here, const EventChain& chain, const Fold& fold, const Members& all) {
    for (const bool lower : {true, false}) {
        const double s = lower ? fold.relaxation.held.lo : fold.relaxation.held.hi;
        EventChain there = chain;
        if (!refine(here.approximate, there, fold.relaxation, s)) return false;
        const auto end = relaxed_orbits(here.springs, here.approximate, there, fold.held_at(s));
        if (!end || !all.hold(end->orbits)) return false;
        const Interval slope = Interval(fold.sign) * end->slope;
        if (!(lower ? slope.positive() : slope.negative())) return false;
    }
    return true;
}

struct Settled {
    Family family;
    Members members;
};

std::optional<Settled> members_at(const Rigs& rigs, Family family, double lambda) {
    const std::optional<Here> here = rigs.at(lambda);
    if (!here || !settle(here->approximate, family)) return std::nullopt;
    auto found = members(*here, family);
    if (!found) return std::nullopt;
    return Settled{std::move(family), std::move(*found)};
}

// Whether the family continues over an interval of lambda, from its members at the lower end to those at the
// upper end, and all of them are motions.
Crossed continues_over(const Rigs& rigs, Family family, const Interval& lambda, const EnclosedOrbits& low,
                       const EnclosedOrbits& high) {
    const std::optional<Here> here = rigs.over(lambda);
    if (!here || !settle(here->approximate, family)) return Crossed::no_orbit_enclosed;
    if (here->springs.flight.is_too_bent()) return Crossed::cubic_spring;
    const auto all = members(*here, family);
    if (!all || !all->hold(low) || !all->hold(high)) return Crossed::no_orbit_enclosed;
    if (family.event == BranchEvent::fold && !has_its_maximum_inside(*here, family.chain, family.fold, *all))
        return Crossed::not_surely_crossed;
    for (std::size_t i = 0; i < all->places().size(); ++i) {
        if (!leg_is_free(here->springs, family.chain, all->places(), i)) return Crossed::near_grazing;
    }
    return has_no_smaller_period(family.chain, all->places()) ? Crossed::proved : Crossed::other_label;
}

constexpr int most_halvings = 11;

// The same, in parts if need be: with the members at its middle belonging to both halves.
Crossed continues_in_parts(const Rigs& rigs, const Family& family, const Interval& lambda,
                           const EnclosedOrbits& low, const EnclosedOrbits& high, int halvings = 0) {
    const Crossed whole = continues_over(rigs, family, lambda, low, high);
    const double middle = lambda.middle();
    const bool has_parts = lambda.lo < middle && middle < lambda.hi;
    if (whole == Crossed::proved || halvings == most_halvings || !has_parts) return whole;
    const auto between = members_at(rigs, family, middle);
    if (!between) return whole;
    const EnclosedOrbits& orbits = between->members.orbits;
    const Crossed first = continues_in_parts(rigs, family, {lambda.lo, middle}, low, orbits, halvings + 1);
    if (first != Crossed::proved) return first;
    return continues_in_parts(rigs, family, {middle, lambda.hi}, orbits, high, halvings + 1);
}

// The members at both ends of an interval.
struct MembersAtEnds {
    Members low;
    Members high;
    [[nodiscard]] bool differ() const {
        const Interval& a = low.test;
        const Interval& b = high.test;
        return (a.positive() && b.negative()) || (a.negative() && b.positive());
    }
};

std::optional<MembersAtEnds> members_at_ends(const Rigs& rigs, const Family& family, const Interval& lambda) {
    const auto low = members_at(rigs, family, lambda.lo);
    const auto high = members_at(rigs, family, lambda.hi);
    if (!low || !high) return std::nullopt;
    return MembersAtEnds{low->members, high->members};
}

Crossed crosses(const Rigs& rigs, const Family& family, const Interval& within) {
    const auto ends = members_at_ends(rigs, family, within);
    if (!ends) return Crossed::no_orbit_enclosed;
    if (!ends->differ()) return Crossed::not_surely_crossed;
    return continues_in_parts(rigs, family, within, ends->low.orbits, ends->high.orbits);
}

// Where f vanishes, in doubles.
struct Zero {
    double lambda = 0;
    double slope = 0;  // f' there
    Family family;
};

constexpr int most_steps = 12;  // Newton's method needs 3 to 5

// Newton's method on the middle of f's enclosure, up to its radius. small_step: of difference quotients,
// relative.
std::optional<Zero> zero_of_test(const Rigs& rigs, Family family, double lambda, double small_step) {
    for (int steps = 0; steps < most_steps; ++steps) {
        const double h = small_step * lambda;
        const auto here = members_at(rigs, family, lambda);
        if (!here) return std::nullopt;
        const auto beside = members_at(rigs, here->family, lambda + h);
        if (!beside) return std::nullopt;
        const Interval& test = here->members.test;
        const double slope = (beside->members.test.middle() - test.middle()) / h;
        const double step = test.middle() / slope;
        if (!std::isfinite(step)) return std::nullopt;
        family = here->family;
        lambda -= step;
        if (std::abs(step) <= std::max(2 * std::abs(test.radius() / slope), 1e-15 * std::abs(lambda)))
            return Zero{lambda, slope, family};
    }
    return std::nullopt;
}

// An unknown and an equation without which the others determine the orbits near a fold: the largest in the
// singular vectors of the derivatives. Sizes: of the unknowns.
Fold fold_of(const Springs<double>& springs, const EventChain& chain, const Eigen::VectorXd& sizes) {
    const Eigen::MatrixXd scaled = equations_in_doubles(springs, chain).derivatives * sizes.asDiagonal();
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(
        scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Index last = scaled.cols() - 1;
    Eigen::Index unknown = 0;
    Eigen::Index equation = 0;
    svd.matrixV().col(last).cwiseAbs().maxCoeff(&unknown);
    svd.matrixU().col(last).cwiseAbs().maxCoeff(&equation);
    return {{static_cast<std::size_t>(unknown), static_cast<std::size_t>(equation), {}}, 1};
}

Eigen::VectorXd sizes_of_unknowns(const Springs<double>& springs, const EventChain& chain) {
    double largest = 0;
    for (const Event& event : chain.events) largest = std::max(largest, std::abs(event.along));
    const Eigen::Vector2d of_event(1 / springs.rig.frequency, largest);
    return of_event.replicate(static_cast<Eigen::Index>(chain.events.size()), 1);
}

// Newton's method for mu = mu' = 0 in (s, lambda). `share` sets the length of S.
std::optional<Zero> zero_at_fold(const Rigs& rigs, Family family, double lambda, double share) {
    std::optional<Here> here = rigs.at(lambda);
    if (!here) return std::nullopt;
    const Eigen::VectorXd sizes = sizes_of_unknowns(here->approximate, family.chain);
    family.fold = fold_of(here->approximate, family.chain, sizes);
    const Relaxation relaxation = family.fold.relaxation;
    const double size = sizes[static_cast<Eigen::Index>(relaxation.unknown)];
    double s = unknown_of(family.chain, relaxation.unknown);
    const auto slack = [&](double at, double of) {
        const std::optional<Here> there = rigs.at(of);
        return there ? refine(there->approximate, family.chain, relaxation, at) : std::nullopt;
    };
    for (int steps = 0; steps < most_steps; ++steps) {
        const double h = 1e-6 * lambda;
        const double d = 1e-5 * size;
        const auto beside = slack(s + d, lambda);
        const auto later = slack(s, lambda + h);
        const auto now = slack(s, lambda);
        if (!beside || !later || !now) return std::nullopt;
        const double bend = (beside->slope - now->slope) / d;
        const double by_lambda = (later->value - now->value) / h;
        const double slope_by_lambda = (later->slope - now->slope) / h;
        const double determinant = now->slope * slope_by_lambda - by_lambda * bend;
        const double of_s = (now->value * slope_by_lambda - now->slope * by_lambda) / determinant;
        const double of_lambda = (now->slope * now->slope - now->value * bend) / determinant;
        if (!std::isfinite(of_s) || !std::isfinite(of_lambda)) return std::nullopt;
        s -= of_s;
        lambda -= of_lambda;
        if (std::abs(of_s) > 0.1 * share * size || std::abs(of_lambda) > 1e-10 * std::abs(lambda)) continue;
        family.fold.sign = bend < 0 ? 1 : -1;
        family.fold.relaxation.held = {s - share * size, s + share * size};
        return Zero{lambda, family.fold.sign * by_lambda, family};
    }
    return std::nullopt;
}

// Proves it in the narrowest of a sequence of intervals around the zero at whose ends the signs differ.
CrossingProof prove_around(const Rigs& rigs, const Zero& zero) {
    constexpr double widest = 1e-6;  // relative
    const auto there = members_at(rigs, zero.family, zero.lambda);
    if (!there) return {Crossed::no_orbit_enclosed};
    const double size = std::abs(zero.lambda);
    double radius = std::max(1.5 * there->members.test.size() / std::abs(zero.slope), 4e-16 * size);
    for (; radius < widest * size; radius *= 2) {
        const Interval within{zero.lambda - radius, zero.lambda + radius};
        const auto ends = members_at_ends(rigs, there->family, within);
        if (!ends) return {Crossed::no_orbit_enclosed};
        if (!ends->differ()) continue;
        const Crossed verdict =
            continues_in_parts(rigs, there->family, within, ends->low.orbits, ends->high.orbits);
        return {verdict, verdict == Crossed::proved ? within : nothing()};
    }
    return {Crossed::not_surely_crossed};
}

// Half the length of S over the size of the unknown: as short as lets the sign of mu' at its ends be proved,
// for the bounds of mu are further apart by about the square of it.
constexpr std::array shares_of_unknown{1e-8, 1e-7, 1e-6, 1e-5, 1e-4};

CrossingProof prove_fold(const Rigs& rigs, const Family& family, double near) {
    CrossingProof proof{Crossed::no_orbit_found};
    for (const double share : shares_of_unknown) {
        const std::optional<Zero> zero = zero_at_fold(rigs, family, near, share);
        if (!zero) continue;
        proof = prove_around(rigs, *zero);
        if (proof.proved()) break;
    }
    return proof;
}

}  // namespace

Crossed crosses_within(const job::CellNumbers& numbers, const BranchCrossing& found, const Interval& within) {
    const Rigs rigs(numbers, found.key);
    const Family family{found.event, found.chain, {}};
    const std::optional<Here> here = rigs.at(found.near);
    if (!here) return Crossed::other_stop;
    if (!family.is_of(here->springs.rig)) return Crossed::no_orbit_found;
    if (found.event != BranchEvent::fold) return crosses(rigs, family, within);
    Crossed last = Crossed::no_orbit_found;
    for (const double share : shares_of_unknown) {
        const std::optional<Zero> zero = zero_at_fold(rigs, family, found.near, share);
        if (zero) last = crosses(rigs, zero->family, within);
        if (last == Crossed::proved) break;
    }
    return last;
}

Crossed folds_within(const job::CellNumbers& numbers, const BranchCrossing& found, const Fold& fold,
                     const Interval& within) {
    return crosses(Rigs(numbers, found.key), {BranchEvent::fold, found.chain, fold}, within);
}

CrossingProof prove_crossing(const job::CellNumbers& numbers, const BranchCrossing& found) {
    const Rigs rigs(numbers, found.key);
    const Family family{found.event, found.chain, {}};
    const std::optional<Here> here = rigs.at(found.near);
    if (!here) return {Crossed::other_stop};
    if (here->springs.flight.is_too_bent()) return {Crossed::cubic_spring};
    if (!family.is_of(here->springs.rig)) return {Crossed::no_orbit_found};
    if (found.event == BranchEvent::fold) return prove_fold(rigs, family, found.near);
    // Close to a fold, the branch may end within the longer step.
    for (const double small_step : {1e-6, 1e-9}) {
        const std::optional<Zero> zero = zero_of_test(rigs, family, found.near, small_step);
        if (zero) return prove_around(rigs, *zero);
    }
    return {Crossed::no_orbit_found};
}

}  // namespace peterka::certificate
