// Part of the unit tests, and of the program, of a mutated copy: appends to the file PETERKA_REACHED which
// mutants were reached, a line of `name: numbers` for each suite and one for the whole process.
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#ifdef PETERKA_RECORD_SUITES
#include <gtest/gtest.h>
#endif

namespace {

void append(const std::string& name) {
    const char* file = std::getenv("PETERKA_REACHED");
    if (!file) return;
    std::string line = name + ":";
    for (int number = 0; number < 4096; ++number)
        if (peterka_mutant::reached[number]) line += " " + std::to_string(number);
    line += "\n";
    const int to = open(file, O_WRONLY | O_APPEND | O_CREAT, 0666);
    [[maybe_unused]] const auto written = write(to, line.data(), line.size());
    close(to);
}

#ifdef PETERKA_RECORD_SUITES
struct Recorder : testing::EmptyTestEventListener {
    void OnTestSuiteStart(const testing::TestSuite&) override {
        append("");  // what statics reached
        clear();
    }
    void OnTestSuiteEnd(const testing::TestSuite& suite) override {
        append(suite.name());
        clear();
    }
    static void clear() {
        std::fill(std::begin(peterka_mutant::reached), std::end(peterka_mutant::reached), 0);
    }
};
const bool listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new Recorder);
    return true;
}();
#else
const int registered = std::atexit([] { append("process"); });
#endif

}  // namespace
