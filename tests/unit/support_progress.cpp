// The contents of the progress line; the end-to-end tests cover when it is printed.
#include "support/progress.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

namespace peterka {
namespace {

TEST(ProgressText, RateAndTimeLeftComeFromThisRunAlone) {
    // 1000 cells were in the file, 500 more took 10 s, 500 are left.
    EXPECT_EQ(progress_text({2000, 1000, 1500}, 10), " 75.0 %  50 cells/s  ETA 10.0 s");
}

TEST(ProgressText, HundredPercentMeansThatNothingIsLeft) {
    EXPECT_EQ(progress_text({100000, 0, 99999}, 10).substr(0, 7), " 99.9 %");
    EXPECT_EQ(progress_text({100000, 0, 100000}, 10).substr(0, 7), "100.0 %");
}

TEST(ProgressText, InTheEndItSaysHowLongItTook) {
    EXPECT_EQ(progress_text({2000, 1000, 2000}, 10), "100.0 %  100 cells/s  in 10.0 s");
}

TEST(ProgressText, NoRateBeforeTheFirstCell) {
    EXPECT_EQ(progress_text({100, 50, 50}, 3), " 50.0 %");
    EXPECT_EQ(progress_text({100, 0, 50}, 0), " 50.0 %");
}

TEST(ProgressBar, FillsFromTheLeft) {
    EXPECT_EQ(progress_bar({100, 0, 0}, 10), "[..........]");
    EXPECT_EQ(progress_bar({100, 0, 39}, 10), "[###.......]");
    EXPECT_EQ(progress_bar({100, 0, 100}, 10), "[##########]");
    EXPECT_EQ(progress_bar({0, 0, 0}, 10), "[##########]");
}

TEST(ProgressLine, FitsAnyTerminal) {
    const ProgressCounts counts{10'000'000, 0, 1'234'567};
    for (int columns = 1; columns <= 200; ++columns) {
        const std::string line = progress_line(counts, 1000, columns);
        EXPECT_EQ(line.size(), static_cast<std::size_t>(std::clamp(columns - 1, 1, 79))) << columns;
    }
}

TEST(ProgressLine, GivesUpTheBarFirstAndThePercentageLast) {
    const ProgressCounts counts{10'000'000, 0, 5'000'000};
    const std::string text = " 50.0 %  5,000 cells/s  ETA 16 min 40 s";
    EXPECT_EQ(progress_line(counts, 1000, 80), "[###############...............] " + text + "       ");
    EXPECT_EQ(progress_line(counts, 1000, 60), "[######.......] " + text + "    ");
    EXPECT_EQ(progress_line(counts, 1000, 50), text + "          ");
    EXPECT_EQ(progress_line(counts, 1000, 30), " 50.0 %  ETA 16 min 40 s     ");
    EXPECT_EQ(progress_line(counts, 1000, 12), " 50.0 %    ");
}

TEST(Progress, LinesBeginWithOneThatSaysWhatIsToDo) {
    ::testing::internal::CaptureStderr();
    { Progress(ProgressStyle::lines, 3000, 1000).add(1000); }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(),
              "peterka: 2,000 cells to compute, 1,000 already in the file\n");
}

TEST(Progress, WorkThatIsInNoFileSaysSoOfNone) {
    ::testing::internal::CaptureStderr();
    { Progress(ProgressStyle::lines, 3000, 0, {"follow", "edges", false}).add(1000); }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "peterka: 3,000 edges to follow\n");
    EXPECT_EQ(progress_text({3000, 0, 1500, "edges"}, 10), " 50.0 %  150 edges/s  ETA 10.0 s");
}

TEST(Progress, SilentIsSilent) {
    ::testing::internal::CaptureStderr();
    { Progress(ProgressStyle::silent, 3000, 1000).add(2000); }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// What an 80-column terminal shows when connected to stderr.
template <class Work>
std::string shown_on_a_terminal(const Work& work) {
    int ours = -1;
    int its = -1;
    termios raw{};
    cfmakeraw(&raw);
    const winsize size{.ws_row = 24, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
    EXPECT_EQ(openpty(&ours, &its, nullptr, &raw, &size), 0);
    std::fflush(stderr);
    const int before = dup(STDERR_FILENO);
    dup2(its, STDERR_FILENO);
    work();
    dup2(before, STDERR_FILENO);
    close(before);
    close(its);
    // The output arrives in parts, then an error, because the other end is closed.
    std::string shown;
    std::array<char, 4096> part{};
    for (ssize_t length = 0; (length = read(ours, part.data(), part.size())) > 0;) {
        shown.append(part.data(), static_cast<std::size_t>(length));
    }
    close(ours);
    return shown;
}

TEST(Progress, ABarEndsWithTheLastCountAndANewLine) {
    const std::string printed = shown_on_a_terminal([] {
        Progress progress(ProgressStyle::bar, 4, 0);
        for (int cell = 0; cell < 4; ++cell) progress.add(1);
    });
    ASSERT_NE(printed.rfind('\r'), std::string::npos) << printed;
    const std::string last = printed.substr(printed.rfind('\r'));
    EXPECT_NE(last.find("[##############################] 100.0 %"), std::string::npos) << printed;
    EXPECT_EQ(printed.back(), '\n');
    EXPECT_LT(last.size(), 82U);  // fits it
}

TEST(Progress, ABarThatNobodyWatchesIsNotThere) {
    ::testing::internal::CaptureStderr();
    { Progress(ProgressStyle::bar, 4, 0).add(4); }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace peterka
