// Which kicks of one settled motion are tried, and the smallest of them after which it ends elsewhere.
//
// First kicks of growing size, at all phases, until one ends elsewhere; then only smaller ones, in rounds: one
// half of each spread evenly over phases and sizes, the other half near those that took longest to come back,
// and near the smallest that didn't: these lie next to the border of the basin. A kick that ends elsewhere is
// the new bound. When some rounds in a row have found none that is clearly smaller, the last one is moved along
// the border, in ever smaller steps of phase and size, to where the border comes nearest. Basins have borders
// as thin as one likes: a tongue that is thinner than the kicks lie apart may be missed. Where ways back are
// long, over a chaos that dies late or along an orbit that hardly attracts, their sum has a limit, two million
// cycles for each orbit: then sizes grow no further, or the last rounds are left out.
//
// A kick that is on chaos for as long as it is followed counts as one that ends elsewhere, but not where those
// that came back from there show that it dies: where, with the mean of their lives, some of so many would stay
// for as long.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "attractors/kicked_orbit.hpp"

namespace peterka::attractors {

class KickScan {
  public:
    // What became of a kick.
    struct Outcome {
        enum class End : std::uint8_t { back, elsewhere, chaos };
        End end = End::back;
        std::int64_t cycles = 0;   // of its search
        std::int64_t chaotic = 0;  // of these, those after it had forgotten its start
    };

    // period: q, in forcing cycles; largest: of the kicks tried, in A0 omega.
    KickScan(int period, double largest);

    // The next kicks, once those before have ended; none: it is done.
    [[nodiscard]] std::vector<KickTried> next(std::span<const Outcome> outcomes);

    [[nodiscard]] bool found() const { return smallest_.has_value(); }
    // Ends elsewhere, if found().
    [[nodiscard]] const KickTried& smallest() const { return *smallest_; }
    // Up to this size kicks were tried at all phases.
    [[nodiscard]] double tried() const;

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
    double random();

    int period_;
    double largest_;
    Stage stage_ = Stage::growing;
    int level_ = 0;                      // of growing sizes: the next one
    int in_vain_ = 0;                    // rounds that found none that is clearly smaller
    double step_ = 0;                    // along the border, relative in size
    std::optional<KickTried> settled_;   // the smallest that ends on another motion
    std::optional<KickTried> chaotic_;   // the smallest that stays on chaos
    std::optional<KickTried> smallest_;  // of these, as far as they count
    bool dies_ = false;                  // chaos, so that kicks that stay on it don't count
    std::int64_t spent_ = 0;             // by all searches [cycles]
    std::int64_t stayed_ = 0;            // on chaos
    std::int64_t shortest_stay_ = 0;     // [cycles]
    std::int64_t returned_ = 0;          // from chaos
    std::int64_t lives_ = 0;             // of those together [cycles]
    std::vector<KickTried> tried_;       // last
    std::vector<Slow> slow_;             // of each stretch of phases, up and down: the one that took longest
    std::uint64_t spread_ = 0;
    std::uint64_t seed_ = 0;
};

}  // namespace peterka::attractors
