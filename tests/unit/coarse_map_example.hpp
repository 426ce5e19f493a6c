// A coarse map of the 170 mm rig without its cubic spring, solved on this rank.
#pragma once

#include "curves/coarse_map.hpp"
#include "curves/rig.hpp"
#include "rig.hpp"

namespace peterka::testing {

struct MapExample {
    scene::Scene scene;
    curves::Rig rig;
    curves::CoarseMap map{scene, rig};

    MapExample(const job::Axis& frequency_ratio, const job::Axis& gap_ratio)
        : MapExample(job_of(frequency_ratio, gap_ratio)) {}
    explicit MapExample(const job::Job& job) : scene(job), rig(job) {
        std::vector<curves::Numbers> parts;
        for (std::int64_t part = 0; part < map.parts(); ++part) parts.push_back(map.solve(part));
        map.put_together(parts);
    }
    MapExample(const MapExample&) = delete;
    MapExample& operator=(const MapExample&) = delete;

    [[nodiscard]] curves::PlanePoint window() const {
        const curves::PlanePoint low = map.place(0);
        const curves::PlanePoint high = map.place(map.count() - 1);
        return {high.column - low.column, high.row - low.row};
    }
    [[nodiscard]] std::int64_t cell(std::int64_t row, std::int64_t column) const {
        return row * map.columns() + column;
    }

    static job::Job job_of(const job::Axis& frequency_ratio, const job::Axis& gap_ratio) {
        job::Job job = job_170mm(0);
        job.kind = job::Kind::curves;
        job.columns = frequency_ratio;
        job.rows = gap_ratio;
        return job;
    }
};

// With folds, doublings and grazings of 1/1, 2/2, 1/2 and 3/2, and no impact at its largest gap.
inline const MapExample& coarse_map_example() {
    static const MapExample made({1.5, 3.5, 11}, {0.1, 1.6, 6});
    return made;
}

}  // namespace peterka::testing
