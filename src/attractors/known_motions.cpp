#include "attractors/known_motions.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "regime/search_pool.hpp"

namespace peterka::attractors {

namespace {

using cell::Regime;

constexpr std::array<std::pair<std::int64_t, std::int64_t>, 4> beside{{{-1, 0}, {0, -1}, {0, 1}, {1, 0}}};

bool can_be_followed(const KnownMotion& motion) {
    return motion.regime == Regime::periodic || motion.regime == Regime::sustained_contact;
}

}  // namespace

KnownMotions::KnownMotions(const scene::Scene& scene, std::int64_t first, std::int64_t end,
                           std::function<void()> look)
    : scene_(scene),
      job_(job_of_continuation(scene.job())),
      first_(first),
      end_(end),
      look_(std::move(look)),
      cells_(static_cast<std::size_t>((end - first) * scene.columns())) {}

KnownMotion KnownMotions::motion_of(const cell::CellResult& result) {
    return {.regime = result.regime,
            .impacts = result.impacts,
            .period = result.period,
            .displacement = result.orbit_displacement,
            .velocity = result.orbit_velocity};
}

void KnownMotions::add(std::int64_t cell, std::vector<KnownMotion> known) {
    of(cell) = {true, std::move(known)};
}

std::vector<KnownMotions::NewResult> KnownMotions::free_motions() {
    constexpr KnownMotion free{.regime = Regime::no_impact, .period = 1};
    std::vector<Attempt> attempts;
    for (std::int64_t cell = first_ * scene_.columns(); cell < end_ * scene_.columns(); ++cell) {
        const scene::Oscillator<double> oscillator = scene_of(cell).oscillator;
        if (of(cell).is_there && may_stay_free(oscillator) && !is_known(free, of(cell).known, oscillator))
            attempts.push_back({cell, free});
    }
    return solve(attempts);
}

std::vector<KnownMotions::NewResult> KnownMotions::spread(std::span<const CellMotion> news) {
    return solve(attempts(news));
}

std::vector<KnownMotions::Attempt> KnownMotions::attempts(std::span<const CellMotion> news) {
    std::vector<Attempt> attempts;
    for (const CellMotion& each : news) {
        if (!can_be_followed(each.motion)) continue;
        const std::int64_t row = each.cell / scene_.columns();
        const std::int64_t column = each.cell % scene_.columns();
        for (const auto& [up, right] : beside) {
            if (is_there(row + up, column + right))
                attempts.push_back({each.cell + up * scene_.columns() + right, each.motion});
        }
    }
    std::ranges::stable_sort(attempts, {}, &Attempt::cell);
    return attempts;
}

std::vector<KnownMotions::NewResult> KnownMotions::solve(const std::vector<Attempt>& attempts) {
    std::vector<cell::CellResult> results(attempts.size());
    const regime::AttractorTable none;
    regime::SearchPool pool(scene_, none, [&](const regime::SearchPool::NumberedOutcome& solved) {
        results[static_cast<std::size_t>(solved.number)] = solved.outcome.result;
    });
    std::size_t next = 0;
    while (next < attempts.size() || !pool.empty()) {
        look_();
        for (; next < attempts.size() && pool.has_room(); ++next) {
            pool.add([this, &attempt = attempts[next]](
                         regime::CycleBroker& broker) { return regime::outcome_of(begin(broker, attempt)); },
                     static_cast<std::int64_t>(next));
        }
        if (!pool.empty()) pool.step();
    }
    std::vector<NewResult> found;
    for (std::size_t i = 0; i < attempts.size(); ++i) {
        const auto [cell, from] = attempts[i];
        const KnownMotion motion = motion_of(results[i]);
        if (motion.regime != Regime::no_impact && !can_be_followed(motion)) continue;
        std::vector<KnownMotion>& known = of(cell).known;
        if (is_known(motion, known, scene_of(cell).oscillator)) continue;
        known.push_back(motion);
        found.push_back({cell, results[i]});
    }
    return found;
}

Task<cell::CellResult> KnownMotions::begin(regime::CycleBroker& broker, const Attempt& attempt) {
    if (attempt.from.regime == Regime::no_impact) return free_motion(broker, job_, scene_of(attempt.cell));
    return continued_motion(broker, job_, scene_of(attempt.cell), attempt.from, of(attempt.cell).known);
}

bool KnownMotions::is_there(std::int64_t row, std::int64_t column) {
    return row >= first_ && row < end_ && column >= 0 && column < scene_.columns() &&
           of(row * scene_.columns() + column).is_there;
}

KnownMotions::Cell& KnownMotions::of(std::int64_t cell) {
    return cells_[static_cast<std::size_t>(cell - first_ * scene_.columns())];
}

scene::Cell KnownMotions::scene_of(std::int64_t cell) const {
    return scene_.cell(cell / scene_.columns(), cell % scene_.columns());
}

}  // namespace peterka::attractors
