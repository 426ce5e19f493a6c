#include "attractors/multi_start_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "attractors/continued_motion.hpp"
#include "attractors/drawn_cells.hpp"
#include "attractors/start_sequence.hpp"
#include "regime/same_orbit.hpp"
#include "regime/solve_cell.hpp"

namespace peterka::attractors {

namespace {

using regime::CellResult;
using regime::CycleBroker;
using regime::FoundAttractor;

// Rounds have 1, 3, 4, 4, 4, 4, 5, 6, 7, ..., 256, 256, ... starts: each start knows the
// results of about four fifths of the starts up to then.
constexpr std::int64_t largest_round = 256;

std::int64_t size_of_round(std::int64_t begun) {
    return begun <= 1 ? 1 + 2 * begun : std::clamp<std::int64_t>(begun / 4, 4, largest_round);
}

// A start that ends in a neighbourhood saves about two periods of the orbit, needed to see its convergence to
// the known orbit; proving a neighbourhood takes some 200 or 300 periods.
constexpr double starts_worth_a_proof = 150;

job::Job of_starts(job::Job job) {
    job.output.fields.clear();
    return job;
}

// A rigid stop has no peak force: the largest impact speed takes its place.
job::Job of_rigs(job::Job job) {
    job.output.fields.clear();
    if (is_rigid(job.contact)) job.output.fields.push_back(job::OptionalField::impact_speed);
    return job;
}

Task<SearchOutcome> find_orbit(CycleBroker& broker, scene::Oscillator<double> oscillator,
                               FoundAttractor found) {
    SearchOutcome learned;
    learned.orbit = co_await regime::find_known_orbit(broker, oscillator, found, &learned.cycles);
    co_return learned;
}

Task<SearchOutcome> find_neighbourhoods(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                        FoundAttractor found) {
    regime::Places proved = co_await regime::find_places(broker, oscillator, found, 1);
    co_return SearchOutcome{.neighbourhoods = std::move(proved.neighbourhoods), .cycles = proved.cycles};
}

}  // namespace

MapContext::MapContext(const scene::Scene& map, const regime::AttractorTable& known_before, Ends ends_of_starts)
    : scene(map),
      known(known_before),
      of_starts(attractors::of_starts(map.job())),
      of_short_starts(of_starts),
      of_rigs(attractors::of_rigs(map.job())),
      ends(ends_of_starts) {
    of_short_starts.steady_state = Prospects::smaller(of_starts.steady_state);
    if (map.job().uncertainty.rigs > 0) uncertain.emplace(map.job());
}

MultiStartCell::MultiStartCell(const MapContext& context, std::int64_t row, std::int64_t column)
    : context_(context),
      row_(row),
      column_(column),
      cell_(context.scene.cell(row, column)),
      chaos_may_end_(cell_.oscillator.gap < 0 || may_stay_free(cell_.oscillator)) {}

MultiStartCell::MultiStartCell(const MapContext& context, std::int64_t row, std::int64_t column,
                               const scene::State<double>& start)
    : MultiStartCell(context, row, column) {
    cell_.start = start;
}

Task<SolvedCell> MultiStartCell::solve(SearchBroker& broker) {
    for (;;) {
        take_starts(co_await broker.searches(next_starts()));
        if (seen_ == count()) break;
        know_more(co_await broker.searches(attractors_worth_knowing()));
    }
    kept_ = tally_.in_order();
    if (count() > 0) tell_attractors();
    if (context_.scene.job().output.has(job::OptionalField::critical_kick)) {
        know_more(co_await broker.searches(orbits_to_kick()));
        const KickedCell kicked = this->kicked();
        tell_kicks(co_await smallest_kicks(broker, kicked, kept_));
    }
    if (context_.uncertain) {
        DrawnRigs rigs = drawn_rigs();
        const regime::Rigs whose =
            context_.uncertain->rigs_differ() ? regime::Rigs::of_each : regime::Rigs::of_scene;
        const auto ended = co_await broker.searches(std::move(rigs.searches), whose);
        tell_outcomes(rigs, ended);
    }
    constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
    solved_.cell.cycles = static_cast<std::int32_t>(std::min(broker.cycles(), most));
    co_return std::move(solved_);
}

std::vector<SearchFactory> MultiStartCell::next_starts() {
    std::vector<SearchFactory> searches;
    if (begun_ == 0) {
        searches.emplace_back([this](CycleBroker& broker) {
            return regime::search_cell(broker, context_.scene.job(), cell_, {.known = &context_.known});
        });
    }
    const std::int64_t end = std::min(count(), begun_ + size_of_round(begun_));
    for (; begun_ < end; ++begun_) {
        searches.push_back(search_from(start_of(context_.of_starts.starts, cell_, begun_), sooner()));
    }
    return searches;
}

SearchFactory MultiStartCell::search_from(const scene::State<double>& start, EarlyVerdict sooner) const {
    return [this, start, sooner](CycleBroker& broker) {
        return regime::search_cell(broker, sooner.unresolved ? context_.of_short_starts : context_.of_starts,
                                   {cell_.oscillator, start}, {.known = &table_, .chaos = sooner.chaos});
    };
}

// Where chaos may end on an impact-free motion, only a full run tells whether a start has left the chaos.
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
        const auto known = std::ranges::find_if(known_, [&](const CountedAttractor& other) {
            return other.found.cubic == each.cubic &&
                   regime::same_map(oscillator_of(each), other.found.settings, each.settings) &&
                   regime::same_orbit(other.found.result, each.result);
        });
        CountedAttractor& entry = known != known_.end() ? *known : known_.emplace_back(CountedAttractor{each});
        if (!entry.found.by_cubic) entry.found.by_cubic = each.by_cubic;
        ++entry.times;
    }
}

// Expected number among the starts to come, estimated from those before.
double MultiStartCell::expected(const CountedAttractor& known) const {
    return static_cast<double>(known.times) / static_cast<double>(seen_ + 1) *
           static_cast<double>(count() - seen_);
}

bool MultiStartCell::is_worth_following(const CountedAttractor& known) const {
    return !known.followed && expected(known) >= 1;
}

bool MultiStartCell::is_worth_proving(const CountedAttractor& known) const {
    return !known.tried && expected(known) >= starts_worth_a_proof;
}

std::vector<SearchFactory> MultiStartCell::attractors_worth_knowing() {
    learning_.clear();
    std::vector<SearchFactory> searches;
    for (std::size_t i = 0; i < known_.size(); ++i) {
        learn(i, is_worth_following(known_[i]), is_worth_proving(known_[i]), searches);
    }
    return searches;
}

// Every orbit is worth following and proving: kicks are many, and most of them lead back.
std::vector<SearchFactory> MultiStartCell::orbits_to_kick() {
    learning_.clear();
    std::vector<SearchFactory> searches;
    for (std::size_t i = 0; i < known_.size(); ++i) {
        learn(i, !known_[i].followed, !known_[i].tried, searches);
    }
    return searches;
}

void MultiStartCell::learn(std::size_t known, bool follows, bool proves, std::vector<SearchFactory>& searches) {
    const FoundAttractor& found = known_[known].found;
    known_[known].followed |= follows;
    known_[known].tried |= proves;
    if (follows) {
        searches.emplace_back([oscillator = oscillator_of(found), found](CycleBroker& broker) {
            return find_orbit(broker, oscillator, found);
        });
    }
    if (proves) {
        searches.emplace_back([oscillator = oscillator_of(found), found](CycleBroker& broker) {
            return find_neighbourhoods(broker, oscillator, found);
        });
    }
    learning_.resize(searches.size(), known);
}

void MultiStartCell::know_more(std::vector<SearchOutcome> learned) {
    for (std::size_t i = 0; i < learned.size(); ++i) {
        const FoundAttractor& found = known_[learning_[i]].found;
        if (learned[i].orbit) table_.add(oscillator_of(found), found, std::move(*learned[i].orbit));
        table_.add(oscillator_of(found), found, learned[i].neighbourhoods);
    }
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

// The mean life of chaos, or of a motion that is chaotic for as long as it was followed.
void MultiStartCell::tell_mean_life() {
    const auto lives = [](const CellAttractor& each) {
        return each.regime == cell::Regime::chaotic || each.status == cell::Status::chaotic_so_far;
    };
    const auto slot = std::ranges::find_if(solved_.attractors, lives);
    if (slot == solved_.attractors.end()) return;
    slot->mean_life = life_.mean() * cell_.oscillator.period();
    slot->mean_life_error = life_.error() * cell_.oscillator.period();
}

KickedCell MultiStartCell::kicked() const {
    const Interval velocities = velocities_of(context_.of_starts.starts, cell_.scales);
    const double largest = std::max(std::abs(velocities.from), std::abs(velocities.to));
    return {cell_.oscillator, largest, table_, [this](const auto& start) { return search_from(start); }};
}

void MultiStartCell::tell_kicks(std::span<const cell::Kick> kicks) {
    if (count() == 0 && !kicks.empty()) solved_.cell.kick = kicks.front();
    for (std::size_t slot = 0; slot < solved_.attractors.size(); ++slot) {
        solved_.attractors[slot].kick = kicks[slot];
    }
}

// Where the cell's own motion ends without impact, most others do at once.
MultiStartCell::DrawnRigs MultiStartCell::drawn_rigs() const {
    DrawnRigs rigs;
    const job::Job& job = context_.of_rigs;
    const DrawnCells cells(*context_.uncertain, job, row_, column_, cell_.scales);
    const bool is_free = solved_.cell.regime == regime::Regime::no_impact;
    for (std::int64_t n = 0; n < cells.count(); ++n) {
        const scene::Cell drawn = cells.cell(n);
        rigs.scales.push_back(drawn.scales);
        rigs.ends.push_back(is_free ? regime::solve_at_once(job, drawn) : std::nullopt);
        if (rigs.ends.back()) continue;
        rigs.searches.emplace_back([&job, drawn](CycleBroker& broker) {
            return regime::outcome_of(regime::solve_cell(broker, job, drawn));
        });
    }
    return rigs;
}

void MultiStartCell::tell_outcomes(const DrawnRigs& rigs, const std::vector<SearchOutcome>& ended) {
    Outcomes outcomes(cell_);
    auto searched = ended.begin();
    for (std::size_t n = 0; n < rigs.ends.size(); ++n) {
        const regime::CellResult& end = rigs.ends[n] ? *rigs.ends[n] : (searched++)->result;
        outcomes.add(end, rigs.scales[n]);
        if (context_.ends == Ends::told) solved_.ends_of_rigs.push_back(end);
    }
    outcomes.tell(solved_);
}

scene::Oscillator<double> MultiStartCell::oscillator_of(const FoundAttractor& found) const {
    scene::Oscillator<double> oscillator = cell_.oscillator;
    oscillator.cubic = found.cubic;
    return oscillator;
}

}  // namespace peterka::attractors
