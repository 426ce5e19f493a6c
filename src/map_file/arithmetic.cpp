#include "map_file/arithmetic.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "batch/cycle_kernel.hpp"

namespace peterka::map_file {

namespace {

constexpr const char* processor =
#if defined(__x86_64__)
    "x86-64";
#elif defined(__aarch64__)
    "aarch64";
#elif defined(__powerpc64__)
    "ppc64";
#elif defined(__riscv)
    "riscv";
#else
    "other";
#endif

// Of each function that a cell may ask the library for, at as many arguments, spread over the range where it
// is asked for. A function that is new to the core belongs here.
class LibraryResults {
  public:
    LibraryResults() {
        take([](double u) { return std::sin(200 * (u - 0.5)); });
        take([](double u) { return std::cos(200 * (u - 0.5)); });
        take([](double u) { return std::exp(80 * (u - 0.5)); });
        take([](double u) { return std::exp2(80 * (u - 0.5)); });
        take([](double u) { return std::expm1(4 * (u - 0.5)); });
        take([](double u) { return std::log(100 * u); });
        take([](double u) { return std::log2(100 * u); });
        take([](double u) { return std::log1p(4 * u); });
        take([](double u) { return std::pow(100 * u, 3 * u); });
        take([](double u) { return std::asin(2 * u - 1); });
        take([](double u) { return std::acos(2 * u - 1); });
        take([](double u) { return std::atan2(2 * u - 1, 0.3); });
        take([](double u) { return std::tanh(8 * (u - 0.5)); });
        take([](double u) { return std::hypot(3 * u, 0.7); });
        take([](double u) { return std::cbrt(100 * u); });
    }

    [[nodiscard]] std::uint32_t hash() const {
        return static_cast<std::uint32_t>(XXH3_64bits(values_.data(), values_.size() * sizeof(double)));
    }

  private:
    template <typename Function>
    void take(Function function) {
        constexpr int arguments = 16384;
        // Its multiples are spread evenly between 0 and 1. Volatile, as a compiler computes values of functions
        // that it knows beforehand by itself, and otherwise than the library.
        const volatile double golden = 0.6180339887498949;
        for (int i = 1; i <= arguments; ++i) {
            const double multiple = i * golden;
            values_.push_back(function(multiple - std::floor(multiple)));
        }
    }

    std::vector<double> values_;
};

}  // namespace

std::string arithmetic() {
    static const std::uint32_t library = LibraryResults().hash();
    return fmt::format("{}, libm {:08x}, vectors {}", processor, library, batch::arithmetic());
}

}  // namespace peterka::map_file
