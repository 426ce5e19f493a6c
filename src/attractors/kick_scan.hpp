// Which kicks of one settled motion are tried, and the smallest of them after which it ends elsewhere.
//
// First kicks of growing size, at all phases, until one ends elsewhere; then only smaller ones, in rounds: one
// half of each spread evenly over phases and sizes, the other half near those that took longest to come back,
// and near the smallest that didn't: these lie next to the border of the basin. A kick that ends elsewhere is
// the new bound. When some rounds in a row have found none that is clearly smaller, the last one is moved along
// the border, in ever smaller steps of phase and size, to where the border comes nearest. Basins have borders
// as thin as one likes: a tongue that is thinner than the kicks lie apart may be missed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "attractors/kicked_orbit.hpp"

namespace peterka::attractors {

class KickScan {
  public:
    // What became of a kick.
    struct Way {
        bool elsewhere = false;
        std::int64_t cycles = 0;  // of its search
    };

    // period: q, in forcing cycles; largest: of the kicks tried, in A0 omega.
    KickScan(int period, double largest);

    // The next kicks, once those before have ended; none: it is done.
    [[nodiscard]] std::vector<KickTried> next(std::span<const Way> ways);

    [[nodiscard]] bool found() const { return found_; }
    // Ends elsewhere, if found().
    [[nodiscard]] const KickTried& smallest() const { return smallest_; }
    // Up to this size kicks were tried at all phases.
    [[nodiscard]] double tried() const { return found_ ? smallest_.size() : largest_; }

  private:
    enum class Stage { growing, rounds, border, done };
    struct Slow {
        KickTried kick;
        std::int64_t cycles = -1;
    };

    void take(std::span<const Way> ways);
    void choose_stage(double before);
    [[nodiscard]] std::vector<KickTried> growing();
    [[nodiscard]] std::vector<KickTried> round();
    [[nodiscard]] std::vector<KickTried> along_border();
    [[nodiscard]] KickTried spread(double least, double most);
    [[nodiscard]] KickTried near(const KickTried& kick);
    [[nodiscard]] KickTried moved(double phase, double change) const;
    [[nodiscard]] Slow& place_of(const KickTried& kick);
    [[nodiscard]] double bound() const { return found_ ? smallest_.size() : largest_; }
    double random();

    int period_;
    double largest_;
    Stage stage_ = Stage::growing;
    int level_ = 0;    // of growing sizes
    int in_vain_ = 0;  // rounds that found none that is clearly smaller
    double step_ = 0;  // along the border, relative in size
    bool found_ = false;
    KickTried smallest_;
    std::vector<KickTried> tried_;  // last
    std::vector<Slow> slow_;        // of each stretch of phases, up and down: the one that took longest
    std::uint64_t spread_ = 0;
    std::uint64_t seed_ = 0;
};

}  // namespace peterka::attractors
