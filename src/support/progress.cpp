#include "support/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "support/readable.hpp"
#include "support/tell.hpp"

namespace peterka {
namespace {

constexpr double bar_interval_seconds = 0.2;    // smooth to the eye
constexpr double line_interval_seconds = 60.0;  // a log of a long run stays readable
constexpr int bar_width = 30;

double done_share(const ProgressCounts& counts) {
    if (counts.cells <= 0) return 1.0;
    return static_cast<double>(counts.cells_done) / static_cast<double>(counts.cells);
}

}  // namespace

std::string progress_text(const ProgressCounts& counts, double seconds) {
    const std::int64_t done_now = counts.cells_done - counts.cells_before;
    // Rounded down: 100 % means that nothing is left.
    const double percent = static_cast<double>(static_cast<std::int64_t>(done_share(counts) * 1000)) / 10;
    if (done_now <= 0 || seconds <= 0) return fmt::format("{:5.1f} %", percent);

    const double rate = static_cast<double>(done_now) / seconds;
    const auto left = static_cast<double>(counts.cells - counts.cells_done);
    const std::string time =
        left > 0 ? "ETA " + readable_duration(left / rate) : "in " + readable_duration(seconds);
    return fmt::format("{:5.1f} %  {} cells/s  {}", percent, readable_count(static_cast<std::int64_t>(rate)),
                       time);
}

std::string progress_bar(const ProgressCounts& counts, int width) {
    const int filled = std::clamp(static_cast<int>(done_share(counts) * width), 0, width);
    return fmt::format("[{:#<{}}{:.<{}}]", "", filled, "", width - filled);
}

Progress::Progress(ProgressStyle style, std::int64_t cells, std::int64_t cells_before, std::string_view what)
    : style_(style), counts_{cells, cells_before, cells_before} {
    if (style_ == ProgressStyle::lines) {
        tell("peterka: {} cells to {}, {} already in the file\n", readable_count(cells - cells_before), what,
             readable_count(cells_before));
        next_print_seconds_ = line_interval_seconds;
    }
}

Progress::~Progress() {
    if (style_ != ProgressStyle::bar) return;
    print();
    std::fputc('\n', stderr);
}

void Progress::add(std::int64_t cells) {
    counts_.cells_done += cells;
    if (style_ == ProgressStyle::silent || since_start_.seconds() < next_print_seconds_) return;
    print();
    const bool bar = style_ == ProgressStyle::bar;
    next_print_seconds_ = since_start_.seconds() + (bar ? bar_interval_seconds : line_interval_seconds);
}

void Progress::print() const {
    const std::string text = progress_text(counts_, since_start_.seconds());
    if (style_ == ProgressStyle::bar) {
        // Back to the line's start, and blank out what a longer text may have left behind.
        tell("\r{} {:<45}", progress_bar(counts_, bar_width), text);
    } else {
        tell("peterka: {}\n", text);
    }
    std::fflush(stderr);
}

}  // namespace peterka
