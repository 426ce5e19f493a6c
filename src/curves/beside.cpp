#include "curves/beside.hpp"

#include <Eigen/SVD>
#include <optional>

#include "curves/branch_step.hpp"
#include "curves/merging.hpp"
#include "curves/orbit_check.hpp"
#include "curves/reshape.hpp"

namespace peterka::curves {

namespace {

constexpr double step_aside = 1e-4;

bool is_motion(const Rig& rig, const OrbitPoint& point) {
    const OrbitFault::Kind fault = find_fault(rig, point).kind;
    return fault != OrbitFault::Kind::pierces && fault != OrbitFault::Kind::slow;
}

bool is_stable(const Rig& rig, const OrbitPoint& point) {
    return monodromy(rig, point.orbit, point.place, {}).is_stable();
}

Stepper along(const Rig& rig, const PlanePoint& window, const PlanePoint& through, const PlanePoint& way) {
    return {rig,
            window,
            {Condition::on_line(
                through, {way.row / window.row / window.column, -way.column / window.column / window.row})}};
}

// The direction in which the two halves of a doubled orbit separate, in scaled unknowns. At a period doubling
// the null space of the Jacobian is spanned by it and the tangent of the branch of half the period (branch
// switching: Keller 1977).
Eigen::VectorXd parting_of_halves(const Stepper& stepper, const OrbitPoint& doubled) {
    const Eigen::VectorXd sizes = sizes_of_unknowns(stepper.rig(), doubled, stepper.window());
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(sizes.size(), sizes.size());  // there is an equation less
    square.topRows(sizes.size() - 1) =
        equations(stepper.rig(), doubled, stepper.conditions()).jacobian * sizes.asDiagonal();
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> parts(square, Eigen::ComputeFullV);
    const Eigen::Index half = (sizes.size() - 2) / 2;
    Eigen::VectorXd parting = Eigen::VectorXd::Zero(sizes.size());
    for (const Eigen::Index last : {1, 2}) {
        const Eigen::VectorXd free = parts.matrixV().col(sizes.size() - last);
        const Eigen::VectorXd apart = (free.head(half) - free.segment(half, half)) / 2;
        if (apart.norm() <= parting.head(half).norm()) continue;
        parting.head(half) = apart;
        parting.segment(half, half) = -apart;
    }
    return parting.normalized();
}

}  // namespace

Beside motions_beside(const Rig& rig, const PlanePoint& window, const Seed& at, const PlanePoint& way) {
    std::vector<OrbitPoint> starts;
    if (at.kind == CurveKind::grazing) {
        for (const bool gains : {true, false}) starts.push_back(beyond_grazing(rig, at.point, gains));
    } else {
        starts.push_back(at.point);
    }
    Beside beside;
    for (const OrbitPoint& start : starts) {
        if (start.orbit.events.empty()) {  // the motion without impacts
            beside.any = true;
            beside.stable.push_back(start);
            continue;
        }
        Stepper stepper = along(rig, window, at.point.place, way);
        Stepper::Here here = stepper.at(start);
        for (int direction = 0; direction < 2; ++direction) {
            stepper.set_step(step_aside);
            const auto next = stepper.next(here, step_aside);
            if (next && is_motion(rig, next->point)) {
                beside.any = true;
                if (is_stable(rig, next->point)) beside.stable.push_back(next->point);
            }
            here.tangent = -here.tangent;
        }
    }
    return beside;
}

std::vector<OrbitPoint> stable_doubled_beside(const Rig& rig, const PlanePoint& window, const OrbitPoint& at,
                                              const PlanePoint& way) {
    Stepper stepper = along(rig, window, at.place, way);
    const OrbitPoint doubled = twice(rig, at);
    const Stepper::Here here{doubled, parting_of_halves(stepper, doubled)};
    // longer steps where the branch leaves so flat that Newton's method falls back onto the orbit of half the
    // period
    for (const double step : {step_aside / 10, step_aside, 10 * step_aside, 100 * step_aside}) {
        stepper.set_step(step);
        const auto next = stepper.next(here, step);
        if (!next || halves_are_equal(stepper, next->point)) continue;
        if (is_motion(rig, next->point) && is_stable(rig, next->point)) return {next->point};
        return {};
    }
    return {};
}

}  // namespace peterka::curves
