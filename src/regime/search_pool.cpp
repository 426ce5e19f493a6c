#include "regime/search_pool.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "regime/solve_cell.hpp"
#include "support/reused_memory.hpp"
#include "support/stopwatch.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::regime {

namespace {

// A group waits until it has `enough` cells: many fill the vectors of a batch, few stay in the cache. Once the
// groups that don't wait hold as many, no more are taken.
constexpr std::size_t enough = 128;
constexpr std::size_t most_in_hand = 768;  // including those that wait
constexpr std::size_t most_alone = 32;     // waiting cells, beyond which no more are taken
constexpr double seconds_alone = 0.2e-3;   // that a step may spend on them

}  // namespace

// A search in progress.
struct SearchPool::Member : Reused {
    Member(const SearchFactory& begin, std::int64_t its_number, bool has_own_rig)
        : number(its_number), own_rig(has_own_rig), search(begin(broker)) {}

    std::int64_t number;
    bool own_rig;  // that others in its batch needn't have
    CycleBroker broker;
    Task<SearchOutcome> search;
    std::int64_t engine = 0;     // broker.engines_used() for which the batch was chosen
    std::optional<Batch> batch;  // none: its engine has none
    std::optional<ScalarEngine> scalar;
    double seconds = 0;
    double charged_before = 0;  // to each cell of the group, before this one joined

    std::vector<trajectory::Cycle<double>, ReusingAllocator<trajectory::Cycle<double>>>
        course;  // the cycles of the order, so far

    // A batch measures at most peak forces, and cycle by cycle: chatter may extend across the end of a cycle
    // where a rigid stop presses at phase 0.
    [[nodiscard]] bool fits_batch() const {
        if (!batch) return false;
        const trajectory::Recorder<double>* recorder = broker.order().recorder;
        if (recorder == nullptr) return true;
        const bool crosses = batch->stop == batch::Stop::rigid && broker.oscillator().gap < 0;
        return !(recorder->records_contacts() || crosses);
    }
};

struct SearchPool::Group {
    Group(const scene::Oscillator<double>& rig, const Batch& batch)
        : kind(batch), map(rig, few_cells, batch.steps, batch.springs) {}
    // For cells with rigs of their own.
    explicit Group(const Batch& batch) : kind(batch), map(few_cells, batch.steps, batch.springs, batch.stop) {}

    static constexpr std::size_t few_cells = 32;  // most groups have no more

    [[nodiscard]] bool is_full() const { return cells.size() >= enough; }

    void advance() { map.advance_partly(); }
    // Records the cycle of a slot; returns whether it is the last of its order.
    [[nodiscard]] bool record(std::size_t slot) {
        Member& cell = *cells[slot];
        cell.course.push_back(map.cycle(slot));
        if (trajectory::Recorder<double>* recorder = cell.broker.order().recorder)
            recorder->cycles(map.totals(slot));
        return cell.course.size() == cell.broker.order().cycles ||
               cell.course.back().outcome != trajectory::Cycle<double>::Outcome::done;
    }
    // Returns the recorded cycles to the search in a slot.
    void tell(std::size_t slot) {
        Member& cell = *cells[slot];
        cell.broker.serve(cell.course);
        cell.course.clear();
    }

    Batch kind;
    batch::BatchedCycleMap map;
    std::vector<std::unique_ptr<Member>> cells;  // by slot of the map
    double charged = 0;                          // to each cell that was present all the time [s]
    double last_step_seconds = 0;
};

SearchPool::SearchPool(const scene::Scene& scene, const AttractorTable& known, Take take, Attractors attractors)
    : scene_(scene), known_(known), take_(std::move(take)), attractors_(attractors), free_(scene) {}
SearchPool::~SearchPool() = default;

bool SearchPool::has_room() const {
    if (alone_.size() >= most_alone || in_hand_ >= most_in_hand) return false;
    std::size_t waiting = 0;
    for (const Group& group : groups_) {
        if (!group.is_full()) waiting += group.cells.size();
    }
    return in_hand_ - waiting < enough;
}

void SearchPool::add(std::int64_t row, std::int64_t column, std::int64_t number) {
    const scene::Cell place = scene_.cell(row, column);
    // this takes less time than reading the clock
    if (const auto result = free_.told_by_another(place)) return hand_over({number, {.result = *result}, 0});
    const Stopwatch stopwatch;
    if (const auto result = free_.find(place))
        return hand_over({number, {.result = *result}, stopwatch.seconds()});
    add(
        [&](CycleBroker& broker) {
            const SearchContext context{.known = &known_};
            return attractors_ == Attractors::reported
                       ? search_cell(broker, scene_.job(), place, context)
                       : outcome_of(solve_cell(broker, scene_.job(), place, context));
        },
        number);
}

void SearchPool::add(const SearchFactory& begin, std::int64_t number, Rigs rigs) {
    auto cell = std::make_unique<Member>(begin, number, rigs == Rigs::of_each || scene_.rigs_differ());
    ++in_hand_;
    ++searches_;
    const Stopwatch stopwatch;
    cell->search.start();
    cell->seconds = stopwatch.seconds();
    if (cell->search.done()) return finish(*cell);
    enter(std::move(cell));
}

// The batch for the broker's engine, if it has one.
std::optional<SearchPool::Batch> SearchPool::batch_of(const CycleBroker& broker) {
    const EngineSettings& settings = broker.settings();
    const scene::Oscillator<double>& oscillator = broker.oscillator();
    if (!has_batch(oscillator, settings.engine)) return std::nullopt;
    const batch::Stop stop =
        scene::is_rigid(oscillator.contact) ? batch::Stop::rigid : batch::Stop::spring_dashpot;
    if (settings.engine == Engine::exact || oscillator.cubic == 0) {
        return Batch{batch::Springs::linear, batch::BatchedCycleMap::steps_for(oscillator.frequency), stop};
    }
    const int steps = trajectory::split_steps(oscillator, settings.largest_displacement, settings.tolerance);
    if (steps == 0) return std::nullopt;
    return Batch{batch::Springs::split, steps, stop};
}

SearchPool::Group& SearchPool::group_for(const Member& cell) {
    const auto found = std::ranges::find(groups_, *cell.batch, &Group::kind);
    if (found != groups_.end()) return *found;
    if (cell.own_rig) return groups_.emplace_back(*cell.batch);
    return groups_.emplace_back(cell.broker.oscillator(), *cell.batch);
}

// Moves a waiting cell to where its order is served.
void SearchPool::enter(std::unique_ptr<Member> cell) {
    if (cell->engine != cell->broker.engines_used()) {
        cell->engine = cell->broker.engines_used();
        cell->batch = batch_of(cell->broker);
        if (cell->batch) cell->batch->rigs_differ = cell->own_rig;
    }
    if (!cell->fits_batch()) {
        alone_.push_back(std::move(cell));
        return;
    }
    const scene::Oscillator<double>& oscillator = cell->broker.oscillator();
    Group& group = group_for(*cell);
    if (cell->own_rig) {
        group.map.add(oscillator, cell->broker.order().from);
    } else {
        group.map.add(oscillator.frequency, oscillator.gap, cell->broker.order().from);
    }
    cell->charged_before = group.charged;
    group.cells.push_back(std::move(cell));
}

void SearchPool::step() {
    bool waits = true;
    for (Group& group : groups_) {  // more may be appended meanwhile
        if (!group.is_full()) continue;
        advance(group);
        waits = false;
    }
    if (!alone_.empty()) return serve_alone();
    if (!waits) return;
    const auto most =
        std::ranges::max_element(groups_, {}, [](const Group& group) { return group.cells.size(); });
    if (most != groups_.end() && !most->cells.empty()) advance(*most);
}

void SearchPool::advance(Group& group) {
    // Each cell is charged for the step before: those that leave in this one were charged when they came.
    group.charged += group.last_step_seconds / static_cast<double>(group.cells.size());
    elsewhere_ = 0;
    const Stopwatch stopwatch;
    group.advance();
    // from the back: the cell that takes the slot of one that leaves has had its turn already
    for (std::size_t slot = group.cells.size(); slot-- > 0;) {
        if (group.map.is_at_end(slot) && group.record(slot)) serve(group, slot);
    }
    group.last_step_seconds = stopwatch.seconds() - elsewhere_;
}

void SearchPool::serve(Group& group, std::size_t slot) {
    Member& cell = *group.cells[slot];
    group.tell(slot);
    if (cell.search.done()) return finish(*leave(group, slot));
    if (cell.engine != cell.broker.engines_used() || !cell.fits_batch()) return enter(leave(group, slot));
    group.map.set_state(slot, cell.broker.order().from);
}

std::unique_ptr<SearchPool::Member> SearchPool::leave(Group& group, std::size_t slot) {
    group.map.remove(slot);
    std::unique_ptr<Member> cell = std::move(group.cells[slot]);
    group.cells[slot] = std::move(group.cells.back());
    group.cells.pop_back();
    cell->seconds += group.charged - cell->charged_before;
    return cell;
}

void SearchPool::serve_alone() {
    const Stopwatch stopwatch;
    Member& cell = *alone_.front();
    if (!cell.scalar) cell.scalar.emplace();
    const auto stays = [&] {
        return !cell.search.done() && cell.engine == cell.broker.engines_used() && !cell.fits_batch();
    };
    do {
        cell.scalar->serve(cell.broker);
    } while (stays() && stopwatch.seconds() < seconds_alone);
    cell.seconds += stopwatch.seconds();
    if (stays()) return;
    std::unique_ptr<Member> front = std::move(alone_.front());
    alone_.pop_front();
    if (front->search.done()) return finish(*front);
    enter(std::move(front));
}

void SearchPool::finish(const Member& member) {
    --in_hand_;
    hand_over({member.number, member.search.result(), member.seconds});
}

}  // namespace peterka::regime
