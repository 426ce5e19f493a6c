// The words of the job file for each choice.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

template <typename Choice>
struct Named {
    Choice value;
    std::string_view name;
};
template <typename Choice>
Named(Choice, std::string_view) -> Named<Choice>;

template <typename Choice>
struct Names;

template <>
struct Names<Kind> {
    static constexpr std::array all{Named{Kind::map, "map"},     Named{Kind::basin, "basin"},
                                    Named{Kind::sweep, "sweep"}, Named{Kind::study, "study"},
                                    Named{Kind::trace, "trace"}, Named{Kind::curves, "curves"}};
};

template <>
struct Names<TraceBegin> {
    static constexpr std::array all{Named{TraceBegin::start, "start"},
                                    Named{TraceBegin::steady_state, "steady_state"}};
};

template <>
struct Names<StudyTopic> {
    static constexpr std::array all{Named{StudyTopic::work_precision, "work_precision"},
                                    Named{StudyTopic::labels, "labels"},
                                    Named{StudyTopic::stability, "stability"}};
};

template <class... Laws>
constexpr std::array<Named<ContactLaw>, sizeof...(Laws)> names_of_laws(
    const std::variant<Laws...>* /*contact*/) {
    return {Named<ContactLaw>{Laws::law, Laws::name}...};
}

template <>
struct Names<ContactLaw> {
    static constexpr auto all = names_of_laws(static_cast<const Contact*>(nullptr));
};

template <>
struct Names<EngineChoice> {
    static constexpr std::array all{Named{EngineChoice::automatic, "auto"}, Named{EngineChoice::exact, "exact"},
                                    Named{EngineChoice::split, "split"}, Named{EngineChoice::cvode, "cvode"},
                                    Named{EngineChoice::arkode, "arkode"}};
};

template <>
struct Names<CubicForm> {
    static constexpr std::array all{Named{CubicForm::relative, "relative"},
                                    Named{CubicForm::absolute, "absolute"}};
};

template <>
struct Names<Spacing> {
    static constexpr std::array all{Named{Spacing::linear, "linear"}, Named{Spacing::log, "log"}};
};

template <>
struct Names<Direction> {
    static constexpr std::array all{Named{Direction::up, "up"}, Named{Direction::down, "down"},
                                    Named{Direction::both, "both"},
                                    Named{Direction::independent, "independent"}};
};

// Their names in the table of quantities; if several rows share a field, that of the first.
template <>
struct Names<OptionalField> {
    static constexpr std::size_t count = [] {
        std::size_t last = 0;
        const auto take = [&](OptionalField field, const char*) {
            last = std::max(last, static_cast<std::size_t>(field));
        };
        cell::for_each_field_of(cell::quantities, take);
        cell::for_each_field_of(cell::attractor_quantities, take);
        return last + 1;
    }();
    static constexpr auto all = [] {
        std::array<Named<OptionalField>, count> names{};
        const auto take = [&](OptionalField field, const char* name) {
            auto& named = names.at(static_cast<std::size_t>(field));
            if (named.name.empty()) named = {field, name};
        };
        cell::for_each_field_of(cell::quantities, take);
        cell::for_each_field_of(cell::attractor_quantities, take);
        return names;
    }();
};

template <typename Choice>
[[nodiscard]] constexpr std::string_view name(Choice value) {
    for (const auto& named : Names<Choice>::all) {
        if (named.value == value) return named.name;
    }
    return "?";
}

template <typename Choice>
[[nodiscard]] std::vector<std::string_view> all_names() {
    std::vector<std::string_view> names;
    names.reserve(std::size(Names<Choice>::all));
    for (const auto& named : Names<Choice>::all) names.push_back(named.name);
    return names;
}

struct AxisNames {
    std::string_view columns;
    std::string_view rows;
};

}  // namespace peterka::job
