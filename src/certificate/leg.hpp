// A motion within one phase, from a state at a given time: in closed form or, with a cubic spring, by Taylor
// series (course.hpp).
#pragma once

#include <optional>

#include "certificate/course.hpp"
#include "certificate/phase.hpp"

namespace peterka::certificate {

template <class Number>
struct Moment {
    Vector<Number> state;  // (delta, delta')
    SineCosineOf<Number> angle;
    Vector<Number> decaying;  // the state without the linear phase's steady response
};

template <class Number>
class Leg {
  public:
    Leg(const Phase<Number>& phase, const Number& time, const Vector<Number>& start)
        : phase_(&phase), time_(time), start_{start, sine_cosine(phase.frequency() * time), {}} {
        start_.decaying = start - phase.steady(start_.angle);
        if (!phase.is_linear()) course_.emplace(phase, time, start);
    }

    [[nodiscard]] const Phase<Number>& phase() const { return *phase_; }
    [[nodiscard]] const Moment<Number>& start() const { return start_; }

    [[nodiscard]] Moment<Number> at(const Number& offset) const {
        if (course_) return moment(course_->at(offset), time_ + offset);
        return straight(phase_->flow(offset), time_ + offset);
    }
    // The derivative of the state after a time by the initial state.
    [[nodiscard]] Matrix<Number> flow(const Number& length) const {
        return course_ ? course_->flow(length) : phase_->flow(length);
    }
    // The moment after a length, where the end's time is known up to whole cycles; and where the flow is also
    // known.
    [[nodiscard]] Moment<Number> end(const Number& length, const Number& time) const {
        return course_ ? moment(course_->at(length), time) : straight(phase_->flow(length), time);
    }
    [[nodiscard]] Moment<Number> end(const Number& length, const Matrix<Number>& flow,
                                     const Number& time) const {
        return course_ ? moment(course_->at(length), time) : straight(flow, time);
    }
    // The moment for a state at a time, whatever led to it.
    [[nodiscard]] Moment<Number> moment(const Vector<Number>& state, const Number& time) const {
        const SineCosineOf<Number> angle = sine_cosine(phase_->frequency() * time);
        return {state, angle, state - phase_->steady(angle)};
    }

  private:
    [[nodiscard]] Moment<Number> straight(const Matrix<Number>& flow, const Number& time) const {
        const SineCosineOf<Number> angle = sine_cosine(phase_->frequency() * time);
        const Vector<Number> decaying = flow * start_.decaying;
        return {decaying + phase_->steady(angle), angle, decaying};
    }

    const Phase<Number>* phase_;
    Number time_;
    Moment<Number> start_;
    std::optional<Course<Number>> course_;
};

}  // namespace peterka::certificate
