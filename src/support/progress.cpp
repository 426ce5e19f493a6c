#include "support/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <utility>

#include "support/readable.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

constexpr double bar_interval_seconds = 0.2;    // smooth to the eye
constexpr double line_interval_seconds = 60.0;  // a log of a long run stays readable
constexpr std::size_t longest_bar = 30;
constexpr std::size_t least_bar = 10;  // a shorter one tells nothing
constexpr std::size_t around_bar = 3;  // brackets and a blank
constexpr std::size_t usual_text = 43;
constexpr int longest_line = 79;

double done_share(const ProgressCounts& counts) {
    if (counts.cells <= 0) return 1.0;
    return static_cast<double>(counts.cells_done) / static_cast<double>(counts.cells);
}

struct Words {
    std::string percent;
    std::string rate = {};  // empty before the first cell, as is the time
    std::string time = {};
};

Words in_words(const ProgressCounts& counts, double seconds) {
    const std::int64_t done_now = counts.cells_done - counts.cells_before;
    // Rounded down: 100 % means that nothing is left.
    const double percent = static_cast<double>(static_cast<std::int64_t>(done_share(counts) * 1000)) / 10;
    Words words{.percent = fmt::format("{:5.1f} %", percent)};
    if (done_now <= 0 || seconds <= 0) return words;

    const double rate = static_cast<double>(done_now) / seconds;
    const auto left = static_cast<double>(counts.cells - counts.cells_done);
    words.rate = fmt::format("{} {}/s", readable_count(static_cast<std::int64_t>(rate)), counts.noun);
    words.time = left > 0 ? "ETA " + readable_duration(left / rate) : "in " + readable_duration(seconds);
    return words;
}

}  // namespace

std::string progress_text(const ProgressCounts& counts, double seconds) {
    const Words words = in_words(counts, seconds);
    return words.rate.empty() ? words.percent
                              : fmt::format("{}  {}  {}", words.percent, words.rate, words.time);
}

std::string progress_bar(const ProgressCounts& counts, int width) {
    const int filled = std::clamp(static_cast<int>(done_share(counts) * width), 0, width);
    return fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", width - filled);
}

std::string progress_line(const ProgressCounts& counts, double seconds, int columns) {
    const auto room = static_cast<std::size_t>(std::clamp(columns - 1, 1, longest_line));
    const Words words = in_words(counts, seconds);
    std::string text = progress_text(counts, seconds);
    const std::size_t left = room - std::min(room, text.size() + around_bar);  // for the bar
    if (left >= least_bar) {
        // Of constant length while the lengths of the numbers vary.
        const std::size_t steady = room - std::min(room - least_bar, usual_text + around_bar);
        const auto width = static_cast<int>(std::min({left, steady, longest_bar}));
        text = fmt::format("{} {}", progress_bar(counts, width), text);
    }
    if (text.size() > room) text = fmt::format("{}  {}", words.percent, words.time);
    if (text.size() > room) text = words.percent;
    text.resize(room, ' ');
    return text;
}

Progress::Progress(ProgressStyle style, std::int64_t cells, std::int64_t cells_before, const ProgressWork& work)
    : style_(style), counts_{cells, cells_before, cells_before, work.noun} {
    if (style_ == ProgressStyle::bar)
        if (auto terminal = Terminal::of_stderr()) terminal_.emplace(std::move(*terminal));
    if (style_ == ProgressStyle::lines) {
        const std::string kept =
            work.is_kept ? fmt::format(", {} already in the file", readable_count(cells_before)) : "";
        tell("peterka: {} {} to {}{}\n", readable_count(cells - cells_before), work.noun, work.what, kept);
        next_print_seconds_ = line_interval_seconds;
    }
}

Progress::~Progress() {
    if (style_ != ProgressStyle::bar) return;
    print();
    if (terminal_) terminal_->write("\n");
}

void Progress::add(std::int64_t cells) {
    counts_.cells_done += cells;
    if (style_ == ProgressStyle::silent || since_start_.seconds() < next_print_seconds_) return;
    print();
    const bool bar = style_ == ProgressStyle::bar;
    next_print_seconds_ = since_start_.seconds() + (bar ? bar_interval_seconds : line_interval_seconds);
}

void Progress::print() const {
    if (style_ == ProgressStyle::bar) {
        if (!terminal_) return;
        // raw: back to the line's start
        terminal_->write("\r" + progress_line(counts_, since_start_.seconds(), terminal_->columns()));
    } else {
        tell("peterka: {}\n", progress_text(counts_, since_start_.seconds()));
        std::fflush(stderr);
    }
}

}  // namespace peterka
