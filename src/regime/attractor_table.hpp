// The attractors that are known before a basin is computed, or before a start of a map's cell: any start that
// falls into the neighbourhood of one of them, or is seen to converge to its orbit, takes its values.
//
// They are what some starts, run in full, ended on. Which of them a table keeps, and how far their
// neighbourhoods reach, follows from these alone and their order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "regime/cell_result.hpp"
#include "regime/cubic_shift.hpp"
#include "regime/engine.hpp"
#include "regime/known_orbit.hpp"
#include "regime/neighbourhood.hpp"
#include "scene/oscillator.hpp"

namespace peterka::regime {

// What a search found, and on which map: with or without the cubic spring, by which engine.
struct FoundAttractor {
    double cubic;
    EngineSettings settings;
    CellResult result;
    std::optional<CubicShift> by_cubic = {};  // of an orbit without the cubic spring, once it was looked at
};

class AttractorTable {
  public:
    // Those of one map.
    class AttractorsOfMap {
      public:
        // The attractor to which a state at forcing phase 0 surely leads; nullptr where none is known.
        [[nodiscard]] const CellResult* reached_from(const Point& state) const {
            for (const Place& place : places_) {
                if (place.neighbourhood.contains(state)) return &place.attractor;
            }
            return nullptr;
        }
        // An orbit with a period that divides q near a state at forcing phase 0, seen from there.
        struct Near {
            PeriodicOrbit orbit;
            const CellResult* attractor;
        };
        [[nodiscard]] std::optional<Near> orbit_near(const Point& state, std::int64_t q) const;
        // What the cubic spring does to the attractor whose values a search took; nothing where that isn't
        // known.
        [[nodiscard]] std::optional<CubicShift> shift_of(const CellResult& taken) const;

      private:
        friend class AttractorTable;
        AttractorsOfMap(double cubic, const EngineSettings& settings) : cubic_(cubic), settings_(settings) {}
        [[nodiscard]] bool is_of(const scene::Oscillator<double>& oscillator,
                                 const EngineSettings& settings) const;

        struct Place {
            Neighbourhood neighbourhood;
            CellResult attractor;
        };
        struct Orbit {
            KnownOrbit orbit;
            CellResult attractor;
            std::optional<CubicShift> by_cubic;
        };
        double cubic_;
        EngineSettings settings_;
        std::vector<Place> places_;
        std::vector<Orbit> orbits_;
    };

    // None is known.
    AttractorTable() = default;

    // rig: the oscillator of all starts. cells_each: for how many starts one of `found` stands; where few take
    // an attractor's values, proving a neighbourhood would cost more than it saves.
    AttractorTable(const scene::Oscillator<double>& rig, std::span<const FoundAttractor> found,
                   double cells_each);

    // One more, on the oscillator of its map, with neighbourhoods that find_places proved.
    void add(const scene::Oscillator<double>& oscillator, const FoundAttractor& found,
             std::span<const Neighbourhood> places);

    // The same with the orbit itself.
    void add(const scene::Oscillator<double>& oscillator, const FoundAttractor& found, KnownOrbit orbit);

    // nullptr where none of this map is known.
    [[nodiscard]] const AttractorsOfMap* of(const scene::Oscillator<double>& oscillator,
                                            const EngineSettings& settings) const;

  private:
    AttractorsOfMap& map_of(const scene::Oscillator<double>& oscillator, const EngineSettings& settings);

    std::vector<AttractorsOfMap> maps_;
};

// Whether both settings make the same map of an oscillator.
[[nodiscard]] bool same_map(const scene::Oscillator<double>& oscillator, const EngineSettings& a,
                            const EngineSettings& b);

struct Places {
    std::vector<Neighbourhood> neighbourhoods;
    std::int64_t cycles = 0;  // spent on them
};

// Of so many points of an attractor that has an orbit. oscillator: of its map, with or without the cubic
// spring.
[[nodiscard]] Task<Places> find_places(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                       FoundAttractor found, std::int64_t count);

// The orbit of an attractor that has one; the cycles spent on it go to `spent`.
[[nodiscard]] Task<std::optional<KnownOrbit>> find_known_orbit(CycleBroker& broker,
                                                               scene::Oscillator<double> oscillator,
                                                               FoundAttractor found, std::int64_t* spent);

// For a search: which attractors it knows beforehand, and where it leaves what it finds.
struct SearchContext {
    const AttractorTable* known = nullptr;         // nullptr: none
    std::vector<FoundAttractor>* found = nullptr;  // nullptr: nobody asks
    // Chaos is known, too: a motion that has forgotten its start, and isn't settled after so many cycles, is
    // on it.
    bool chaos = false;
    static constexpr std::int64_t cycles_to_settle = 75;
};

}  // namespace peterka::regime
