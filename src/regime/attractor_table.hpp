// The attractors known before a basin, or a start in a map's cell, is computed: a start that enters the
// neighbourhood of one of them, or is seen to converge to its orbit, takes its values.
//
// They are the attractors on which some starts, run in full, ended. Which of them a table keeps, and how far
// their neighbourhoods reach, depends on these results and their order alone.
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

// The result of a search, and the map it belongs to: with or without the cubic spring, and the engine.
struct FoundAttractor {
    double cubic;
    EngineSettings settings;
    CellResult result;
    std::optional<CubicShift> by_cubic = {};  // for an orbit without the cubic spring, once computed
};

class AttractorTable {
  public:
    // The attractors of one map.
    class AttractorsOfMap {
      public:
        // The attractor to which a state at forcing phase 0 certainly leads; nullptr if none is known.
        [[nodiscard]] const CellResult* reached_from(const Point& state) const {
            for (const Place& place : places_) {
                if (place.neighbourhood.contains(state)) return &place.attractor;
            }
            return nullptr;
        }
        // A known orbit near a state at forcing phase 0 with a period that divides q, its nearest point first.
        struct Near {
            PeriodicOrbit orbit;
            const CellResult* attractor;
        };
        [[nodiscard]] std::optional<Near> orbit_near(const Point& state, std::int64_t q) const;
        // The effect of the cubic spring on the attractor whose values a search took; nothing if unknown.
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

    // No attractor is known.
    AttractorTable() = default;

    // rig: the oscillator of all starts. cells_each: number of starts that each of `found` represents; if few
    // take an attractor's values, proving a neighbourhood costs more than it saves.
    AttractorTable(const scene::Oscillator<double>& rig, std::span<const FoundAttractor> found,
                   double cells_each);

    // Adds an attractor with the neighbourhoods that find_places proved. oscillator: that of its map.
    void add(const scene::Oscillator<double>& oscillator, const FoundAttractor& found,
             std::span<const Neighbourhood> places);

    // Adds an attractor with its orbit.
    void add(const scene::Oscillator<double>& oscillator, const FoundAttractor& found, KnownOrbit orbit);

    // The attractors of one map; nullptr if none is known.
    [[nodiscard]] const AttractorsOfMap* of(const scene::Oscillator<double>& oscillator,
                                            const EngineSettings& settings) const;

  private:
    AttractorsOfMap& map_of(const scene::Oscillator<double>& oscillator, const EngineSettings& settings);

    std::vector<AttractorsOfMap> maps_;
};

// Whether both settings give the same map for an oscillator.
[[nodiscard]] bool same_map(const scene::Oscillator<double>& oscillator, const EngineSettings& a,
                            const EngineSettings& b);

struct Places {
    std::vector<Neighbourhood> neighbourhoods;
    std::int64_t cycles = 0;  // spent on them
};

// Neighbourhoods of `count` points of an attractor that has an orbit. oscillator: that of its map, with or
// without the cubic spring.
[[nodiscard]] Task<Places> find_places(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                       FoundAttractor found, std::int64_t count);

// The orbit of an attractor that has one; the cycles spent on it go to `spent`.
[[nodiscard]] Task<std::optional<KnownOrbit>> find_known_orbit(CycleBroker& broker,
                                                               scene::Oscillator<double> oscillator,
                                                               FoundAttractor found, std::int64_t* spent);

// The attractors that a search knows beforehand, and where it stores those it finds.
struct SearchContext {
    const AttractorTable* known = nullptr;         // nullptr: none
    std::vector<FoundAttractor>* found = nullptr;  // nullptr: not requested
    // Chaos is known, too: a motion that has forgotten its start and has not settled after cycles_to_settle
    // cycles is chaotic.
    bool chaos = false;
    static constexpr std::int64_t cycles_to_settle = 75;
};

}  // namespace peterka::regime
