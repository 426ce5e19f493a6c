// Included before every file of a mutated copy of the sources (try_mutants.py). Each place of a mutant asks
// `is(number)`, which notes that it was reached, and takes the mutated way where the environment's
// PETERKA_MUTANT is that number.
#pragma once
#if __cplusplus >= 202002L  // not where CMake tries the compiler

#include <algorithm>
#include <cstdlib>
#include <type_traits>

namespace peterka_mutant {

inline const int active = std::getenv("PETERKA_MUTANT") ? std::atoi(std::getenv("PETERKA_MUTANT")) : 0;
inline unsigned char reached[4096] = {};  // by number

inline bool is(int number) {
    reached[number] = 1;
    return number == active;
}

// In constexpr functions: what the compiler evaluates has no mutants.
constexpr bool is_in_constexpr(int number) {
    return std::is_constant_evaluated() ? false : is(number);
}

template <int number, bool in_constexpr>
constexpr bool asked() {
    if constexpr (in_constexpr)
        return is_in_constexpr(number);
    else
        return is(number);
}

// `l < Less<17, false>{} > r` is `l < r`, or its mutant, whose first operand keeps its place in the order of
// operators.
#define PETERKA_INFIX(Name, first, second, mutated)                                                        \
    template <int number, bool in_constexpr>                                                               \
    struct Name {};                                                                                        \
    template <int number, bool in_constexpr, class L>                                                      \
    struct Left##Name {                                                                                    \
        const L& l;                                                                                        \
    };                                                                                                     \
    template <int number, bool in_constexpr, class L>                                                      \
    constexpr Left##Name<number, in_constexpr, L> operator first(const L& l, Name<number, in_constexpr>) { \
        return {l};                                                                                        \
    }                                                                                                      \
    template <int number, bool in_constexpr, class L, class R>                                             \
    constexpr auto operator second(Left##Name<number, in_constexpr, L> left, const R& r) {                 \
        if constexpr (requires { (left.l first r).eval(); }) { /* Eigen's expressions */                   \
            auto out = (left.l first r).eval();                                                            \
            if (asked<number, in_constexpr>()) out = left.l mutated r;                                     \
            return out;                                                                                    \
        } else {                                                                                           \
            using Out = std::decay_t<decltype(left.l first r)>;                                            \
            return asked<number, in_constexpr>() ? static_cast<Out>(left.l mutated r)                      \
                                                 : static_cast<Out>(left.l first r);                       \
        }                                                                                                  \
    }
PETERKA_INFIX(Less, <, >, <=)
PETERKA_INFIX(LessEqual, <=, >=, <)
PETERKA_INFIX(Greater, >, <, >=)
PETERKA_INFIX(GreaterEqual, >=, <=, >)
PETERKA_INFIX(Equal, ==, ==, !=)
PETERKA_INFIX(NotEqual, !=, !=, ==)
PETERKA_INFIX(Plus, +, +, -)
PETERKA_INFIX(Minus, -, -, +)
PETERKA_INFIX(Times, *, *, /)
PETERKA_INFIX(Over, /, /, *)
#undef PETERKA_INFIX

template <int number, bool in_constexpr, bool is_min, class T>
constexpr T bound(const T& a, const T& b) {
    return is_min != asked<number, in_constexpr>() ? std::min(a, b) : std::max(a, b);
}

}  // namespace peterka_mutant

#endif
