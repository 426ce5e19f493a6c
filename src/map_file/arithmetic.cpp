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

// Results of each library function that a cell may call, at equally many arguments, spread over the range in
// which it is called. A function that is new to the core belongs here.
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
        // Its multiples modulo 1 are spread evenly (a Weyl sequence). Volatile, as a compiler evaluates
        // functions that it knows at compile time, and with other results than the library.
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
