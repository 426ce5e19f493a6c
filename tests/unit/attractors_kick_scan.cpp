// Kicks against basins whose boundaries are known in closed form.
#include "attractors/kick_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace peterka::attractors {
namespace {

using End = KickScan::Outcome::End;
using Outcomes = std::function<KickScan::Outcome(const KickTried& kick)>;

struct Scanned {
    KickScan scan;
    int kicks = 0;
};

Scanned scanned_outcomes(int period, double largest, const Outcomes& outcome_of) {
    Scanned result{KickScan(period, largest)};
    std::vector<KickScan::Outcome> outcomes;
    for (auto kicks = result.scan.next({}); !kicks.empty(); kicks = result.scan.next(outcomes)) {
        outcomes.clear();
        for (const KickTried& kick : kicks) {
            EXPECT_GE(kick.phase, 0);
            EXPECT_LE(kick.phase, period);
            EXPECT_LE(kick.size(), largest);
            outcomes.push_back(outcome_of(kick));
            ++result.kicks;
        }
    }
    return result;
}

// The critical kick size by phase; the return time grows with the logarithm of the distance to the boundary.
using Border = std::function<double(double phase, bool up)>;

Scanned scanned(int period, double largest, const Border& border) {
    return scanned_outcomes(period, largest, [&](const KickTried& kick) {
        const double left = border(kick.phase, kick.change > 0) - kick.size();
        const double way = left > 0 ? 10 - 5 * std::log(left / largest) : 20;
        return KickScan::Outcome{left > 0 ? End::back : End::elsewhere, static_cast<std::int64_t>(way)};
    });
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

// A tongue over one fiftieth of the phases that reaches down to a fifth of the boundary elsewhere.
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
    for (const double sharp : {0.0, 1.0, 20.0}) {  // sharpness of the boundary's minimum
        const auto [scan, kicks] = scanned(1, 4, [&](double phase, bool) {
            return 0.3333 * (1 + sharp * std::abs(phase - 0.41) + std::pow(phase - 0.41, 2));
        });
        ASSERT_TRUE(scan.found());
        EXPECT_GE(scan.smallest().size(), 0.3333);
        EXPECT_LT(scan.smallest().size(), 0.3333 * 1.001) << sharp;
    }
}

// A pseudo-random fraction for a kick.
double chance_of(const KickTried& kick) {
    const double mixed = std::sin(kick.phase * 12.9898 + kick.change * 78.233) * 43758.5453;
    return mixed - std::floor(mixed);
}

// Kicks above `border` reach a chaotic transient with this mean life in cycles, and are followed for 1,000.
KickScan::Outcome outcome_over_chaos(const KickTried& kick, double border, double mean) {
    if (kick.size() < border) return {End::back, 10};
    const double life = -mean * std::log(1 - chance_of(kick));
    const auto chaotic = static_cast<std::int64_t>(std::min(life, 1000.0)) + 1;
    return {life < 1000 ? End::back : End::chaos, 30 + chaotic, chaotic};
}

// One of some hundreds remains chaotic for as long as it is followed.
TEST(KickScan, CountsNoChaosThatDies) {
    for (const double mean : {150.0, 200.0, 400.0}) {
        const auto [scan, kicks] = scanned_outcomes(1, 4, [&](const KickTried& kick) {
            return kick.size() > 3 ? KickScan::Outcome{End::elsewhere, 20}
                                   : outcome_over_chaos(kick, 0.5, mean);
        });
        ASSERT_TRUE(scan.found()) << mean;
        EXPECT_NEAR(scan.smallest().size(), 3, 0.003) << mean;
    }
    const auto [alone, kicks] =
        scanned_outcomes(1, 4, [](const KickTried& kick) { return outcome_over_chaos(kick, 0.5, 150); });
    EXPECT_FALSE(alone.found());
    EXPECT_EQ(alone.tried(), 4);
}

// Chaos is judged by its shortest stay, here the first of two in one round: others are followed for longer.
TEST(KickScan, JudgesChaosByItsShortestStay) {
    int wandering = 0;
    const auto [scan, kicks] = scanned_outcomes(1, 4, [&](const KickTried& kick) {
        if (kick.size() < 0.5) return KickScan::Outcome{End::back, 10};
        const int number = wandering++;
        const bool stays = number == 10 || number % 100 == 12;
        if (!stays) return KickScan::Outcome{End::back, 180, 150};
        const std::int64_t followed = number == 10 ? 200 : 5000;
        return KickScan::Outcome{End::chaos, 30 + followed, followed};
    });
    ASSERT_GT(wandering, 200);
    EXPECT_FALSE(scan.found());
}

// Below the basin boundary some kicks also wander for a while before they return.
TEST(KickScan, CountsChaosThatLasts) {
    const auto [scan, kicks] = scanned_outcomes(1, 4, [](const KickTried& kick) {
        const bool wanders = chance_of(kick) < 0.05;
        if (kick.size() > 0.8) return KickScan::Outcome{End::chaos, 1000, 950};
        return KickScan::Outcome{End::back, wanders ? 60 : 10, wanders ? 15 : 0};
    });
    ASSERT_TRUE(scan.found());
    EXPECT_NEAR(scan.smallest().size(), 0.8, 0.001);
}

// Sizes double from 1/256 of the largest, where nothing ends elsewhere, and fill each level evenly.
TEST(KickScan, BeginsWithTheSmallestSizes) {
    constexpr double largest = 256;
    KickScan scan(1, largest);
    std::vector<KickScan::Outcome> outcomes;
    for (double most = 1; most <= largest; most *= 2) {
        const std::vector<KickTried> kicks = scan.next(outcomes);
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
        outcomes.assign(kicks.size(), {.end = End::back, .cycles = 5});
    }
    EXPECT_GT(scan.next(outcomes).size(), 32U);  // rounds
}

// Two million cycles, plus those already begun.
TEST(KickScan, EndsWhereWaysBackAreLong) {
    const auto [far, kicks_far] = scanned_outcomes(16, 256, [](const KickTried&) {
        return KickScan::Outcome{End::back, 2500};
    });
    EXPECT_FALSE(far.found());
    EXPECT_EQ(kicks_far, 2 * 32 * 16);
    EXPECT_EQ(far.tried(), 2);  // the second level

    const auto [near, kicks_near] = scanned_outcomes(16, 256, [](const KickTried& kick) {
        const double border = 1.2 + std::abs(kick.phase - 8);
        return KickScan::Outcome{kick.size() < border ? End::back : End::elsewhere, 2500};
    });
    ASSERT_TRUE(near.found());
    EXPECT_NEAR(near.smallest().size(), 1.2, 0.001);  // still along the boundary
    EXPECT_EQ(near.tried(), near.smallest().size());
    EXPECT_LT(kicks_near, 2 * 32 * 16 + 40 * 32);
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
