// The interface of all topics of a study.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "map_file/table.hpp"

namespace peterka::study {

using map_file::Table;

// A topic is a list of tasks, each a pure function of the job and its number except for measured times. Results
// are sent between ranks as bytes.
template <class Candidate>
concept Topic = std::is_trivially_copyable_v<typename Candidate::Result> &&
    requires(const Candidate& topic, std::int64_t task, std::span<const typename Candidate::Result> results) {
    { topic.tasks() } -> std::same_as<std::int64_t>;
    { topic.solve(task) } -> std::same_as<typename Candidate::Result>;
    // in the order of the file: a scale before the variables that have it as a dimension
    { topic.tables(results) } -> std::same_as<std::vector<Table>>;
    { topic.summary(results) } -> std::same_as<std::string>;
};

}  // namespace peterka::study
