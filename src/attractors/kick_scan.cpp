#include "attractors/kick_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/expect.hpp"

namespace peterka::attractors {

namespace {

// Sizes double, from 1/256 of the largest.
constexpr int levels = 9;
constexpr int kicks_of_a_level = 32;  // for each cycle of the orbit
constexpr int kicks_of_a_round = 64;  // in each half, for each cycle of the orbit
constexpr int most_cycles = 16;       // longer orbits get no more kicks
constexpr int rounds_in_vain = 12;    // before the rounds end
constexpr double clearly = 0.01;      // relative decrease that keeps the rounds going
constexpr int stretches = 16;         // of phases, per cycle
constexpr int kicks_of_a_step = 32;   // along the border
constexpr double first_step = 0.125;  // relative in size
constexpr double last_step = 1e-4;
constexpr double no_surprise = 5;  // factor over the expected number
constexpr std::int64_t most_cycles_of_searches = 2'000'000;

// The fractional part of n times an irrational number: evenly spread over every stretch of n.
double fraction(std::uint64_t n, double irrational) {
    const double turns = static_cast<double>(n) * irrational;
    return turns - std::floor(turns);
}

}  // namespace

KickScan::KickScan(int period, double largest)
    : period_(period),
      largest_(largest),
      slow_(static_cast<std::size_t>(2 * stretches) * static_cast<std::size_t>(period)) {}

std::vector<KickTried> KickScan::next(std::span<const Outcome> outcomes) {
    take(outcomes);
    switch (stage_) {
        case Stage::growing:
            tried_ = growing();
            break;
        case Stage::rounds:
            tried_ = round();
            break;
        case Stage::border:
            tried_ = along_border();
            break;
        case Stage::done:
            tried_.clear();
            break;
    }
    return tried_;
}

void KickScan::take(std::span<const Outcome> outcomes) {
    PETERKA_EXPECT(outcomes.empty() || outcomes.size() == tried_.size());
    const double before = bound();
    for (std::size_t i = 0; i < outcomes.size(); ++i) take_one(tried_[i], outcomes[i]);
    if (chaotic_ && chaos_dies()) dies_ = true;
    smallest_ = settled_;
    if (chaotic_ && !dies_ && (!settled_ || chaotic_->size() < settled_->size())) smallest_ = chaotic_;
    if (!outcomes.empty()) choose_stage(before);
}

void KickScan::take_one(const KickTried& kick, const Outcome& outcome) {
    spent_ += outcome.cycles;
    const auto keep_smaller = [&kick](std::optional<KickTried>& smallest) {
        if (!smallest || kick.size() < smallest->size()) smallest = kick;
    };
    switch (outcome.end) {
        case Outcome::End::elsewhere:
            return keep_smaller(settled_);
        case Outcome::End::chaos:
            shortest_stay_ = stayed_ == 0 ? outcome.chaotic : std::min(shortest_stay_, outcome.chaotic);
            ++stayed_;
            return keep_smaller(chaotic_);
        case Outcome::End::unknown:
            return keep_smaller(unknown_);
        case Outcome::End::back:
            break;
    }
    if (outcome.chaotic > 0) {
        ++returned_;
        lives_ += outcome.chaotic;
    }
    Slow& slow = place_of(kick);
    if (outcome.cycles >= slow.cycles || slow.kick.size() > bound()) slow = {kick, outcome.cycles};
}

// Lifetimes are exponentially distributed; their mean is taken over those that ended, since the others may
// never end.
bool KickScan::chaos_dies() const {
    if (returned_ == 0) return false;
    const double mean = static_cast<double>(lives_) / static_cast<double>(returned_);
    const double expected =
        static_cast<double>(returned_) * std::exp(-static_cast<double>(shortest_stay_) / mean);
    return static_cast<double>(stayed_) <= no_surprise * expected;
}

// before: the bound before the last kicks.
void KickScan::choose_stage(double before) {
    const double fell = 1 - bound() / before;
    if (stage_ != Stage::border) step_ = first_step;
    if (fell < 0) {  // the smallest kick no longer counts, and fewer were tried beyond it
        stage_ = smallest_ ? Stage::rounds : Stage::growing;
        in_vain_ = 0;
    } else if (stage_ == Stage::growing) {
        if (smallest_ || ++level_ == levels) stage_ = Stage::rounds;
    } else if (stage_ == Stage::rounds) {
        in_vain_ = fell > clearly ? 0 : in_vain_ + 1;
        if (in_vain_ == rounds_in_vain) stage_ = smallest_ ? Stage::border : Stage::done;
    } else {
        if (fell < step_ / 4) step_ /= 2;
        if (step_ < last_step) stage_ = Stage::done;
    }
    if (spent_ < most_cycles_of_searches || stage_ == Stage::border) return;
    stage_ = stage_ == Stage::rounds && smallest_ ? Stage::border : Stage::done;
}

double KickScan::tried() const {
    return smallest_ ? smallest_->size() : largest_of_level(level_ - 1);
}

double KickScan::largest_of_level(int level) const {
    return largest_ * std::ldexp(1.0, std::clamp(level, 0, levels - 1) + 1 - levels);
}

std::vector<KickTried> KickScan::growing() {
    const double most = largest_of_level(level_);
    const int count = kicks_of_a_level * std::min(period_, most_cycles);
    std::vector<KickTried> kicks;
    kicks.reserve(static_cast<std::size_t>(count));
    for (int n = 0; n < count; ++n) {
        kicks.push_back(spread(level_ == 0 ? 0 : most / 2, most));
    }
    return kicks;
}

std::vector<KickTried> KickScan::round() {
    std::vector<KickTried> kicks;
    for (int n = 0; n < kicks_of_a_round * std::min(period_, most_cycles); ++n) {
        kicks.push_back(spread(0, bound()));
        kicks.push_back(near(smallest_ && n % 4 == 0 ? *smallest_ : slow_one().kick));
    }
    return kicks;
}

// Kicks next to the smallest. Near the lowest point of a border, phase distances scale with size differences
// where the border has a corner there, and with their square root where it is smooth.
std::vector<KickTried> KickScan::along_border() {
    std::vector<KickTried> kicks;
    for (int n = 0; n < kicks_of_a_step; ++n) {
        const double phase = (n % 2 == 0 ? step_ : std::sqrt(step_)) * (random_.uniform() - 0.5);
        kicks.push_back(moved(smallest_->phase + phase, smallest_->change * (1 - step_ * random_.uniform())));
    }
    return kicks;
}

// The next kick of a sequence that fills phases and sizes evenly, up and down in turn.
KickTried KickScan::spread(double least, double most) {
    constexpr double plastic = 1.32471795724474602596;  // the best pair of irrational numbers (Roberts 2018)
    ++spread_;
    const double size = least + (most - least) * fraction(spread_, 1 / (plastic * plastic));
    return {period_ * fraction(spread_, 1 / plastic), spread_ % 2 == 0 ? size : -size};
}

// A kick at a distance of random order of magnitude, and smaller than the bound.
KickTried KickScan::near(const KickTried& kick) {
    const double wide = std::exp2(-1 - 10 * random_.uniform());
    const double phase = kick.phase + wide * (random_.uniform() - 0.5);
    const double change = kick.change + wide * bound() * (random_.uniform() - 0.5);
    return moved(phase, change);
}

// The kick with this phase, reduced to the orbit's period, and this change, limited to below the bound.
KickTried KickScan::moved(double phase, double change) const {
    const double most = bound() * (1 - 1e-6);
    return {phase - period_ * std::floor(phase / period_), std::clamp(change, -most, most)};
}

KickScan::Slow& KickScan::place_of(const KickTried& kick) {
    const auto stretch = static_cast<std::size_t>(kick.phase * stretches);
    return slow_[std::min(2 * stretch + (kick.change < 0 ? 1 : 0), slow_.size() - 1)];
}

// The slowest among a random number of random stretches, log-uniform from one to all: the slowest of all lies
// next to the known part of the border, others next to parts yet to be found.
const KickScan::Slow& KickScan::slow_one() {
    const double contenders = std::exp2(random_.uniform() * std::log2(static_cast<double>(slow_.size())));
    std::size_t slowest = 0;
    for (int n = 0; n < static_cast<int>(contenders); ++n) {
        const auto stretch = static_cast<std::size_t>(random_.uniform() * static_cast<double>(slow_.size()));
        if (n == 0 || slow_[stretch].cycles > slow_[slowest].cycles) slowest = stretch;
    }
    return slow_[slowest];
}

}  // namespace peterka::attractors
