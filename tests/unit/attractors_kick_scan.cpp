// Kicks against basins whose borders are known in closed form.
#include "attractors/kick_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace peterka::attractors {
namespace {

// The size of kick at which the basin ends, by phase; the way back grows with the logarithm of what is missing.
using Border = std::function<double(double phase, bool up)>;

struct Scanned {
    KickScan scan;
    int kicks = 0;
};

Scanned scanned(int period, double largest, const Border& border) {
    Scanned result{KickScan(period, largest)};
    std::vector<KickScan::Way> ways;
    for (auto kicks = result.scan.next({}); !kicks.empty(); kicks = result.scan.next(ways)) {
        ways.clear();
        for (const KickTried& kick : kicks) {
            EXPECT_GE(kick.phase, 0);
            EXPECT_LE(kick.phase, period);
            EXPECT_LE(kick.size(), largest);
            const double left = border(kick.phase, kick.change > 0) - kick.size();
            const double way = left > 0 ? 10 - 5 * std::log(left / largest) : 20;
            ways.push_back({left <= 0, static_cast<std::int64_t>(way)});
            ++result.kicks;
        }
    }
    return result;
}

TEST(KickScan, FindsTheWorstPhaseAndDirection) {
    const auto [scan, kicks] = scanned(2, 4, [](double phase, bool up) {
        return (up ? 1.0 : 0.7) - 0.5 * std::cos(std::numbers::pi * (phase - 1.3));
    });
    ASSERT_TRUE(scan.found());
    EXPECT_NEAR(scan.smallest().size(), 0.2, 0.0002);
    EXPECT_LT(scan.smallest().change, 0);
    EXPECT_NEAR(scan.smallest().phase, 1.3, 0.05);
    EXPECT_EQ(scan.tried(), scan.smallest().size());
    EXPECT_LT(kicks, 6000);
}

TEST(KickScan, SaysUpToWhichSizeNoneWasFound) {
    const auto [scan, kicks] = scanned(1, 4, [](double, bool) { return 5.0; });
    EXPECT_FALSE(scan.found());
    EXPECT_EQ(scan.tried(), 4);
    EXPECT_GT(kicks, 1000);
}

// A tongue that takes a fiftieth of the phases and reaches down to a fifth of the border elsewhere.
TEST(KickScan, FindsATongueThatIsWiderThanItsKicksLieApart) {
    for (int place = 0; place < 20; ++place) {
        const double tip = 0.05 * place + 0.013;
        const auto [scan, kicks] = scanned(1, 4, [&](double phase, bool up) {
            const double beside = std::abs(phase - tip) / 0.01;
            return up || beside > 1 ? 1.0 : 0.2 + 0.8 * beside;
        });
        ASSERT_TRUE(scan.found());
        EXPECT_NEAR(scan.smallest().size(), 0.2, 0.01) << place;
    }
}

TEST(KickScan, EndsCloseAboveTheBorder) {
    for (const double sharp : {0.0, 1.0, 20.0}) {  // how steep an edge the border has at its lowest point
        const auto [scan, kicks] = scanned(1, 4, [&](double phase, bool) {
            return 0.3333 * (1 + sharp * std::abs(phase - 0.41) + std::pow(phase - 0.41, 2));
        });
        ASSERT_TRUE(scan.found());
        EXPECT_GE(scan.smallest().size(), 0.3333);
        EXPECT_LT(scan.smallest().size(), 0.3333 * 1.001) << sharp;
    }
}

// Sizes grow by twos from 1/256 of the largest on, where nothing ends elsewhere, and fill each level evenly.
TEST(KickScan, BeginsWithTheSmallestSizes) {
    constexpr double largest = 256;
    KickScan scan(1, largest);
    std::vector<KickScan::Way> ways;
    for (double most = 1; most <= largest; most *= 2) {
        const std::vector<KickTried> kicks = scan.next(ways);
        const double least = most == 1 ? 0 : most / 2;
        ASSERT_EQ(kicks.size(), 32U);
        for (int part = 0; part < 8; ++part) {
            const double from = least + (most - least) * part / 8;
            const double to = least + (most - least) * (part + 1) / 8;
            const auto inside = std::ranges::count_if(
                kicks, [&](const KickTried& kick) { return kick.size() >= from && kick.size() < to; });
            EXPECT_GE(inside, 2) << most << ", part " << part;
        }
        EXPECT_EQ(std::ranges::count_if(kicks, [](const KickTried& kick) { return kick.change > 0; }), 16)
            << most;
        ways.assign(kicks.size(), {.elsewhere = false, .cycles = 5});
    }
    EXPECT_GT(scan.next(ways).size(), 32U);  // rounds
}

TEST(KickScan, TriesTheSameKicksEachTime) {
    const Border border = [](double phase, bool) { return 0.5 + 0.1 * phase; };
    const auto one = scanned(3, 4, border);
    const auto other = scanned(3, 4, border);
    EXPECT_EQ(one.kicks, other.kicks);
    EXPECT_EQ(one.scan.smallest().change, other.scan.smallest().change);
    EXPECT_EQ(one.scan.smallest().phase, other.scan.smallest().phase);
}

}  // namespace
}  // namespace peterka::attractors
