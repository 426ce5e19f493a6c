// Signals and the clock request a stop; nothing else happens.
#include "support/stop_request.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace peterka {
namespace {

TEST(StopRequest, NobodyAsks) {
    const StopRequest stop;
    EXPECT_FALSE(stop.requested());
}

TEST(StopRequest, EachSignalAsksAndIsNamed) {
    const std::pair<int, const char*> signals[] = {
        {SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGUSR1, "SIGUSR1"}};
    for (const auto& [signal, name] : signals) {
        const StopRequest stop;
        EXPECT_FALSE(stop.requested()) << "an earlier signal is forgotten";
        std::raise(signal);
        EXPECT_TRUE(stop.requested());
        EXPECT_NE(stop.reason().find(name), std::string::npos) << stop.reason();
    }
}

TEST(StopRequest, ASecondInterruptEndsTheProcess) {
    EXPECT_EXIT(
        {
            const StopRequest stop;
            std::raise(SIGINT);
            std::raise(SIGINT);
        },
        ::testing::KilledBySignal(SIGINT), "");
}

TEST(StopRequest, ASecondTerminateStillOnlyAsks) {
    const StopRequest stop;
    std::raise(SIGTERM);
    std::raise(SIGTERM);
    EXPECT_TRUE(stop.requested());
}

TEST(StopRequest, SignalsAreLeftAloneAfterwards) {
    EXPECT_EXIT(
        {
            { const StopRequest stop; }
            std::raise(SIGUSR1);
        },
        ::testing::KilledBySignal(SIGUSR1), "");
}

TEST(StopRequest, TimeThatIsUpAsks) {
    EXPECT_TRUE(StopRequest(0.0).requested());
    EXPECT_FALSE(StopRequest(1e9).requested());
    EXPECT_NE(StopRequest(0.0).reason().find("--max-wall"), std::string::npos);
}

}  // namespace
}  // namespace peterka
