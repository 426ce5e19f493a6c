// Selects the kicks tried on one settled motion, and finds the smallest after which it ends elsewhere.
//
// First, kicks of growing size are tried at all phases until one ends elsewhere; then only smaller ones, in
// rounds: one half of each round is spread evenly over phases and sizes, the other half lies near the kicks
// that took longest to return and near the smallest that did not: these are next to the basin boundary. A kick
// that ends elsewhere becomes the new bound. When several consecutive rounds find none that is clearly smaller,
// the smallest kick is moved along the boundary, in decreasing steps of phase and size, to where the boundary
// comes nearest. Basins may have arbitrarily thin tongues: a tongue thinner than the spacing of the kicks may
// be missed. Where returns take long, over long-lived chaos or along a weakly attracting orbit, their total is
// limited to two million cycles per orbit: then sizes grow no further, or the last rounds are omitted.
//
// A kick that stays on chaos for as long as it is followed counts as ending elsewhere, unless the kicks that
// returned from there show that the chaos is transient: with the mean of their lifetimes, some of that many
// would stay as long.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "attractors/kicked_orbit.hpp"
#include "support/random_numbers.hpp"

namespace peterka::attractors {

class KickScan {
  public:
    // What became of a kick.
    struct Outcome {
        enum class End : std::uint8_t { back, elsewhere, chaos, unknown };
        End end = End::back;
        std::int64_t cycles = 0;   // of its search
        std::int64_t chaotic = 0;  // those of them after the start was forgotten
    };

    // period: q, in forcing cycles; largest: largest kick tried, in A0 omega.
    KickScan(int period, double largest);

    // The next kicks, once the previous ones have ended; none when the scan is done.
    [[nodiscard]] std::vector<KickTried> next(std::span<const Outcome> outcomes);

    [[nodiscard]] bool found() const { return smallest_.has_value(); }
    // The smallest kick that ends elsewhere, if found().
    [[nodiscard]] const KickTried& smallest() const { return *smallest_; }
    // The size up to which kicks were tried at all phases.
    [[nodiscard]] double tried() const;
    // The same, and the end of each smaller one is known.
    [[nodiscard]] double known() const { return unknown_ ? std::min(unknown_->size(), tried()) : tried(); }

  private:
    enum class Stage { growing, rounds, border, done };
    struct Slow {
        KickTried kick;
        std::int64_t cycles = -1;
    };

    void take(std::span<const Outcome> outcomes);
    void take_one(const KickTried& kick, const Outcome& outcome);
    [[nodiscard]] bool chaos_dies() const;
    void choose_stage(double before);
    [[nodiscard]] std::vector<KickTried> growing();
    [[nodiscard]] std::vector<KickTried> round();
    [[nodiscard]] std::vector<KickTried> along_border();
    [[nodiscard]] KickTried spread(double least, double most);
    [[nodiscard]] KickTried near(const KickTried& kick);
    [[nodiscard]] KickTried moved(double phase, double change) const;
    [[nodiscard]] Slow& place_of(const KickTried& kick);
    [[nodiscard]] const Slow& slow_one();
    [[nodiscard]] double bound() const { return smallest_ ? smallest_->size() : largest_; }
    [[nodiscard]] double largest_of_level(int level) const;

    int period_;
    double largest_;
    Stage stage_ = Stage::growing;
    int level_ = 0;                      // next level of growing sizes
    int in_vain_ = 0;                    // rounds that found no clearly smaller kick
    double step_ = 0;                    // along the border, relative in size
    std::optional<KickTried> settled_;   // smallest kick that ends on another motion
    std::optional<KickTried> chaotic_;   // smallest kick that stays on chaos
    std::optional<KickTried> smallest_;  // smallest of these that counts
    std::optional<KickTried> unknown_;   // smallest kick whose end is unknown
    bool dies_ = false;                  // chaos is transient, so kicks that stay on it do not count
    std::int64_t spent_ = 0;             // cycles of all searches
    std::int64_t stayed_ = 0;            // kicks that stayed on chaos
    std::int64_t shortest_stay_ = 0;     // [cycles]
    std::int64_t returned_ = 0;          // kicks that returned from chaos
    std::int64_t lives_ = 0;             // their total time on chaos [cycles]
    std::vector<KickTried> tried_;       // the last kicks
    std::vector<Slow> slow_;             // for each stretch of phases, up and down: the kick that took longest
    std::uint64_t spread_ = 0;
    RandomNumbers random_;
};

}  // namespace peterka::attractors
