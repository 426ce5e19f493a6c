// Progress of a run: a bar on a terminal, otherwise one plain line at the start and then about one a minute. On
// stderr.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "support/stopwatch.hpp"
#include "support/terminal.hpp"

namespace peterka {

enum class ProgressStyle { silent, lines, bar };

struct ProgressCounts {
    std::int64_t cells = 0;         // of the whole map
    std::int64_t cells_before = 0;  // already in the file when this run began
    std::int64_t cells_done = 0;    // including those before
    std::string_view noun = "cells";
};

// The work: "12 cells to compute, 3 already in the file".
struct ProgressWork {
    std::string_view what = "compute";
    std::string_view noun = "cells";
    bool is_kept = true;  // what is done is in a file, from which another run goes on
};

// "12.3 % 5,432 cells/s ETA 1 min 12 s"; the rate counts this run alone. At the end the time
// taken instead of the time left.
[[nodiscard]] std::string progress_text(const ProgressCounts& counts, double seconds);

// "[#####.....]"
[[nodiscard]] std::string progress_bar(const ProgressCounts& counts, int width);

// Both, on a terminal of this many columns: at most one less, for a full line would wrap. If they do not fit,
// the bar is shortened, then omitted, then the rate. Padded with blanks to overwrite a longer line.
[[nodiscard]] std::string progress_line(const ProgressCounts& counts, double seconds, int columns);

class Progress {
  public:
    Progress(ProgressStyle style, std::int64_t cells, std::int64_t cells_before, const ProgressWork& work = {});
    ~Progress();  // ends the bar's line
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void add(std::int64_t cells);

  private:
    void print() const;

    ProgressStyle style_;
    std::optional<Terminal> terminal_;  // of the bar
    ProgressCounts counts_;
    Stopwatch since_start_;
    double next_print_seconds_ = 0;
};

}  // namespace peterka
