#include "attractors/multi_start_pool.hpp"

#include <utility>

#include "regime/solve_cell.hpp"
#include "support/expect.hpp"

namespace peterka::attractors {

MultiStartPool::MultiStartPool(const scene::Scene& scene, const regime::AttractorTable& known, Take take,
                               Ends ends)
    : context_(scene, known, ends),
      searches_many_(scene.job().starts.count > 0 || context_.uncertain ||
                     scene.job().output.has(job::OptionalField::critical_kick)),
      take_(std::move(take)),
      pool_(
          scene, known, [this](auto& search) { keep(search); },
          searches_many_ ? regime::SearchPool::Attractors::reported : regime::SearchPool::Attractors::dropped) {
}

void MultiStartPool::add(std::int64_t row, std::int64_t column, std::int64_t number) {
    if (!searches_many_)
        return pool_.add(row, column, number);  // a single search, whose findings are not needed
    open(number, {context_, row, column});
}

void MultiStartPool::add(std::int64_t row, std::int64_t column, const scene::State<double>& start,
                         std::int64_t number) {
    if (searches_many_) return open(number, {context_, row, column, start});
    const scene::Cell cell{context_.scene.cell(row, column).oscillator, start};
    pool_.add(
        [&](CycleBroker& broker) {
            return regime::outcome_of(
                regime::solve_cell(broker, context_.scene.job(), cell, {.known = &context_.known}));
        },
        number);
}

void MultiStartPool::open(std::int64_t number, MultiStartCell begun) {
    Open& cell = *cells_.emplace(number, std::make_unique<Open>(std::move(begun))).first->second;
    cell.task.start();
    begin_searches(number, cell);
    fill_pool();
}

void MultiStartPool::step() {
    fill_pool();
    if (!pool_.empty()) pool_.step();
}

// A search may end as soon as it is added, and then more may be waiting.
void MultiStartPool::fill_pool() {
    while (!waiting_.empty() && pool_.has_room()) {
        const Waiting next = std::move(waiting_.front());
        waiting_.pop_front();
        pool_.add(next.begin, next.number, next.rigs);
    }
}

// Begins the searches that the cell waits for; a cell without any is solved.
void MultiStartPool::begin_searches(std::int64_t number, Open& cell) {
    if (cell.task.done()) {
        NumberedCell solved{number, cell.task.result(), cell.seconds};
        cells_.erase(number);
        return take_(solved);
    }
    const std::vector<SearchFactory>& ordered = cell.broker.ordered();
    cell.ended.resize(ordered.size());
    cell.running = ordered.size();
    for (std::size_t place = 0; place < ordered.size(); ++place) {
        searches_.emplace(next_search_, std::pair(number, place));
        waiting_.push_back({ordered[place], next_search_++, cell.broker.rigs()});
    }
}

void MultiStartPool::keep(regime::SearchPool::NumberedOutcome& search) {
    if (!searches_many_) {
        NumberedCell solved{search.number, {search.outcome.result, {}}, search.seconds};
        return take_(solved);
    }
    const auto where = searches_.find(search.number);
    PETERKA_EXPECT(where != searches_.end());
    const auto [number, place] = where->second;
    searches_.erase(where);
    Open& cell = *cells_.at(number);
    PETERKA_EXPECT(place < cell.ended.size() && cell.running > 0);
    cell.ended[place] = std::move(search.outcome);
    cell.seconds += search.seconds;
    if (--cell.running > 0) return;
    cell.broker.serve(std::exchange(cell.ended, {}));
    begin_searches(number, cell);
}

}  // namespace peterka::attractors
