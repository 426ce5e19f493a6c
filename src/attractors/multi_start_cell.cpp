#include "attractors/multi_start_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "attractors/continued_motion.hpp"
#include "attractors/start_sequence.hpp"
#include "regime/same_orbit.hpp"
#include "regime/solve_cell.hpp"

namespace peterka::attractors {

namespace {

using regime::CellResult;
using regime::CycleBroker;
using regime::FoundAttractor;

// Rounds have 1, 3, 4, 4, 4, 4, 5, 6, 7, ..., 256, 256, ... starts: each knows what a fifth fewer have found.
constexpr std::int64_t largest_round = 256;

std::int64_t size_of_round(std::int64_t begun) {
    return begun <= 1 ? 1 + 2 * begun : std::clamp<std::int64_t>(begun / 4, 4, largest_round);
}

// A start that ends in a neighbourhood is spared some two rounds of the orbit, which its convergence to the
// known orbit takes to be seen, and proving one takes some 200 or 300 rounds.
constexpr double starts_worth_a_proof = 150;

job::Job of_starts(job::Job job) {
    job.output.fields.clear();
    return job;
}

Task<CellResult> find_orbit(CycleBroker& broker, scene::Oscillator<double> oscillator, FoundAttractor found,
                            std::optional<regime::KnownOrbit>* orbit) {
    std::int64_t spent = 0;
    *orbit = co_await regime::find_known_orbit(broker, oscillator, found, &spent);
    co_return CellResult{.cycles = static_cast<std::int32_t>(spent)};
}

Task<CellResult> find_places(CycleBroker& broker, scene::Oscillator<double> oscillator, FoundAttractor found,
                             std::vector<regime::Neighbourhood>* places) {
    regime::Places proved = co_await regime::find_places(broker, oscillator, found, 1);
    *places = std::move(proved.neighbourhoods);
    co_return CellResult{.cycles = static_cast<std::int32_t>(proved.cycles)};
}

}  // namespace

MapContext::MapContext(const scene::Scene& map, const regime::AttractorTable& known_before, Ends ends_of_starts)
    : scene(map),
      known(known_before),
      of_starts(attractors::of_starts(map.job())),
      of_short_starts(of_starts),
      ends(ends_of_starts) {
    of_short_starts.steady_state = Prospects::smaller(of_starts.steady_state);
}

MultiStartCell::MultiStartCell(const MapContext& context, std::int64_t row, std::int64_t column)
    : context_(context),
      cell_(context.scene.cell(row, column)),
      chaos_may_end_(cell_.oscillator.gap < 0 || may_stay_free(cell_.oscillator)) {}

std::vector<SearchFactory> MultiStartCell::next(std::span<const SearchOutcome> ended) {
    for (const SearchOutcome& each : ended) cycles_ += each.result.cycles;
    switch (std::exchange(stage_, Stage::starts)) {
        case Stage::begin:
            break;
        case Stage::starts: {
            take_starts(ended);
            if (seen_ == count()) return finish_starts();
            std::vector<SearchFactory> searches = attractors_worth_knowing();
            if (searches.empty()) break;
            stage_ = Stage::attractors;
            return searches;
        }
        case Stage::attractors:
            know_more();
            break;
        case Stage::orbits_to_kick:
            know_more();
            return begin_kicks();
        case Stage::kicks: {
            std::vector<SearchFactory> searches = kicks_->next(ended);
            stage_ = Stage::kicks;
            if (searches.empty()) take_kicks();
            return searches;
        }
    }
    return next_round();
}

SolvedCell MultiStartCell::result() const {
    SolvedCell solved = solved_;
    solved.cell.cycles =
        static_cast<std::int32_t>(std::min<std::int64_t>(cycles_, std::numeric_limits<std::int32_t>::max()));
    return solved;
}

std::vector<SearchFactory> MultiStartCell::next_round() {
    std::vector<SearchFactory> searches;
    if (begun_ == 0) {
        searches.emplace_back([this](CycleBroker& broker, std::vector<FoundAttractor>* found) {
            return regime::solve_cell(broker, context_.scene.job(), cell_, {&context_.known, found});
        });
    }
    const std::int64_t end = std::min(count(), begun_ + size_of_round(begun_));
    for (; begun_ < end; ++begun_) {
        searches.push_back(search_from(start_of(context_.of_starts.starts, cell_, begun_), sooner()));
    }
    return searches;
}

SearchFactory MultiStartCell::search_from(const scene::State<double>& start, EarlyVerdict sooner) const {
    return [this, start, sooner](CycleBroker& broker, std::vector<FoundAttractor>* found) {
        return regime::solve_cell(broker, sooner.unresolved ? context_.of_short_starts : context_.of_starts,
                                  {cell_.oscillator, start}, {&table_, found, sooner.chaos});
    };
}

// Where chaos may end on a motion without impacts, only a run of its own tells whether a start has left it.
EarlyVerdict MultiStartCell::sooner() const {
    return chaos_may_end_ ? EarlyVerdict{} : prospects_.sooner();
}

void MultiStartCell::take_starts(std::span<const SearchOutcome> ended) {
    if (seen_ == 0) {
        solved_.cell = ended.front().result;
        prospects_.take(solved_.cell);
        take_found(ended.front().found);
        own_ = Tally::entry_of(solved_.cell, ended.front().found);
        if (count() == 0) tally_.add(solved_.cell, ended.front().found);
        ended = ended.subspan(1);
    }
    for (const SearchOutcome& start : ended) {
        tally_.add(start.result, start.found);
        prospects_.take(start.result);
        life_.take(start.result);
        if (context_.ends == Ends::told) solved_.ends.push_back(start.result);
        take_found(start.found);
    }
    seen_ += static_cast<std::int64_t>(ended.size());
}

void MultiStartCell::take_found(std::span<const FoundAttractor> found) {
    for (const FoundAttractor& each : found) {
        if (each.result.regime != regime::Regime::periodic) continue;
        const auto known = std::ranges::find_if(known_, [&](const Known& other) {
            return other.found.cubic == each.cubic &&
                   regime::same_map(oscillator_of(each), other.found.settings, each.settings) &&
                   regime::same_orbit(other.found.result, each.result);
        });
        Known& entry = known != known_.end() ? *known : known_.emplace_back(Known{each});
        if (!entry.found.by_cubic) entry.found.by_cubic = each.by_cubic;
        ++entry.times;
    }
}

// Of the starts to come, as far as those before them tell.
double MultiStartCell::expected(const Known& known) const {
    return static_cast<double>(known.times) / static_cast<double>(seen_ + 1) *
           static_cast<double>(count() - seen_);
}

bool MultiStartCell::is_worth_following(const Known& known) const {
    return !known.followed && expected(known) >= 1;
}

bool MultiStartCell::is_worth_proving(const Known& known) const {
    return !known.tried && expected(known) >= starts_worth_a_proof;
}

std::vector<SearchFactory> MultiStartCell::attractors_worth_knowing() {
    learned_.clear();
    for (std::size_t i = 0; i < known_.size(); ++i) {
        learn(i, is_worth_following(known_[i]), is_worth_proving(known_[i]));
    }
    return learn_all();
}

// Kicks are many, and most of them lead back.
std::vector<SearchFactory> MultiStartCell::orbits_to_kick() {
    learned_.clear();
    for (std::size_t i = 0; i < known_.size(); ++i) learn(i, !known_[i].followed, !known_[i].tried);
    return learn_all();
}

void MultiStartCell::learn(std::size_t known, bool follows, bool proves) {
    known_[known].followed |= follows;
    known_[known].tried |= proves;
    if (follows) learned_.push_back({.known = known, .proves = false});
    if (proves) learned_.push_back({.known = known, .proves = true});
}

std::vector<SearchFactory> MultiStartCell::learn_all() {
    std::vector<SearchFactory> searches;
    for (Learned& learned : learned_) {
        searches.emplace_back([this, &learned](CycleBroker& broker, std::vector<FoundAttractor>*) {
            const FoundAttractor& found = known_[learned.known].found;
            return learned.proves ? find_places(broker, oscillator_of(found), found, &learned.places)
                                  : find_orbit(broker, oscillator_of(found), found, &learned.orbit);
        });
    }
    return searches;
}

void MultiStartCell::know_more() {
    for (Learned& learned : learned_) {
        const FoundAttractor& found = known_[learned.known].found;
        if (learned.orbit) table_.add(oscillator_of(found), found, std::move(*learned.orbit));
        table_.add(oscillator_of(found), found, learned.places);
    }
}

std::vector<SearchFactory> MultiStartCell::finish_starts() {
    kept_ = tally_.in_order();
    const bool asks_for_kicks = context_.scene.job().output.has(job::OptionalField::critical_kick);
    if (count() > 0) tell_attractors();
    if (!asks_for_kicks) return {};
    std::vector<SearchFactory> searches = orbits_to_kick();
    stage_ = Stage::orbits_to_kick;
    return searches.empty() ? begin_kicks() : searches;
}

void MultiStartCell::tell_attractors() {
    solved_.cell.attractors = static_cast<std::int32_t>(kept_.size());
    const auto kept = static_cast<std::size_t>(context_.of_starts.starts.attractors);
    keep_most(kept_, own_, context_.ends == Ends::firsts ? kept_.size() + 1 : kept);
    solved_.cell.start_attractor = slot_of(kept_, solved_.cell);
    for (const Tally::Entry& entry : kept_) {
        solved_.attractors.push_back(as_attractor(entry, count()));
        if (context_.ends == Ends::firsts) solved_.firsts.push_back({entry.result, entry.first});
    }
    tell_mean_life();
}

// Of chaos, or of what is chaotic for as long as it was followed.
void MultiStartCell::tell_mean_life() {
    const auto lives = [](const CellAttractor& each) {
        return each.regime == cell::Regime::chaotic || each.status == cell::Status::chaotic_so_far;
    };
    const auto slot = std::ranges::find_if(solved_.attractors, lives);
    if (slot == solved_.attractors.end()) return;
    slot->mean_life = life_.mean() * cell_.oscillator.period();
    slot->mean_life_error = life_.error() * cell_.oscillator.period();
}

std::vector<SearchFactory> MultiStartCell::begin_kicks() {
    stage_ = Stage::kicks;
    const Interval velocities = velocities_of(context_.of_starts.starts, cell_.scales);
    const double largest = std::max(std::abs(velocities.from), std::abs(velocities.to));
    kicks_.emplace(cell_.oscillator, kept_, largest, table_,
                   [this](const auto& start) { return search_from(start); });
    return next({});
}

void MultiStartCell::take_kicks() {
    if (count() == 0) solved_.cell.kick = kicks_->smallest(0);
    for (std::size_t slot = 0; slot < solved_.attractors.size(); ++slot) {
        solved_.attractors[slot].kick = kicks_->smallest(slot);
    }
}

scene::Oscillator<double> MultiStartCell::oscillator_of(const FoundAttractor& found) const {
    scene::Oscillator<double> oscillator = cell_.oscillator;
    oscillator.cubic = found.cubic;
    return oscillator;
}

}  // namespace peterka::attractors
