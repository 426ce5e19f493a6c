// The closing summary of curves made up by hand.
#include "curves/words.hpp"

#include <gtest/gtest.h>

#include <string>

#include "rig.hpp"

namespace peterka::curves {
namespace {

Curve curve_of(CurveKind kind, std::int64_t impacts, std::size_t points) {
    Curve curve;
    curve.kind = kind;
    curve.impacts = impacts;
    for (std::size_t i = 0; i < points; ++i) {
        CurvePoint point;
        point.place = {1 + 0.25 * static_cast<double>(i), 1};
        curve.points.push_back(point);
    }
    return curve;
}

// Each kind below its own name.
TEST(CurveWords, CountCurvesByLabelAndKind) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::curves;
    job.columns = {.from = 0.5, .to = 4.5, .points = 3};
    job.rows = {.from = 0, .to = 5, .points = 3};
    CurveSearchResult found;
    for (int i = 0; i < 2; ++i) found.curves.push_back(curve_of(CurveKind::fold, 1, 2));
    for (int i = 0; i < 3; ++i) found.curves.push_back(curve_of(CurveKind::period_doubling, 1, 4));
    for (int i = 0; i < 4; ++i) found.curves.push_back(curve_of(CurveKind::grazing, 1, 5));
    found.curves.push_back(curve_of(CurveKind::grazing, 0, 6));
    const std::string text = in_words(scene::Scene(job), found);
    EXPECT_NE(text.find("  z             fold   period doubling   grazing    points\n"
                        "  no impact        0                 0         1         6\n"
                        "  1/1              2                 3         4        36\n"),
              std::string::npos)
        << text;
}

}  // namespace
}  // namespace peterka::curves
