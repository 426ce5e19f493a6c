#include "support/stop_request.hpp"

#include <fmt/format.h>

#include <array>
#include <csignal>

namespace peterka {
namespace {

constexpr std::array caught_signals{SIGINT, SIGTERM, SIGUSR1};

volatile std::sig_atomic_t received_signal = 0;

extern "C" void remember_signal(int signal) {
    received_signal = signal;
}

const char* signal_name(int signal) {
    if (signal == SIGINT) return "SIGINT";
    if (signal == SIGTERM) return "SIGTERM";
    return "SIGUSR1";
}

}  // namespace

StopRequest::StopRequest(double max_wall_seconds) : max_wall_seconds_(max_wall_seconds) {
    received_signal = 0;
    for (const int signal : caught_signals) {
        struct sigaction action {};
        action.sa_handler = remember_signal;
        action.sa_flags = SA_RESTART;  // a write to the file must not be cut short
        if (signal == SIGINT) action.sa_flags |= static_cast<int>(SA_RESETHAND);
        sigaction(signal, &action, nullptr);
    }
}

StopRequest::~StopRequest() {
    for (const int signal : caught_signals) std::signal(signal, SIG_DFL);
}

bool StopRequest::requested() const {
    return received_signal != 0 || since_start_.seconds() >= max_wall_seconds_;
}

std::string StopRequest::reason() const {
    if (received_signal != 0) return fmt::format("signal {}", signal_name(received_signal));
    if (since_start_.seconds() >= max_wall_seconds_) {
        return fmt::format("--max-wall {:g} s is over", max_wall_seconds_);
    }
    return "another rank was asked to stop";
}

}  // namespace peterka
