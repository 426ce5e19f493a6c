// The topic of a study job, ready to be computed.
#pragma once

#include <variant>

#include "study/labels.hpp"
#include "study/stability.hpp"
#include "study/table.hpp"
#include "study/work_precision.hpp"

namespace peterka::study {

static_assert(Topic<WorkPrecision> && Topic<Labels> && Topic<Stability>);

using AnyTopic = std::variant<WorkPrecision, Labels, Stability>;

[[nodiscard]] inline AnyTopic make_topic(const job::Job& job) {
    switch (job.study.topic) {
        case job::StudyTopic::labels:
            return Labels(job);
        case job::StudyTopic::stability:
            return Stability(job);
        case job::StudyTopic::work_precision:
            break;
    }
    return WorkPrecision(job);
}

[[nodiscard]] inline std::int64_t count_tasks(const job::Job& job) {
    return std::visit([](const auto& topic) { return topic.tasks(); }, make_topic(job));
}

}  // namespace peterka::study
