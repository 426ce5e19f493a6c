#include "noise/mean_life.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "cell/result.hpp"
#include "support/random_numbers.hpp"

namespace peterka::noise {

namespace {

constexpr double least_patience = 64;  // cycles away from home from one question whether it returns to the next
constexpr double most_patience = 2000;
constexpr double times_to_relax = 3;    // in which it relaxes, if that is longer
constexpr double of_first_exit = 0.25;  // at most, of the mean time until it would first not return
constexpr std::int64_t first_exits = 200;
constexpr std::int64_t budget_of_exits = 8;  // a part of the budget, to be followed for
constexpr std::int64_t enough_lives = 100;
constexpr std::int64_t lives_to_follow_on = 10;  // in a quarter of the budget
constexpr int changes_between_looks = 4;
constexpr std::int64_t asking = 16;  // times the budget of cycles that lives are followed for may go into it
constexpr std::size_t fewest_paths = 32;
constexpr std::size_t most_paths = 20'000;
constexpr double times_first_paths = 40;          // that a splitting costs, roughly
constexpr std::int64_t splitting = 3;             // times the budget that it may take
constexpr double known_well = 0.25;               // relative variance
constexpr double told_at_most = 0.63;             // relative error of a mean life
constexpr double too_strong = 1e-5;               // with a smaller radius of home nothing is told
constexpr std::int64_t quiet_as_disturbed = 2;    // cycles without changes that take as long as a disturbed one
constexpr std::size_t most_departures = 100'000;  // kept to begin paths from
constexpr double rarest = 1e-15;                  // per cycle
// With 95 % probability, the mean number of ends is less where so many are seen (Poisson).
constexpr std::array<double, 4> most_of_few{3.00, 4.74, 6.30, 7.75};
constexpr double infinitely_far = std::numeric_limits<double>::infinity();

// A disturbed motion.
struct Walker {
    DisturbedState motion;
    std::int64_t away = 0;   // cycles since it was home
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

    [[nodiscard]] Walker begin() { return {.motion = {home_.first_point()}}; }
    // Computed so far, in disturbed cycles.
    [[nodiscard]] std::int64_t cycles() const {
        return changes_ / map_.changes_per_cycle() + (map_.quiet_cycles() - quiet_before_) / quiet_as_disturbed;
    }
    [[nodiscard]] std::uint64_t one_of(std::size_t count) { return random_.below(count); }
    // Mean number of cycles away from home from one question whether it returns to the next, and how uncertain
    // that makes a mean life (relative variance).
    void set_patience(double cycles, double variance) {
        patience_ = cycles;
        variance_ = variance;
    }
    [[nodiscard]] double variance() const { return variance_; }

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
            return Now::home;
        }
        ++walker.away;
        if (random_.uniform() * patience_ >= 1) return Now::away;
        const auto returns = home_.takes_back(map_, walker.motion.state, elsewhere_);
        if (!returns) return Now::failed;
        if (!*returns) {
            walker.left = true;
            return Now::left;
        }
        walker.known = walker.away;
        return Now::away;
    }
    // Whether it is home, or has just been seen to return.
    [[nodiscard]] bool is_known_to_return(const Walker& walker) const {
        return !walker.left && walker.known == walker.away;
    }
    [[nodiscard]] std::int64_t returning(std::span<const scene::State<double>> states) {
        return home_.returning(map_, states, random_, elsewhere_);
    }
    // A whole cycle.
    Now cycle(Walker& walker) {
        for (;;) {
            const Now now = step(walker);
            if (now == Now::failed || walker.motion.at_phase_0()) return now;
        }
    }

  private:
    DisturbedMap& map_;
    const Home& home_;
    RandomNumbers random_;
    double patience_ = 1;
    double variance_ = 0;
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
    [[nodiscard]] Followed operator+(const Followed& other) const {
        return {.cycles = cycles + other.cycles, .lives = lives + other.lives};
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
        if (now == Now::left) {  // with all of these but the last it might have returned
            const auto before = std::span(away).first(away.size() - 1);
            followed.cycles -= std::ssize(before) - walk.returning(before);
        }
        ++(now == Now::left ? followed.lives : followed.failed);
        walker = walk.begin();
        away.clear();
    }
    return followed;
}

// Sets the walk's patience by how soon a motion would first not return.
void find_patience(Walk& walk, const Home& home, std::int64_t budget) {
    Walker walker = walk.begin();
    const Followed exits = follow(walk, walker, budget / budget_of_exits, first_exits, budget);
    const bool none = exits.lives == 0 && exits.cycles == budget / budget_of_exits;
    // as if the next one came now: few may be seen
    const double mean = static_cast<double>(exits.cycles) / static_cast<double>(exits.lives + 1);
    const double longest = longest_patience(home);
    const double patience = none ? longest : of_first_exit * mean;
    const bool is_uncertain = patience > 1 && patience < longest;
    walk.set_patience(std::clamp(patience, 1.0, longest),
                      is_uncertain ? 1 / static_cast<double>(exits.lives + 1) : 0.0);
}

// Lives end at random, so that their number is as uncertain as its square root; a few tell a bound alone.
MeanLife life_of(const Followed& followed, const Walk& walk) {
    const auto cycles = static_cast<double>(followed.cycles);
    if (followed.lives < std::ssize(most_of_few))
        return {.least = cycles / most_of_few[static_cast<std::size_t>(followed.lives)]};
    const double mean = cycles / static_cast<double>(followed.lives);
    return {.mean = mean, .error = mean * std::sqrt(1 / static_cast<double>(followed.lives) + walk.variance())};
}

// A motion from where it is away from home, or further, on: the states in which it was further than ever
// before, and how it ended.
struct Path {
    std::vector<std::pair<double, Walker>> records = {};
    std::size_t departure = 0;  // with which it began
    bool left = false;
    bool failed = false;
    bool stopped = false;  // as the budget ended

    [[nodiscard]] double furthest() const {
        if (left) return infinitely_far;
        return records.back().first;
    }
    // From the state on in which it first was beyond a distance, which it reached.
    void begin_beyond(double distance) {
        std::erase_if(records, [&](const auto& record) { return record.first <= distance; });
    }
    [[nodiscard]] Walker begin() const {
        return records.empty() ? Walker{.motion = {}, .left = true} : records.front().second;
    }
};

// Until it is home again, has left, or until the walk has computed `end` cycles.
Path follow_path(Walk& walk, Walker walker, std::size_t departure, std::int64_t end) {
    Path path{.departure = departure, .left = walker.left};
    double furthest = not_looked;
    for (Now now = path.left ? Now::left : Now::away; now == Now::away;) {
        path.stopped = walk.cycles() >= end;
        if (path.stopped) return path;
        const double distance = walk.distance(walker);
        path.failed = std::isnan(distance);
        if (path.failed) return path;
        if (distance > furthest) {
            furthest = distance;
            path.records.emplace_back(furthest, walker);
        }
        now = walk.step(walker);
        path.left = now == Now::left;
        path.failed = now == Now::failed;
    }
    return path;
}

struct Probability {
    double mean;
    double variance;  // relative
};

// Of a departure from home.
struct Split {
    std::optional<Probability> leaves;
    std::optional<Probability> gets_far;  // as far as is known well
};

double median_furthest(const std::vector<Path>& paths) {
    std::vector<double> furthest(paths.size());
    std::ranges::transform(paths, furthest.begin(), &Path::furthest);
    const auto middle = furthest.begin() + std::ssize(furthest) / 2 - 1;
    std::ranges::nth_element(furthest, middle);
    return *middle;
}

// Relative, of the probability to get where some paths got: by the shares in them that descend from the same
// departure (Lee & Whiteley 2018, Biometrika 105, 609).
double variance_of_lineages(const std::vector<Path>& paths, const std::vector<std::size_t>& got_there) {
    std::map<std::size_t, double> shares;
    for (const std::size_t n : got_there)
        shares[paths[n].departure] += 1 / static_cast<double>(got_there.size());
    double squares = 0;
    for (const auto& [departure, share] : shares) squares += share * share;
    return std::max(squares - 1 / static_cast<double>(paths.size()), 0.0);
}

// first: cycles that the first paths took.
std::size_t affordable_paths(std::int64_t first, std::int64_t budget) {
    const double each = times_first_paths * static_cast<double>(first) / static_cast<double>(fewest_paths);
    return std::clamp(static_cast<std::size_t>(static_cast<double>(budget) / std::max(each, 1.0)), fewest_paths,
                      most_paths);
}

// Adaptive multilevel splitting, as far as the budget reaches; nothing where a path fails.
std::optional<Split> split(Walk& walk, const std::vector<Walker>& departed, double least_probability,
                           std::int64_t budget) {
    const std::int64_t begin = walk.cycles();
    const std::int64_t end = begin + splitting * budget;
    Split found;
    std::vector<Path> paths;
    std::size_t count = fewest_paths;
    while (paths.size() < count) {
        const std::size_t departure = walk.one_of(departed.size());
        paths.push_back(follow_path(walk, departed[departure], departure, end));
        if (paths.back().failed) return std::nullopt;
        if (paths.back().stopped) return found;
        if (paths.size() == fewest_paths) count = affordable_paths(walk.cycles() - begin, budget);
    }
    double of_levels = 0;  // relative variance, were paths independent
    for (double probability = 1;;) {
        const double level = median_furthest(paths);
        const bool leaves = level == infinitely_far;
        std::vector<std::size_t> beyond;
        for (std::size_t n = 0; n < count; ++n) {
            if (leaves ? paths[n].left : paths[n].furthest() > level) beyond.push_back(n);
        }
        if (beyond.empty()) return found;
        probability *= static_cast<double>(beyond.size()) / static_cast<double>(count);
        of_levels += 1 / static_cast<double>(beyond.size()) - 1 / static_cast<double>(count);
        const Probability gets_there{probability, of_levels + variance_of_lineages(paths, beyond)};
        if (gets_there.variance <= known_well) found.gets_far = gets_there;
        if (leaves) found.leaves = gets_there;
        if (leaves || probability < least_probability) return found;
        for (const std::size_t n : beyond) paths[n].begin_beyond(level);
        std::size_t next = walk.one_of(beyond.size());
        for (Path& path : paths) {
            if (path.furthest() > level) continue;
            const Path& parent = paths[beyond[next++ % beyond.size()]];
            path = follow_path(walk, parent.begin(), parent.departure, end);
            if (path.failed) return std::nullopt;
            if (path.stopped) return found;
        }
    }
}

// By departures from home and the probability that one leaves.
std::optional<MeanLife> life_by_splitting(Walk& walk, const Followed& first, std::int64_t budget) {
    const auto departures = static_cast<double>(first.departures);
    const double departures_per_cycle = departures / static_cast<double>(first.cycles);
    const auto found = split(walk, first.departed, rarest / departures_per_cycle, budget);
    if (!found) return std::nullopt;
    MeanLife life = life_of(first, walk);
    const double followed = std::isfinite(life.mean) ? life.error / life.mean : told_at_most;
    const double error =
        found->leaves ? std::sqrt(found->leaves->variance + 1 / departures + walk.variance()) : infinitely_far;
    if (error <= std::min(followed, told_at_most)) {
        const double mean = 1 / (departures_per_cycle * found->leaves->mean);
        return MeanLife{.mean = mean, .error = mean * error};
    }
    if (first.lives == 0 && found->gets_far) {
        const double most =
            found->gets_far->mean * (1 + 2 * std::sqrt(found->gets_far->variance + 1 / departures));
        life.least = std::max(1 / (departures_per_cycle * most), life.least);
    }
    return life;
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
    return life_of(followed, walk);
}

std::optional<MeanLife> mean_life(DisturbedMap& map, const Home& home, std::int64_t budget,
                                  std::uint64_t seed) {
    if (home.radius() < too_strong) return std::nullopt;
    Walk walk(map, home, seed);
    find_patience(walk, home, budget);
    Walker walker = walk.begin();
    const Followed first = follow(walk, walker, budget / 4, enough_lives, asking * budget / 4);
    if (!first.is_sound()) return std::nullopt;
    if (first.lives == enough_lives || first.departures == 0) return life_of(first, walk);
    const std::int64_t rest = budget - budget / 4;
    if (first.lives < lives_to_follow_on) return life_by_splitting(walk, first, rest);
    const Followed more = follow(walk, walker, rest, std::numeric_limits<std::int64_t>::max(), asking * rest);
    if (!more.is_sound()) return std::nullopt;
    return life_of(first + more, walk);
}

}  // namespace peterka::noise
