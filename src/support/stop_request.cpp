#include "support/stop_request.hpp"

#include <fmt/format.h>

#include <sys/types.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <string>

namespace peterka {
namespace {

constexpr std::array caught_signals{SIGINT, SIGTERM, SIGUSR1};

static_assert(sizeof(pid_t) <= sizeof(std::sig_atomic_t));
volatile std::sig_atomic_t received_signal = 0;
volatile std::sig_atomic_t sender = 0;  // its process number, 0 for none
const StopRequest* request_in_force = nullptr;

extern "C" void remember_signal(int signal, siginfo_t* info, void* /*context*/) {
    received_signal = signal;
    sender = info->si_code == SI_USER ? info->si_pid : 0;  // a terminal's Ctrl-C comes from the kernel
}

// Open MPI turns a signal that it receives into a SIGTERM to its ranks.
std::string sender_in_words() {
    std::string name;
    std::getline(std::ifstream(fmt::format("/proc/{}/comm", sender)), name);  // empty if the process is gone
    constexpr std::array launchers{"mpirun", "mpiexec", "orterun", "orted"};
    if (received_signal == SIGUSR1 || std::ranges::find(launchers, name) == launchers.end()) return "";
    return fmt::format(
        " from {}, which sends it upon Ctrl-C, too, and ends with its own exit code instead of 5", name);
}

const char* signal_name(int signal) {
    if (signal == SIGINT) return "SIGINT";
    if (signal == SIGTERM) return "SIGTERM";
    return "SIGUSR1";
}

}  // namespace

StopRequest::StopRequest(double max_wall_seconds) : max_wall_seconds_(max_wall_seconds) {
    received_signal = 0;
    sender = 0;
    request_in_force = this;
    for (const int signal : caught_signals) {
        struct sigaction action {};
        action.sa_sigaction = remember_signal;
        action.sa_flags = SA_SIGINFO | SA_RESTART;  // a write to the file must not be cut short
        if (signal == SIGINT) action.sa_flags |= static_cast<int>(SA_RESETHAND);
        sigaction(signal, &action, nullptr);
    }
}

StopRequest::~StopRequest() {
    request_in_force = nullptr;
    for (const int signal : caught_signals) std::signal(signal, SIG_DFL);
}

const StopRequest* StopRequest::in_force() {
    return request_in_force;
}

void look_for_stop_request() {
    if (request_in_force != nullptr && request_in_force->requested()) throw Stopped();
}

bool StopRequest::requested() const {
    return received_signal != 0 || since_start_.seconds() >= max_wall_seconds_;
}

std::string StopRequest::reason() const {
    if (received_signal != 0)
        return fmt::format("signal {}{}", signal_name(received_signal), sender_in_words());
    if (since_start_.seconds() >= max_wall_seconds_) {
        return fmt::format("--max-wall {:g} s is over", max_wall_seconds_);
    }
    return "another rank was asked to stop";
}

}  // namespace peterka
