// What a trace tells of the cell of a map that it follows.
#include "report/trace_words.hpp"

#include <gtest/gtest.h>

#include <string>

#include "rig.hpp"

namespace peterka {
namespace {

using regime::Regime;
using regime::Status;

struct Found {
    Regime regime = Regime::periodic;
    Status status = Status::verified;
    bool computed = true;
};

std::string told(const Found& stored, const Found& found, std::int32_t impacts) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::map;
    job.columns = {1, 2, 3, job::Spacing::linear, "frequency_ratio"};
    job.rows = {0, 2, 3, job::Spacing::linear, "gap_ratio"};
    trace::Trace trace;
    trace.course.cell = regime::CellResult{};
    trace.course.cell->regime = found.regime;
    trace.course.cell->status = found.status;
    trace.course.cell->impacts = impacts;
    trace.course.cell->period = 2;
    map_file::MapCell map{.file = "a.h5", .row = 1, .column = 1, .job = job};
    map.stored.regime = stored.regime;
    map.stored.status = stored.status;
    map.stored.computed = stored.computed;
    map.stored.impacts = 1;
    map.stored.period = 2;
    job.kind = job::Kind::trace;
    job.operating_point.frequency_ratio = 1.5;
    job.operating_point.gap_ratio = 1;
    const std::string text = trace_in_words(scene::Scene(job), trace, map);
    const auto begin = text.rfind("  this trace       ");
    return text.substr(begin + 19, text.find('\n', begin) - begin - 19);
}

TEST(TraceWords, WhetherTheCellAgrees) {
    EXPECT_EQ(told({}, {}, 1).substr(0, 22), "agrees in regime and z");
    EXPECT_EQ(told({}, {}, 2), "DISAGREES in regime or z");
    EXPECT_EQ(told({.status = Status::imprecise}, {}, 2), "DISAGREES in regime or z");
}

TEST(TraceWords, OfChaosAndWhereRoundingDecidesAnotherMotionIsNoFault) {
    const char* differs = "differs in regime or z, as it may where chaos can end or rounding decides";
    EXPECT_EQ(told({.regime = Regime::chaotic}, {}, 2), differs);
    EXPECT_EQ(told({}, {.regime = Regime::unresolved}, 2), differs);
    EXPECT_EQ(told({.status = Status::rounding}, {}, 2), differs);
    EXPECT_EQ(told({.status = Status::rounding}, {}, 1).substr(0, 22), "agrees in regime and z");
}

TEST(TraceWords, AFilledCellWasNotComputed) {
    EXPECT_EQ(told({.computed = false}, {}, 2), "has another regime or z");
    EXPECT_EQ(told({.computed = false}, {}, 1).substr(0, 22), "agrees in regime and z");
}

}  // namespace
}  // namespace peterka
