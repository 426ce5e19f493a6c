// Untrusted text cannot command a terminal, whatever it contains, and stays legible.
#include "support/escape_untrusted.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace peterka {
namespace {

TEST(Harmless, LeavesPlainTextAlone) {
    for (const std::string text :
         {"Peterka map, 170 mm: Ω/ω = 2.0 (§ 3)", "日本語 🙂", "a\\b \"c\" 'd'", ""}) {
        EXPECT_EQ(escape_untrusted(text), text);
        EXPECT_EQ(escape_untrusted_page(text), text);
    }
}

TEST(Harmless, ShowsControlsAsSuch) {
    EXPECT_EQ(escape_untrusted("a\x1b[2Jb\r\a\x7f"), "a\\x1b[2Jb\\x0d\\x07\\x7f");
    EXPECT_EQ(escape_untrusted("\u009b31m"), "\\u009b31m");        // the same command as a single character
    EXPECT_EQ(escape_untrusted("abc\u202edef"), "abc\\u202edef");  // reverses the writing direction
    EXPECT_EQ(escape_untrusted(std::string("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(escape_untrusted("\U000e0041"), "\\U000e0041");
}

TEST(Harmless, ShowsWhatIsNoUtf8ByteByByte) {
    EXPECT_EQ(escape_untrusted("\x9b"
                               "31m"),
              "\\x9b31m");                                  // a control of an eight-bit terminal
    EXPECT_EQ(escape_untrusted("\xc0\x9b"), "\\xc0\\x9b");  // an overlong encoding of it
    EXPECT_EQ(escape_untrusted("\xe2\x82"), "\\xe2\\x82");  // cut off
    EXPECT_EQ(escape_untrusted("\xed\xa0\x80"), "\\xed\\xa0\\x80");
    EXPECT_EQ(escape_untrusted("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(Harmless, APieceIsOneLineAndAPageKeepsItsLines) {
    EXPECT_EQ(escape_untrusted("first\nsecond\u2028third"), "first\\x0asecond\\u2028third");
    EXPECT_EQ(escape_untrusted_page("first\nse\rcond\n"), "first\nse\\x0dcond\n");
}

TEST(Harmless, IsCutBetweenLetters) {
    EXPECT_EQ(escape_untrusted("0123456789", 10), "0123456789");
    EXPECT_EQ(escape_untrusted("0123456789a", 10), "0123456...");
    EXPECT_EQ(escape_untrusted("ΩΩΩΩΩΩ", 10), "ΩΩΩ...");
    EXPECT_EQ(escape_untrusted(std::string(100'000'000, 'x')).size(), 200U);
}

// Random bytes: the result has no control characters, is no longer than requested, and is a fixed point.
TEST(Harmless, NothingGetsThrough) {
    std::mt19937 random(1);  // NOLINT(*-msc51-cpp): the same each time
    for (int round = 0; round < 20'000; ++round) {
        std::string text;
        for (auto length = random() % 60; length > 0; --length) {
            text += static_cast<char>(random() % 3 == 0 ? 0xc2 : random() % 256);
        }
        const std::string out = escape_untrusted(text, 50);
        ASSERT_LE(out.size(), 50U);
        ASSERT_EQ(escape_untrusted(out, 50), out);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto byte = static_cast<unsigned char>(out[i]);
            ASSERT_TRUE(byte >= 0x20 && byte != 0x7f);
            const unsigned next = i + 1 < out.size() ? static_cast<unsigned char>(out[i + 1]) : 0;
            ASSERT_FALSE(byte == 0xc2 && next < 0xa0) << "a C1 control";
        }
    }
}

}  // namespace
}  // namespace peterka
