// Whether this process has been asked to stop: by SIGINT, SIGTERM, SIGUSR1, or because its time is up.
//
// The signals only set a flag; computations check it between two cells, and within a cycle that may take long.
// A second SIGINT (Ctrl-C) ends the process at once, as by default.
#pragma once

#include <limits>
#include <string>

#include "support/stop_if_asked.hpp"
#include "support/stopwatch.hpp"

namespace peterka {

class StopRequest {
  public:
    // Catches the signals until destroyed; `max_wall_seconds` counts from here.
    explicit StopRequest(double max_wall_seconds = std::numeric_limits<double>::infinity());
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    [[nodiscard]] bool requested() const;
    [[nodiscard]] std::string reason() const;  // "signal SIGUSR1", "--max-wall 60 s is over"

    // The existing one, or nullptr.
    [[nodiscard]] static const StopRequest* in_force();

  private:
    double max_wall_seconds_;
    Stopwatch since_start_;
};

}  // namespace peterka
