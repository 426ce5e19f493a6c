#include "certificate/patch.hpp"

#include <gtest/gtest.h>

#include "certificate/find_chain.hpp"
#include "certified_cells.hpp"

namespace peterka::certificate {
namespace {

// For all places of a set and all ends in a box: -G_y^-1 G_x.
Matrix<Interval> derivative_over(const Springs<Interval>& springs, const Patch& from, const Event& to,
                                 const Place<Interval>& ends) {
    const Place<Interval> all = from.hull();
    const Vector<Interval> leaving = springs.leaving(from.event.kind);
    const Leg<Interval> leg(springs.phase(false), all.time, scaled(leaving, all.along));
    const Interval length = ends.time - all.time + Interval(static_cast<double>(to.cycle)) * springs.rig.period;
    const LegEquations<Interval> at = leg_equations(springs, leg, length, leaving, to.kind, ends);
    const Matrix<Interval> by_end = inverse(Matrix<Interval>{
        at.of_end_time.position, at.of_end_along.position, at.of_end_time.velocity, at.of_end_along.velocity});
    const Matrix<Interval> change = by_end * Matrix<Interval>{at.of_time.position, at.of_along.position,
                                                              at.of_time.velocity, at.of_along.velocity};
    return {-change.a, -change.b, -change.c, -change.d};
}

Place<Interval> widened_by(double factor, const Place<Interval>& place) {
    return {around(place.time.middle(), factor * place.time.radius()),
            around(place.along.middle(), factor * place.along.radius())};
}

// The narrower the box of possible ends, the narrower the derivative over it.
TEST(Patch, IsCarriedByTheDerivativeOverABoxHalfAsLargeAgainAsItsEnds) {
    job::CellNumbers numbers = testing::numbers_170mm(2, 0.5);
    numbers.contact = job::Restitution{0.6};
    const Rig rig = rig_of(numbers).value();
    const Springs<Interval> springs(rig);
    const Springs<double> approximate(middle(rig));
    for (const double speed : {1.5, 2.0, 2.5}) {
        Patch patch = patch_of(EventKind::bounce, {Interval(0.4), Interval(speed)});
        patch.spread = {Interval(-1e-4, 1e-4), Interval(0)};
        Event to;
        ASSERT_EQ(Walk::after(approximate, patch.event).go_on(100, to), Walk::End::event);
        sort_into_cycle(to, approximate.rig.period);
        const auto passage = pass(springs, approximate, patch, to);
        ASSERT_TRUE(passage);
        const Matrix<Interval> narrow = derivative_over(springs, patch, to, passage->end.hull());
        const Matrix<Interval> wide = derivative_over(springs, patch, to, widened_by(1.6, passage->end.hull()));
        for (const auto entry :
             {&Matrix<Interval>::a, &Matrix<Interval>::b, &Matrix<Interval>::c, &Matrix<Interval>::d}) {
            EXPECT_TRUE((narrow.*entry).inside(passage->derivative.*entry));
            EXPECT_TRUE((passage->derivative.*entry).inside(wide.*entry));
        }
    }
}

}  // namespace
}  // namespace peterka::certificate
