#include "attractors/safe_kicks.hpp"

#include <cmath>

#include "regime/same_orbit.hpp"
#include "regime/stroboscopic_map.hpp"

namespace peterka::attractors {

namespace {

constexpr int phases_of_a_cycle = 48;
constexpr int longest_orbit = 8;  // for longer orbits, a neighbourhood of one point is seldom worth more
constexpr int halvings = 10;
constexpr int bisections = 3;  // within the last halving
constexpr int smaller_sizes = 6;
constexpr double of_what_was_tried = 0.5;

class Home {
  public:
    Home(KickedOrbit& orbit, const regime::AttractorTable::AttractorsOfMap& known,
         const regime::StroboscopicMap& map, const regime::CellResult& attractor)
        : orbit_(orbit), known_(known), map_(map), attractor_(attractor) {}

    // Whether kicks of this size, up and down, lead there at all phases.
    [[nodiscard]] bool takes(double size) const {
        const int phases = phases_of_a_cycle * orbit_.period();
        for (int n = 0; n < phases; ++n) {
            const double phase = static_cast<double>(n) / phases_of_a_cycle;
            if (!takes(KickTried{phase, size}) || !takes(KickTried{phase, -size})) return false;
        }
        return true;
    }

  private:
    [[nodiscard]] bool takes(const KickTried& kick) const {
        const auto state = orbit_.round(kick);
        if (!state) return false;
        const regime::CellResult* reached = known_.reached_from(map_.scaled(*state));
        return reached != nullptr && regime::same_orbit(*reached, attractor_);
    }

    KickedOrbit& orbit_;
    const regime::AttractorTable::AttractorsOfMap& known_;
    const regime::StroboscopicMap& map_;
    const regime::CellResult& attractor_;
};

}  // namespace

std::optional<double> largest_safe_kick(KickedOrbit& orbit, const regime::AttractorTable& known,
                                        scene::Oscillator<double> oscillator,
                                        const regime::FoundAttractor& found, double most) {
    oscillator.cubic = found.cubic;
    const regime::AttractorTable::AttractorsOfMap* places = known.of(oscillator, found.settings);
    if (places == nullptr || orbit.period() > longest_orbit) return std::nullopt;
    regime::CycleBroker broker;
    const regime::StroboscopicMap map(oscillator, found.settings, broker);
    const Home home(orbit, *places, map, found.result);
    const auto takes = [&](double size) {
        int n = smaller_sizes;
        while (n > 0 && home.takes(size * n / smaller_sizes)) --n;
        return n == 0;
    };
    double safe = most;
    int halved = 0;
    while (!takes(safe) && ++halved <= halvings) safe /= 2;
    if (halved > halvings) return std::nullopt;
    double beyond = 2 * safe;
    for (int n = 0; n < bisections && halved > 0; ++n) {
        const double middle = std::sqrt(safe * beyond);
        (takes(middle) ? safe : beyond) = middle;
    }
    return of_what_was_tried * safe;
}

}  // namespace peterka::attractors
