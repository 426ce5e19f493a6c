// Several tasks that order searches, each at a broker of its own, as one: what they wait for is ordered
// together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include "attractors/search_broker.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

// The results of begin(0, broker), ..., begin(count - 1, broker), in this order.
template <class T>
[[nodiscard]] Task<std::vector<T>> side_by_side(SearchBroker& broker, std::size_t count,
                                                std::function<Task<T>(std::size_t, SearchBroker&)> begin) {
    std::deque<SearchBroker> brokers(count);
    std::vector<Task<T>> tasks;
    for (std::size_t i = 0; i < count; ++i) tasks.push_back(begin(i, brokers[i]));
    for (const Task<T>& task : tasks) task.start();
    for (;;) {
        std::vector<SearchFactory> ordered;
        for (std::size_t i = 0; i < count; ++i) {
            if (tasks[i].done()) continue;
            std::ranges::copy(brokers[i].ordered(), std::back_inserter(ordered));
        }
        if (ordered.empty()) break;
        std::vector<SearchOutcome> outcomes = co_await broker.searches(std::move(ordered));
        auto next = std::make_move_iterator(outcomes.begin());
        for (std::size_t i = 0; i < count; ++i) {
            if (tasks[i].done()) continue;
            const auto end = next + static_cast<std::ptrdiff_t>(brokers[i].ordered().size());
            brokers[i].serve({next, end});
            next = end;
        }
    }
    std::vector<T> results;
    results.reserve(count);
    for (const Task<T>& task : tasks) results.push_back(task.result());
    co_return results;
}

}  // namespace peterka::attractors
