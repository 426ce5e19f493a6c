// Numbers formatted for readers.
#include "support/readable.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace peterka {
namespace {

TEST(Readable, CountsHaveSeparators) {
    EXPECT_EQ(readable_count(0), "0");
    EXPECT_EQ(readable_count(999), "999");
    EXPECT_EQ(readable_count(1000), "1,000");
    EXPECT_EQ(readable_count(1234567), "1,234,567");
    EXPECT_EQ(readable_count(-123456), "-123,456");
    EXPECT_EQ(readable_count(std::numeric_limits<std::int64_t>::max()), "9,223,372,036,854,775,807");
}

TEST(Readable, MeansHaveADecimalOrSeparators) {
    EXPECT_EQ(readable_mean(0), "0.0");
    EXPECT_EQ(readable_mean(25.04), "25.0");
    EXPECT_EQ(readable_mean(999.94), "999.9");
    EXPECT_EQ(readable_mean(999.96), "1,000");
    EXPECT_EQ(readable_mean(107080.2), "107,080");
}

TEST(Readable, DurationsChangeUnitAtTheRightPlace) {
    EXPECT_EQ(readable_duration(12.34e-6), "12.3 us");
    EXPECT_EQ(readable_duration(0.0123), "12.3 ms");
    EXPECT_EQ(readable_duration(1), "1.0 s");
    EXPECT_EQ(readable_duration(1.25), "1.2 s");
    EXPECT_EQ(readable_duration(59.96), "1 min 0 s");  // never "60.0 s"
    EXPECT_EQ(readable_duration(3725), "1 h 2 min");
    EXPECT_EQ(readable_duration(50 * 3600.0), "2 days 2 h");
}

TEST(Readable, ADurationThatIsNoneIsUnknown) {
    EXPECT_EQ(readable_duration(-1), "unknown");
    EXPECT_EQ(readable_duration(std::numeric_limits<double>::quiet_NaN()), "unknown");
    EXPECT_EQ(readable_duration(std::numeric_limits<double>::infinity()), "unknown");
    EXPECT_EQ(readable_duration(1.1e15), "ages");
    EXPECT_EQ(readable_duration(1e300), "ages");
}

TEST(Readable, BytesInPowersOfAThousand) {
    EXPECT_EQ(readable_bytes(0), "0 bytes");
    EXPECT_EQ(readable_bytes(999), "999 bytes");
    EXPECT_EQ(readable_bytes(1000), "1.0 kB");
    EXPECT_EQ(readable_bytes(999'960), "1.0 MB");  // never "1000.0 kB"
    EXPECT_EQ(readable_bytes(15'000'000'000'000), "15.0 TB");
    EXPECT_EQ(readable_bytes(std::numeric_limits<std::int64_t>::max()), "9.2 EB");
}

TEST(Readable, NamesAsAShellReadsThem) {
    EXPECT_EQ(shell_word("maps/a_1.h5"), "maps/a_1.h5");
    EXPECT_EQ(shell_word("my map.h5"), "'my map.h5'");
    EXPECT_EQ(shell_word("it's.h5"), "'it'\\''s.h5'");
    EXPECT_EQ(shell_word(""), "''");
}

TEST(Readable, AmountsHaveThePrefixThatKeepsThemBetweenOneAndAThousand) {
    EXPECT_EQ(readable_amount(2714.2, "N"), "2.714 kN");
    EXPECT_EQ(readable_amount(2714.2, "N", 3), "2.71 kN");
    EXPECT_EQ(readable_amount(375.14, "N"), "375.1 N");
    EXPECT_EQ(readable_amount(999.94, "N"), "999.9 N");
    EXPECT_EQ(readable_amount(999.96, "N"), "1 kN");  // never "1000 N"
    EXPECT_EQ(readable_amount(0.0123, "N"), "12.3 mN");
    EXPECT_EQ(readable_amount(-1.5e7, "N"), "-15 MN");
    EXPECT_EQ(readable_amount(0, "N"), "0 N");
    EXPECT_EQ(readable_amount(1e-12, "N"), "0.001 nN");
    EXPECT_EQ(readable_amount(3e17, "N"), "3e+05 TN");
    EXPECT_EQ(readable_amount(std::numeric_limits<double>::quiet_NaN(), "N"), "nan N");
}

TEST(Readable, SharesOfNothingAreNothing) {
    EXPECT_EQ(readable_share(1, 3), "33.3 %");
    EXPECT_EQ(readable_share(0, 0), "0.0 %");
}

TEST(Readable, ASmallShareIsNotNoneAndALargeOneNotAll) {
    EXPECT_EQ(readable_share(0, 10'000), "0.0 %");
    EXPECT_EQ(readable_share(4, 10'000), "< 0.05 %");
    EXPECT_EQ(readable_share(5, 10'000), "0.1 %");
    EXPECT_EQ(readable_share(9994, 10'000), "99.9 %");
    EXPECT_EQ(readable_share(9995, 10'000), "> 99.95 %");
    EXPECT_EQ(readable_share(10'000, 10'000), "100.0 %");
}

}  // namespace
}  // namespace peterka
