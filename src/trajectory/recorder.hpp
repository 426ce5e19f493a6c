// The interaction of stop and hammer, recorded over the cycles of one motion.
//
// An impact lasts from its first touch to the next flight, renewed contact included. It may last across the end
// of a cycle: the caller keeps one recorder for all cycles of a motion, and an impact in progress at the end of
// a cycle stays open until a later one ends it.
//
// Impacts on a rigid stop take no time, but while the hammer is pressed towards it they follow each other ever
// faster, and infinitely many of them may end in rest on the stop: a completed chatter, which counts as one
// impact. So impacts within one stretch of pressing form a chain, which is counted only once its fate is known.
//
// All numbers are nondimensional: lengths in A0, times in 1/omega, speeds in A0 omega, forces in k A0, impulses
// in k A0/omega, work in k A0^2.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

#include "support/latest.hpp"
#include "trajectory/observer.hpp"

namespace peterka::trajectory {

// How much is recorded; each level includes those before it. What is not requested isn't computed.
enum class Detail : std::uint8_t {
    force,     // impacts, chatter, peak force, a bound on the displacement
    impacts,   // on a rigid stop, also speed, impulse, duration and work of the impacts
    contacts,  // the same on any stop, and the largest displacement itself
    energy,    // also the work of the drive and the loss in the springs' damper
};

// A stretch of time in which the stop presses.
template <class Real>
struct Press {
    Real impulse = 0;  // integral of f
    Real time = 0;
    Real work = 0;  // integral of f delta', taken from the hammer
};

// The first touch of an impact.
template <class Real>
struct Touch {
    Real phase = 0;  // of the forcing, since the cycle began
    Real speed = 0;  // delta'
};

// Totals over the recorded cycles.
template <class Real>
struct Totals {
    std::int64_t impacts = 0;        // a completed chatter is one
    bool chatter = false;            // some chatter was completed
    bool struck_rigid_stop = false;  // forces without bound: there is no peak force
    Real largest_force = 0;
    Real displacement_bound = 0;  // |u| = |delta + gap| is no larger than this
    // from the level `impacts` on
    Real impact_speed = 0;  // largest delta' at first touch
    Real impulse = 0;       // largest of one impact
    Real contact_time = 0;  // longest time for which the stop presses within one impact
    Real contact_work = 0;  // of all impacts together
    // from the level `contacts` on
    Real largest_displacement = 0;  // of |u|, the true maximum
    // level `energy`
    Real drive_work = 0;   // integral of eta^2 sin(theta) u'
    Real damper_work = 0;  // integral of 2 zeta u'^2

    [[nodiscard]] Real peak_force() const {
        return struck_rigid_stop ? std::numeric_limits<Real>::quiet_NaN() : largest_force;
    }
};

template <class Real>
class Recorder {
  public:
    // `touches`, if given, receives each first touch; it outlives the recorder.
    explicit Recorder(Detail detail = Detail::force, Latest<Touch<Real>>* touches = nullptr)
        : detail_(detail), touches_(touches) {}
    // The observer outlives the recorder. It sees single impacts from the level `contacts` on.
    Recorder(Detail detail, Observer<Real>& observer) : detail_(detail), observer_(&observer) {}

    [[nodiscard]] bool records_impacts() const { return detail_ >= Detail::impacts; }
    [[nodiscard]] bool records_contacts() const { return detail_ >= Detail::contacts; }
    [[nodiscard]] bool records_energy() const { return detail_ >= Detail::energy; }
    [[nodiscard]] Observer<Real>* observer() const { return observer_; }
    // For an engine whose states lie off the motion between its kicks: maps such a state, at a time tau of the
    // cycle, to the one that an observer is shown.
    using Seen = std::function<scene::State<Real>(Real, const scene::State<Real>&)>;
    void show(Seen seen) { seen_ = std::move(seen); }
    [[nodiscard]] scene::State<Real> seen(Real tau, const scene::State<Real>& x) const {
        return seen_ ? seen_(tau, x) : x;
    }
    [[nodiscard]] const Totals<Real>& totals() const { return totals_; }

    // Whether something in progress counts in a later cycle.
    [[nodiscard]] bool is_open() const { return touching_ || chain_.impacts > 0; }
    // Restarts the counts; what is open stays open.
    void reset_totals() {
        totals_ = {};
        if (touches_ != nullptr) touches_->clear();
    }
    // Counts what is open as one impact that ends now: for a motion that is no longer observed.
    void finish() {
        if (chain_.impacts > 0) join_chain();
        leave();
    }

    // For any law.
    void force(Real largest) {
        totals_.largest_force = std::max(totals_.largest_force, largest);
        recent_force_ = std::max(recent_force_, largest);
        impact_force_ = std::max(impact_force_, largest);
    }
    // Forces that don't exceed this one add nothing to the present impact and cycle.
    [[nodiscard]] Real force_to_beat() const { return std::min(impact_force_, recent_force_); }
    // The largest force since the last call; NaN if the stop is rigid and was struck.
    [[nodiscard]] Real take_recent_force() {
        return totals_.struck_rigid_stop ? std::numeric_limits<Real>::quiet_NaN()
                                         : std::exchange(recent_force_, Real(0));
    }
    void displacement_bound(Real bound) {
        totals_.displacement_bound = std::max(totals_.displacement_bound, bound);
    }
    void displacement(Real size) {
        totals_.largest_displacement = std::max(totals_.largest_displacement, size);
    }
    void energy(Real drive_work, Real damper_work) {
        totals_.drive_work += drive_work;
        totals_.damper_work += damper_work;
    }

    // Adds whole cycles of an engine that records no more than the level `force`, or on a rigid stop `impacts`,
    // and leaves nothing open.
    void cycles(const Totals<Real>& gathered) {
        totals_.impacts += gathered.impacts;
        totals_.chatter |= gathered.chatter;
        totals_.struck_rigid_stop |= gathered.struck_rigid_stop;
        force(gathered.largest_force);
        displacement_bound(gathered.displacement_bound);
        totals_.impact_speed = std::max(totals_.impact_speed, gathered.impact_speed);
        totals_.impulse = std::max(totals_.impulse, gathered.impulse);
        totals_.contact_time = std::max(totals_.contact_time, gathered.contact_time);
        totals_.contact_work += gathered.contact_work;
    }

    // A new impact begins, with delta' > 0.
    void touch(const Touch<Real>& touch) {
        leave();
        if (touches_ != nullptr) touches_->add(touch);
        touching_ = records_impacts();
        ++totals_.impacts;
        totals_.impact_speed = std::max(totals_.impact_speed, touch.speed);
        if (observer_ != nullptr) observer_->touch(touch.speed);
    }
    // The stop presses within the present impact.
    void press(const Press<Real>& press) {
        touching_ = records_impacts();
        impact_.impulse += press.impulse;
        impact_.time += press.time;
        impact_.work += press.work;
        totals_.contact_work += press.work;
    }
    // Flight begins: the impact is over.
    void leave() {
        totals_.impulse = std::max(totals_.impulse, impact_.impulse);
        totals_.contact_time = std::max(totals_.contact_time, impact_.time);
        if (observer_ != nullptr && touching_) {
            observer_->leave({impact_force_, impact_.impulse, impact_.time, impact_.work});
        }
        impact_ = {};
        impact_force_ = 0;
        touching_ = false;
    }

    // A rigid stop turns the speed into -restitution * speed. pressed: the hammer at rest on the stop is
    // pressed against it (acceleration > 0), which makes this impact a link of a chain.
    void strike(const Touch<Real>& touch, Real restitution, bool pressed) {
        if (touches_ != nullptr) touches_->add(touch);
        const Real speed = touch.speed;
        totals_.struck_rigid_stop = true;
        totals_.impact_speed = std::max(totals_.impact_speed, speed);
        const Real work = (1 - restitution) * (1 + restitution) * speed * speed / 2;
        const Real impulse = (1 + restitution) * speed;
        totals_.contact_work += work;
        if (observer_ != nullptr) {
            observer_->touch(speed);
            observer_->leave({std::numeric_limits<Real>::quiet_NaN(), impulse, 0, work});
        }
        if (!pressed) break_chain();
        ++chain_.impacts;
        chain_.impulse += impulse;
        chain_.largest = std::max(chain_.largest, impulse);
        if (!pressed) break_chain();
    }
    // The stretch of pressing is over and the hammer still hops: its impacts count singly.
    void break_chain() {
        totals_.impacts += chain_.impacts;
        totals_.impulse = std::max(totals_.impulse, chain_.largest);
        chain_ = {};
    }
    // The hammer comes to rest on the stop: the chain and the sticking that follows are one impact.
    void stick(bool after_chatter) {
        totals_.chatter |= after_chatter;
        if (observer_ != nullptr) observer_->rest(chain_.impacts);
        join_chain();
    }

  private:
    struct Chain {
        std::int64_t impacts = 0;
        Real impulse = 0;  // of all
        Real largest = 0;
    };
    void join_chain() {
        ++totals_.impacts;
        touching_ = records_impacts();
        impact_.impulse += chain_.impulse;
        chain_ = {};
    }

    Detail detail_;
    Latest<Touch<Real>>* touches_ = nullptr;
    Observer<Real>* observer_ = nullptr;
    Seen seen_;
    Totals<Real> totals_;
    Press<Real> impact_;  // the one in progress
    Real impact_force_ = 0;
    bool touching_ = false;
    Chain chain_;
    Real recent_force_ = 0;
};

}  // namespace peterka::trajectory
