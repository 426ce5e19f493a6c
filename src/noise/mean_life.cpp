#include "noise/mean_life.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "cell/result.hpp"
#include "support/random_numbers.hpp"

namespace peterka::noise {

namespace {

constexpr double least_patience = 64;  // cycles away from home before it is asked whether it returns
constexpr double most_patience = 2000;
constexpr double times_to_relax = 3;    // that it is away before, if that is longer
constexpr double of_first_exit = 0.25;  // at most, of the mean time until it would first not return
constexpr std::int64_t first_exits = 100;
constexpr std::int64_t budget_of_exits = 32;  // a part of the budget, to be followed for
constexpr std::int64_t asking_of_exits = 2;   // times the budget, that may go into asking
constexpr std::int64_t enough_lives = 100;
constexpr std::int64_t trials_for_levels = 256;
constexpr std::int64_t reach_next = trials_for_levels / 4;  // that should get from a level to the next
constexpr int changes_between_looks = 4;
constexpr std::int64_t estimates = 8;
constexpr std::int64_t asking = 16;  // times the budget of cycles that lives are followed for may go into it
constexpr double too_strong = 1e-5;  // with a smaller radius of home nothing is told
constexpr std::int64_t quiet_as_disturbed = 4;  // cycles without changes that take as long as a disturbed one
constexpr std::int64_t fewest_trials = 32;
constexpr std::int64_t most_trials = 100'000;
constexpr std::size_t most_departures = 100'000;  // kept to begin trials from
constexpr double rarest = 1e-15;                  // per cycle
// With 95 % probability, the mean number of ends is less where so many are seen (Poisson).
constexpr std::array<double, 3> most_of_few{3.00, 4.74, 6.30};
constexpr double infinitely_far = std::numeric_limits<double>::infinity();

// A disturbed motion.
struct Walker {
    DisturbedState motion;
    std::int64_t away = 0;   // cycles since it was home
    std::int64_t ask;        // cycles away from home after which it is asked whether it returns
    std::int64_t known = 0;  // as it was home, or seen to return, last
    bool left = false;
};

constexpr double not_looked = -1;  // as a distance

enum class Now { home, away, left, failed };

double longest_patience(const Home& home) {
    return std::clamp(times_to_relax * home.to_relax(), least_patience, most_patience);
}

class Walk {
  public:
    Walk(DisturbedMap& map, const Home& home, std::uint64_t seed)
        : map_(map), home_(home), random_(seed), quiet_before_(map.quiet_cycles()) {}

    [[nodiscard]] Walker begin() { return {.motion = {home_.first_point()}, .ask = patience()}; }
    // Computed so far, in disturbed cycles.
    [[nodiscard]] std::int64_t cycles() const {
        return changes_ / map_.changes_per_cycle() + (map_.quiet_cycles() - quiet_before_) / quiet_as_disturbed;
    }
    [[nodiscard]] std::uint64_t one_of(std::size_t count) { return random_.below(count); }
    // Mean number of cycles away from home before it is asked whether it returns.
    void set_patience(double cycles) { patience_ = cycles; }

    // How far from home it would be at the next phase 0 without more disturbances, if it is worth
    // looking; NaN where the engine fails.
    [[nodiscard]] double distance(const Walker& walker) {
        if (walker.motion.at_phase_0()) return home_.distance(walker.motion.state);
        if (walker.motion.changes % changes_between_looks != 0) return not_looked;
        const auto state = map_.at_next_phase_0(walker.motion);
        return state ? home_.distance(*state) : cell::unknown;
    }

    // To the next change, or to phase 0, where it is seen whether it is home. Between, it is where it was
    // before.
    Now step(Walker& walker) {
        changes_ += walker.motion.at_phase_0() ? 0 : 1;
        if (!map_.advance(walker.motion, random_)) return Now::failed;
        if (!walker.motion.at_phase_0()) return walker.away == 0 ? Now::home : Now::away;
        if (home_.distance(walker.motion.state) <= home_.radius()) {
            walker.away = walker.known = 0;
            walker.ask = patience();
            return Now::home;
        }
        if (++walker.away < walker.ask) return Now::away;
        const auto returns = home_.takes_back(map_, walker.motion.state, elsewhere_);
        if (!returns) return Now::failed;
        if (!*returns) {
            walker.left = true;
            return Now::left;
        }
        walker.known = walker.away;
        walker.ask += patience();
        return Now::away;
    }
    // Whether it is home, or has just been seen to return.
    [[nodiscard]] bool is_known_to_return(const Walker& walker) const {
        return !walker.left && walker.known == walker.away;
    }
    // Of the states at phase 0 since it was known to return, of which the last would not return, the number of
    // those from which it would have returned: by bisection, as if it left once.
    [[nodiscard]] std::int64_t returning(std::span<const scene::State<double>> away) {
        const auto returns = [&](const scene::State<double>& state) {
            return home_.takes_back(map_, state, elsewhere_).value_or(false);
        };
        const auto before = away.first(away.size() - 1);
        return std::ranges::partition_point(before, returns) - before.begin();
    }
    // A whole cycle.
    Now cycle(Walker& walker) {
        for (;;) {
            const Now now = step(walker);
            if (now == Now::failed || walker.motion.at_phase_0()) return now;
        }
    }

  private:
    // One of the two nearest numbers.
    [[nodiscard]] std::int64_t patience() {
        const double whole = std::floor(patience_);
        return static_cast<std::int64_t>(whole) + (random_.uniform() < patience_ - whole ? 1 : 0);
    }

    DisturbedMap& map_;
    const Home& home_;
    RandomNumbers random_;
    double patience_ = 1;
    std::int64_t quiet_before_;
    std::int64_t changes_ = 0;
    std::vector<scene::State<double>> elsewhere_;
};

// Motions that are followed until they leave, one after the other.
struct Followed {
    std::int64_t cycles = 0;  // lived
    std::int64_t lives = 0;   // ended
    std::int64_t failed = 0;
    std::int64_t departures = 0;
    std::vector<Walker> departed = {};  // just after they were home: the first of them
    [[nodiscard]] bool is_sound() const { return failed <= lives / 100; }
    void count(const Followed& other) {
        cycles += other.cycles;
        lives += other.lives;
    }
};

// walker: the motion that is followed first, and the one that was followed last. Ends after so many disturbed
// cycles: a rule by all that is computed would end just where lives do, since then most is asked.
Followed follow(Walk& walk, Walker& walker, std::int64_t budget, std::int64_t most_lives,
                std::int64_t most_asked) {
    Followed followed;
    std::vector<scene::State<double>> away;
    const std::int64_t end = walk.cycles() + most_asked;
    for (std::int64_t n = 0; n < budget && walk.cycles() < end && followed.lives < most_lives; ++n) {
        const Now now = walk.cycle(walker);
        ++followed.cycles;
        if (walk.is_known_to_return(walker)) {
            away.clear();
        } else {
            away.push_back(walker.motion.state);
        }
        if ((now == Now::away || now == Now::left) && walker.away == 1) {
            ++followed.departures;
            if (followed.departed.size() < most_departures) followed.departed.push_back(walker);
        }
        if (now != Now::left && now != Now::failed) continue;
        if (now == Now::left)  // it left in the cycle after those
            followed.cycles -= std::ssize(away) - 1 - walk.returning(away);
        ++(now == Now::left ? followed.lives : followed.failed);
        walker = walk.begin();
        away.clear();
    }
    return followed;
}

// Sets the walk's patience by how soon a motion would first not return.
void find_patience(Walk& walk, const Home& home, std::int64_t budget) {
    Walker walker = walk.begin();
    const Followed exits =
        follow(walk, walker, budget / budget_of_exits, first_exits, asking_of_exits * budget);
    const bool none = exits.lives == 0 && exits.cycles == budget / budget_of_exits;
    // as if the next one came now: few may be seen
    const double mean = static_cast<double>(exits.cycles) / static_cast<double>(exits.lives + 1);
    const double longest = longest_patience(home);
    walk.set_patience(none ? longest : std::clamp(of_first_exit * mean, 1.0, longest));
}

// Lives end at random, so that their number is as uncertain as its square root; one or two tell a bound alone.
MeanLife life_of(const Followed& followed) {
    const auto cycles = static_cast<double>(followed.cycles);
    if (followed.lives < std::ssize(most_of_few))
        return {.least = cycles / most_of_few[static_cast<std::size_t>(followed.lives)]};
    const double mean = cycles / static_cast<double>(followed.lives);
    return {.mean = mean, .error = mean / std::sqrt(static_cast<double>(followed.lives))};
}

// The states in which a trial was further from home than ever before, and how it ended.
struct Trial {
    std::vector<std::pair<double, Walker>> records;
    bool left = false;
    bool failed = false;
    bool stopped = false;  // as the budget ended
};

// Until it is home again, has left, has come as far as `target`, or until the walk has computed `end` cycles.
Trial run_trial(Walk& walk, Walker walker, double target, std::int64_t end) {
    Trial trial;
    if (walker.left) {
        trial.left = true;
        return trial;
    }
    double furthest = not_looked;
    for (;;) {
        trial.stopped = walk.cycles() >= end;
        if (trial.stopped) return trial;
        const double distance = walk.distance(walker);
        trial.failed = std::isnan(distance);
        if (distance > furthest) {
            furthest = distance;
            trial.records.emplace_back(furthest, walker);
        }
        if (trial.failed || furthest >= target) return trial;
        const Now now = walk.step(walker);
        trial.left = now == Now::left;
        trial.failed = now == Now::failed;
        if (now != Now::away) return trial;
    }
}

// The state in which a trial reached a level; nothing if it didn't.
std::optional<Walker> reached(const Trial& trial, double level) {
    for (const auto& [distance, walker] : trial.records) {
        if (distance >= level) return walker;
    }
    if (!trial.left) return std::nullopt;
    return Walker{.motion = {}, .ask = 0, .left = true};
}

struct Levels {
    std::vector<double> distances;     // of the levels beyond home
    std::vector<double> trial_cycles;  // mean number of cycles of a trial at each level, from home on
    double probability = 1;            // to reach the last level, roughly
    bool leads_away = false;           // from the last level trials leave
};

// As far as the budget reaches: then the estimates, which begin fewer trials, keep to theirs. Nothing where
// trials fail.
std::optional<Levels> choose_levels(Walk& walk, std::vector<Walker> from, double departures_per_cycle,
                                    std::int64_t budget) {
    Levels levels;
    double last = 0;
    const std::int64_t end = walk.cycles() + budget;
    for (;;) {
        std::vector<Trial> trials;
        std::vector<double> furthest;
        const std::int64_t before = walk.cycles();
        for (std::int64_t n = 0; n < trials_for_levels; ++n) {
            trials.push_back(run_trial(walk, from[walk.one_of(from.size())], infinitely_far, end));
            const Trial& trial = trials.back();
            if (trial.stopped) return levels;
            if (trial.failed) return std::nullopt;
            furthest.push_back(trial.left ? infinitely_far : trial.records.back().first);
        }
        levels.trial_cycles.push_back(static_cast<double>(walk.cycles() - before) /
                                      static_cast<double>(trials_for_levels));
        std::ranges::sort(furthest);
        const double next = furthest[static_cast<std::size_t>(trials_for_levels - reach_next)];
        levels.leads_away = next == infinitely_far;
        const bool is_rarest = levels.probability * departures_per_cycle < rarest;
        if (levels.leads_away || is_rarest || !(next > last)) return levels;
        from.clear();
        for (const Trial& trial : trials) {
            if (const auto walker = reached(trial, next)) from.push_back(*walker);
        }
        levels.probability *= static_cast<double>(from.size()) / static_cast<double>(trials_for_levels);
        levels.distances.push_back(next);
        last = next;
    }
}

// Lives that end per cycle, NaN where trials go far beyond the budget; nothing where they fail. walker: as for
// `follow`; `all`: what is followed is counted there, too.
std::optional<double> rate_of(Walk& walk, Walker& walker, const Levels& levels, std::int64_t budget,
                              std::int64_t trials, Followed& all) {
    const std::int64_t end = walk.cycles() + asking * budget;
    const Followed base =
        follow(walk, walker, budget, std::numeric_limits<std::int64_t>::max(), asking * budget);
    if (!base.is_sound()) return std::nullopt;
    all.count(base);
    if (base.departures == 0) return 0;
    double rate = static_cast<double>(base.departures) / static_cast<double>(base.cycles);
    std::vector<Walker> from = base.departed;
    std::vector<double> targets = levels.distances;
    targets.push_back(infinitely_far);
    for (const double target : targets) {
        std::vector<Walker> there;
        for (std::int64_t i = 0; i < trials; ++i) {
            const Trial trial = run_trial(walk, from[walk.one_of(from.size())], target, end);
            if (trial.failed) return std::nullopt;
            if (trial.stopped) return cell::unknown;
            if (const auto at_target = reached(trial, target)) there.push_back(*at_target);
        }
        rate *= static_cast<double>(there.size()) / static_cast<double>(trials);
        if (there.empty()) return 0;
        from = std::move(there);
    }
    return rate;
}

// From the mean rate and its standard error, a bound alone where one or two estimates saw a life end; nothing
// where none did, or one didn't end.
std::optional<MeanLife> life_of(const std::vector<double>& rates) {
    const auto count = static_cast<double>(rates.size());
    double mean = 0;
    for (const double rate : rates) mean += rate / count;
    if (!(mean > 0)) return std::nullopt;
    const auto seen = std::ranges::count_if(rates, [](double rate) { return rate > 0; });
    if (seen < std::ssize(most_of_few))
        return MeanLife{.least =
                            static_cast<double>(seen) / (most_of_few[static_cast<std::size_t>(seen)] * mean)};
    double squares = 0;
    for (const double rate : rates) squares += (rate - mean) * (rate - mean);
    return MeanLife{.mean = 1 / mean, .error = std::sqrt(squares / (count - 1) / count) / (mean * mean)};
}

// That of so many or fewer events, of which `mean` are expected (Poisson).
double chance_of_at_most(std::int64_t count, double mean) {
    double term = std::exp(-mean);
    double sum = 0;
    for (std::int64_t n = 0; n <= count; ++n) {
        sum += term;
        term *= mean / static_cast<double>(n + 1);
    }
    return sum;
}

// Whether the lives that were seen to end are so many as a mean life within two standard errors lets expect:
// eight estimates that differ by factors of ten may all miss the ways on which most lives end.
bool fits(const MeanLife& life, const Followed& seen) {
    constexpr double unlikely = 0.025;
    const auto cycles = static_cast<double>(seen.cycles);
    const double spread = 2 * life.error / life.mean;
    const double fewest = cycles / life.mean * std::max(1 - spread, 0.0);
    const double most = cycles / life.mean * (1 + spread);
    return chance_of_at_most(seen.lives, fewest) > unlikely &&
           1 - chance_of_at_most(seen.lives - 1, most) > unlikely;
}

}  // namespace

std::optional<MeanLife> mean_life_followed(DisturbedMap& map, const Home& home, std::int64_t budget,
                                           std::uint64_t seed) {
    Walk walk(map, home, seed);
    find_patience(walk, home, budget);
    Walker walker = walk.begin();
    const Followed followed =
        follow(walk, walker, budget, std::numeric_limits<std::int64_t>::max(), asking * budget);
    if (!followed.is_sound()) return std::nullopt;
    return life_of(followed);
}

std::optional<MeanLife> mean_life(DisturbedMap& map, const Home& home, std::int64_t budget,
                                  std::uint64_t seed) {
    if (home.radius() < too_strong) return std::nullopt;
    Walk walk(map, home, seed);
    find_patience(walk, home, budget);
    const std::int64_t before = walk.cycles();
    Walker walker = walk.begin();
    const Followed first = follow(walk, walker, budget / 4, enough_lives, asking * budget / 4);
    Followed all = first;
    if (!first.is_sound()) return std::nullopt;
    if (first.lives == enough_lives || first.departures == 0) return life_of(first);
    const double departures_per_cycle =
        static_cast<double>(first.departures) / static_cast<double>(first.cycles);
    const auto levels = choose_levels(walk, first.departed, departures_per_cycle, budget / 2);
    if (!levels) return std::nullopt;
    const double reached_per_cycle = departures_per_cycle * levels->probability;
    const auto without_splitting = [&] {
        MeanLife life = life_of(all);
        if (all.lives == 0) life.least = std::max(1 / reached_per_cycle, life.least);
        return life;
    };
    if (!levels->leads_away) return without_splitting();
    const std::int64_t each = std::max(budget - (walk.cycles() - before), budget / 4) / (2 * estimates);
    double of_trials = 0;
    for (const double cycles : levels->trial_cycles) of_trials += cycles;
    const auto trials = std::clamp(static_cast<std::int64_t>(static_cast<double>(each) / of_trials),
                                   fewest_trials, most_trials);
    std::vector<double> rates;
    for (std::int64_t n = 0; n < estimates; ++n) {
        const auto rate = rate_of(walk, walker, *levels, each, trials, all);
        if (!rate) return std::nullopt;
        rates.push_back(*rate);
    }
    const auto life = life_of(rates);
    if (life && std::isfinite(life->mean) && fits(*life, all)) return life;
    MeanLife other = without_splitting();
    if (life && std::isnan(life->mean) && std::isnan(other.mean))
        other.least = std::max(other.least, life->least);
    return other;
}

}  // namespace peterka::noise
