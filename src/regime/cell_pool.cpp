#include "regime/cell_pool.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "regime/growth.hpp"
#include "regime/solve_cell.hpp"
#include "support/reused_memory.hpp"
#include "support/stopwatch.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::regime {

namespace {

// Many cells fill the vectors of a batch, few stay in the cache: with so many no more are taken.
constexpr std::size_t capacity = 128;
// A group waits until it has so many, of those that go several cycles at once so many.
constexpr std::size_t enough_near = 64;
constexpr std::size_t enough_far = 128;
constexpr std::size_t most_in_hand = 768;  // with all that wait
constexpr std::size_t most_alone = 32;     // waiting cells, beyond which no more are taken
constexpr double seconds_alone = 0.2e-3;   // that a step may give to them

}  // namespace

// A search in hand.
struct CellPool::Member : Reused {
    Member(const Begin& begin, Findings findings, std::int64_t its_number)
        : number(its_number), search(begin(desk, findings == Findings::handed_on ? &found : nullptr)) {}

    std::int64_t number;
    CycleDesk desk;
    std::vector<FoundAttractor> found;
    Task<CellResult> search;
    std::int64_t engine = 0;     // of desk.engines_used(): that for which the batch was chosen
    std::optional<Batch> batch;  // none: its engine has none
    std::optional<ScalarEngine> scalar;
    double seconds = 0;
    double charged_before = 0;  // by each cell of the group, when this one came

    [[nodiscard]] Request request() const { return {desk.order().recorder != nullptr, desk.order().cycles}; }
    // A batch measures peak forces at most.
    [[nodiscard]] bool fits_batch() const {
        return batch && !(request().measures && desk.order().recorder->records_contacts());
    }
};

struct CellPool::Group {
    Group(const Request& its_request, const scene::Oscillator<double>& rig, const Batch& batch)
        : request(its_request), kind(batch), map(rig, few_cells, batch.steps, batch.springs) {}
    // Of cells with rigs of their own.
    Group(const Request& its_request, const Batch& batch)
        : request(its_request), kind(batch), map(few_cells, batch.steps, batch.springs) {}

    static constexpr std::size_t few_cells = 32;  // most groups have no more

    // Of searches that didn't end soon.
    [[nodiscard]] bool goes_far() const { return request.cycles >= Growth::block_cycles; }
    [[nodiscard]] bool is_full() const {
        // linear springs are what most cells have, and so the first to be many
        const bool many_come = kind.springs == batch::Springs::linear;
        return cells.size() >= (goes_far() && many_come ? enough_far : enough_near);
    }

    // Carries all cells through the cycles that they wait for.
    void advance() {
        if (request.cycles == 1) return map.advance({.measure = request.measures, .jacobian = true});
        if (course.size() < cells.size() * request.cycles) course.resize(cells.size() * request.cycles);
        largest_force.assign(cells.size(), 0);
        largest_displacement.assign(cells.size(), 0);
        for (std::size_t n = 0; n < request.cycles; ++n) {
            map.advance({.measure = request.measures, .jacobian = true});
            for (std::size_t slot = 0; slot < cells.size(); ++slot) {
                trajectory::Cycle<double>& cycle = course[slot * request.cycles + n];
                cycle = map.cycle(slot);
                // a cell that failed idles below the stop
                if (cycle.outcome != trajectory::Cycle<double>::Outcome::done) map.set_state(slot, {-1, 0});
                if (!request.measures) continue;
                largest_force[slot] = std::max(largest_force[slot], map.peak_force(slot));
                largest_displacement[slot] = std::max(largest_displacement[slot], map.displacement_bound(slot));
            }
        }
    }
    // Tells the search in a slot what they were; of a cycle behind one that failed, nothing.
    void tell(std::size_t slot) {
        CycleDesk& desk = cells[slot]->desk;
        trajectory::Recorder<double>* recorder = desk.order().recorder;
        if (request.cycles == 1) {
            const trajectory::Cycle<double> cycle = map.cycle(slot);
            if (request.measures) {
                recorder->cycles(cycle.impacts, map.peak_force(slot), map.displacement_bound(slot));
            }
            return desk.serve({&cycle, 1});
        }
        auto cycles = std::span(course).subspan(slot * request.cycles, request.cycles);
        const auto failed = std::ranges::find_if(cycles, [](const trajectory::Cycle<double>& cycle) {
            return cycle.outcome != trajectory::Cycle<double>::Outcome::done;
        });
        if (failed != cycles.end())
            cycles = cycles.first(static_cast<std::size_t>(failed - cycles.begin()) + 1);
        if (request.measures) {
            int impacts = 0;
            for (const auto& cycle : cycles) impacts += cycle.impacts;
            recorder->cycles(impacts, largest_force[slot], largest_displacement[slot]);
        }
        desk.serve(cycles);
    }

    Request request;
    Batch kind;
    batch::BatchedCycleMap map;
    std::vector<std::unique_ptr<Member>> cells;  // by slot of the map
    // Of several cycles: those of a slot side by side, and largest values over them.
    std::vector<trajectory::Cycle<double>> course;
    std::vector<double> largest_force;
    std::vector<double> largest_displacement;
    double charged = 0;  // by each cell that was there all the time [s]
    double last_step_seconds = 0;
};

CellPool::CellPool(const scene::Scene& scene, const AttractorTable& known, Take take, Findings findings)
    : scene_(scene), known_(known), take_(std::move(take)), findings_(findings), free_(scene) {}
CellPool::~CellPool() = default;

bool CellPool::has_room() const {
    if (alone_.size() >= most_alone || in_hand_ >= most_in_hand) return false;
    std::size_t waiting = 0;
    for (const Group& group : groups_) {
        if (!group.is_full())
            waiting += group.cells.size();
        else if (group.goes_far())
            return false;
    }
    return in_hand_ - waiting < capacity;
}

void CellPool::add(std::int64_t row, std::int64_t column, std::int64_t number) {
    const scene::Cell place = scene_.cell(row, column);
    // that takes less time than a look at the clock
    if (const auto result = free_.told_by_another(place)) return take_({number, *result, 0, {}});
    const Stopwatch stopwatch;
    if (const auto result = free_.find(place)) return take_({number, *result, stopwatch.seconds(), {}});
    add(
        [&](CycleDesk& desk, auto* found) {
            return solve_cell(desk, scene_.job(), place, {&known_, found});
        },
        number);
}

void CellPool::add(const Begin& begin, std::int64_t number) {
    auto cell = std::make_unique<Member>(begin, findings_, number);
    ++in_hand_;
    ++searches_;
    const Stopwatch stopwatch;
    cell->search.start();
    cell->seconds = stopwatch.seconds();
    if (cell->search.done()) return finish(*cell);
    enter(std::move(cell));
}

// Where its engine has one.
std::optional<CellPool::Batch> CellPool::batch_of(const CycleDesk& desk) {
    const EngineSettings& settings = desk.settings();
    const scene::Oscillator<double>& oscillator = desk.oscillator();
    if (!has_batch(oscillator, settings.engine)) return std::nullopt;
    if (settings.engine == Engine::exact || oscillator.cubic == 0) {
        return Batch{batch::Springs::linear, batch::BatchedCycleMap::steps_for(oscillator.frequency)};
    }
    const int steps = trajectory::split_steps(oscillator, settings.largest_displacement, settings.tolerance);
    if (steps == 0) return std::nullopt;
    return Batch{batch::Springs::split, steps};
}

CellPool::Group& CellPool::group_for(const Member& cell) {
    const Request request = cell.request();
    const auto suits = [&](const Group& group) {
        return group.request == request && group.kind == *cell.batch;
    };
    const auto found = std::ranges::find_if(groups_, suits);
    if (found != groups_.end()) return *found;
    if (scene_.rigs_differ()) return groups_.emplace_back(request, *cell.batch);
    return groups_.emplace_back(request, cell.desk.oscillator(), *cell.batch);
}

// Puts a cell whose search waits where its order is served.
void CellPool::enter(std::unique_ptr<Member> cell) {
    if (cell->engine != cell->desk.engines_used()) {
        cell->engine = cell->desk.engines_used();
        cell->batch = batch_of(cell->desk);
    }
    if (!cell->fits_batch()) {
        alone_.push_back(std::move(cell));
    } else {
        enqueue(std::move(cell));
    }
}

void CellPool::enqueue(std::unique_ptr<Member> cell) {
    const scene::Oscillator<double>& oscillator = cell->desk.oscillator();
    Group& group = group_for(*cell);
    if (scene_.rigs_differ()) {
        group.map.add(oscillator, cell->desk.order().from);
    } else {
        group.map.add(oscillator.frequency, oscillator.gap, cell->desk.order().from);
    }
    put_in(group, std::move(cell));
}

void CellPool::step() {
    bool waits = true;
    for (Group& group : groups_) {  // on the way more may be appended
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

void CellPool::advance(Group& group) {
    // Each cell is charged for the step before: those that leave in this one were charged when they came.
    group.charged += group.last_step_seconds / static_cast<double>(group.cells.size());
    const Stopwatch stopwatch;
    group.advance();
    // from the back: the cell that takes the slot of one that leaves has been served already
    for (std::size_t slot = group.cells.size(); slot-- > 0;) serve(group, slot);
    group.last_step_seconds = stopwatch.seconds();
}

void CellPool::serve(Group& group, std::size_t slot) {
    Member& cell = *group.cells[slot];
    group.tell(slot);
    if (cell.search.done()) return finish(*leave(group, slot));
    if (cell.engine != cell.desk.engines_used() || !cell.fits_batch()) return enter(leave(group, slot));
    if (cell.request() != group.request) return move(group, slot);
    group.map.set_state(slot, cell.desk.order().from);
}

std::unique_ptr<CellPool::Member> CellPool::take_out(Group& group, std::size_t slot) {
    std::unique_ptr<Member> cell = std::move(group.cells[slot]);
    group.cells[slot] = std::move(group.cells.back());
    group.cells.pop_back();
    cell->seconds += group.charged - cell->charged_before;
    return cell;
}

std::unique_ptr<CellPool::Member> CellPool::leave(Group& group, std::size_t slot) {
    group.map.remove(slot);
    return take_out(group, slot);
}

void CellPool::put_in(Group& group, std::unique_ptr<Member> cell) {
    cell->charged_before = group.charged;
    group.cells.push_back(std::move(cell));
}

// To the batch of its new request.
void CellPool::move(Group& from, std::size_t slot) {
    Group& to = group_for(*from.cells[slot]);
    to.map.take(from.map, slot);
    to.map.set_state(to.map.size() - 1, from.cells[slot]->desk.order().from);
    put_in(to, take_out(from, slot));
}

void CellPool::serve_alone() {
    const Stopwatch stopwatch;
    Member& cell = *alone_.front();
    if (!cell.scalar) cell.scalar.emplace();
    const auto stays = [&] {
        return !cell.search.done() && cell.engine == cell.desk.engines_used() && !cell.fits_batch();
    };
    do {
        cell.scalar->serve(cell.desk);
    } while (stays() && stopwatch.seconds() < seconds_alone);
    cell.seconds += stopwatch.seconds();
    if (stays()) return;
    std::unique_ptr<Member> front = std::move(alone_.front());
    alone_.pop_front();
    if (front->search.done()) return finish(*front);
    enter(std::move(front));
}

void CellPool::finish(const Member& cell) {
    --in_hand_;
    take_({cell.number, cell.search.result(), cell.seconds, cell.found});
}

}  // namespace peterka::regime
