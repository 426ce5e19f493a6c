// The words of the job file for each choice.
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// In the order of the variant Contact.
enum class ContactLaw { kelvin_voigt, restitution, hunt_crossley };

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

template <>
struct Names<ContactLaw> {
    static constexpr std::array all{Named{ContactLaw::kelvin_voigt, "kelvin_voigt"},
                                    Named{ContactLaw::restitution, "restitution"},
                                    Named{ContactLaw::hunt_crossley, "hunt_crossley"}};
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

template <>
struct Names<OptionalField> {
    static constexpr std::array all{Named{OptionalField::multiplier, "multiplier"},
                                    Named{OptionalField::lyapunov, "lyapunov"},
                                    Named{OptionalField::sensitivity, "sensitivity"},
                                    Named{OptionalField::orbit, "orbit"},
                                    Named{OptionalField::impact_speed, "impact_speed"},
                                    Named{OptionalField::impulse, "impulse"},
                                    Named{OptionalField::contact_time, "contact_time"},
                                    Named{OptionalField::contact_power, "contact_power_w"},
                                    Named{OptionalField::max_displacement, "max_displacement"},
                                    Named{OptionalField::force_per_cycle, "force_per_cycle"},
                                    Named{OptionalField::last_impact, "last_impact"},
                                    Named{OptionalField::critical_kick, "critical_kick"}};
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

[[nodiscard]] inline ContactLaw law_of(const Contact& contact) {
    return static_cast<ContactLaw>(contact.index());
}

struct AxisNames {
    std::string_view columns;
    std::string_view rows;
};

}  // namespace peterka::job
