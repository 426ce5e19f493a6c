// The tables of a job that say what vibrates: hammer, cart and stop.
#pragma once

#include <array>
#include <variant>

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/names.hpp"
#include "job/rules.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Hammer& hammer) {
    table.number({"mass_kg", "mass of the hammer [kg]", "0.298"}, hammer.mass_kg,
                 positive("a mass must be positive: the hammer has inertia"));
    table.either({{"natural_frequency_hz", "natural frequency sqrt(k/m)/(2 pi), no contact [Hz]", "4.5"},
                  hammer.natural_frequency_hz,
                  positive("a natural frequency must be positive: the springs pull the hammer back")},
                 {{"stiffness_n_per_m", "stiffness k of the beam springs [N/m]", "238.0"},
                  hammer.stiffness_n_per_m,
                  positive("a stiffness must be positive: the springs pull the hammer back")},
                 "either of them sets the stiffness of the beam springs");
    table.either({{"damping_ns_per_m", "damping c of the beam springs [Ns/m]", "0.06"},
                  hammer.damping_ns_per_m,
                  not_negative("a damping must not be negative: beam springs take energy and give none")},
                 {{"damping_ratio", "damping ratio c/(2 sqrt(k m)) of the beam springs [1]", "0.004"},
                  hammer.damping_ratio,
                  not_negative("a damping ratio must not be negative: beam springs take energy and give none")},
                 "either of them sets the damping of the beam springs");
    table.number(
        {"cubic_stiffness_n_per_m3", "cubic stiffness k3 [N/m^3]"}, hammer.cubic_stiffness_n_per_m3,
        from_to(-largest_magnitude, largest_magnitude, "a cubic stiffness is a finite physical magnitude"));
    table.choice({"cubic", "form of the cubic term: relative k3 (x - y)^3, absolute k3 (x^3 - y^3)"},
                 hammer.cubic);
}

template <typename Walker>
void describe(Walker& table, Cart& cart) {
    table.number(
        {"amplitude_m", "amplitude A0 of the cart, y = A0 sin(Omega t) [m]", "0.89e-3"}, cart.amplitude_m,
        positive(
            "an amplitude must be positive: a cart at rest drives nothing, and lengths are counted in it"));
}

template <typename Walker>
void describe(Walker& table, KelvinVoigt& stop) {
    table.number({"stiffness_n_per_m", "stiffness ki of the stop [N/m]", "5.5e6"}, stop.stiffness_n_per_m,
                 positive("a contact stiffness must be positive: the stop pushes the hammer back"));
    table.number({"damping_ns_per_m", "damping ci of the stop [Ns/m]", "1.2e3"}, stop.damping_ns_per_m,
                 not_negative("a contact damping must not be negative: a stop takes energy and gives none"));
}

template <typename Walker>
void describe(Walker& table, Restitution& stop) {
    table.number(
        {"coefficient", "coefficient of restitution r, speed after over speed before an impact [1]", "0.6"},
        stop.coefficient,
        from_to(0.0, 1.0, "a rigid stop takes energy and gives none, and r is a share, not a percentage"));
}

template <typename Walker>
void describe(Walker& table, HuntCrossley& stop) {
    table.number({"stiffness_n_per_m_pow_n", "stiffness K of F = K delta^n (1 + D delta') [N/m^n]", "5.5e8"},
                 stop.stiffness_n_per_m_pow_n,
                 positive("a contact stiffness must be positive: the stop pushes the hammer back"));
    table.number({"exponent", "exponent n, 1.5 for Hertz's contact of spheres [1]"}, stop.exponent,
                 from_to(1.0, 10.0,
                         "below 1 the stop would be infinitely stiff at first touch, above 10 it would hardly "
                         "push until deep inside"));
    table.number({"dissipation_s_per_m", "dissipation D [s/m]", "0.3"}, stop.dissipation_s_per_m,
                 not_negative("a dissipation must not be negative: a stop takes energy and gives none"));
}

// The keys of all laws, for messages about keys of another law.
struct StopKey {
    std::string_view name;
    ContactLaw law;
};
inline constexpr std::array stop_keys{StopKey{"stiffness_n_per_m", ContactLaw::kelvin_voigt},
                                      StopKey{"damping_ns_per_m", ContactLaw::kelvin_voigt},
                                      StopKey{"coefficient", ContactLaw::restitution},
                                      StopKey{"stiffness_n_per_m_pow_n", ContactLaw::hunt_crossley},
                                      StopKey{"exponent", ContactLaw::hunt_crossley},
                                      StopKey{"dissipation_s_per_m", ContactLaw::hunt_crossley}};

template <class... Laws>
Contact contact_with_defaults(ContactLaw law, const std::variant<Laws...>& /*contact*/) {
    Contact contact;
    ((law == Laws::law ? void(contact = Laws{}) : void()), ...);
    return contact;
}

template <typename Walker>
void describe(Walker& table, Contact& contact) {
    auto law = law_of(contact);
    const bool known =
        table.choice({"law", "contact law of the stop, which pushes and never pulls", "\"kelvin_voigt\""}, law);
    // The other keys belong to a law; without one they would only add meaningless faults.
    if (!known) {
        for (const StopKey& key : stop_keys) table.skip({key.name});
        return;
    }
    if (law != law_of(contact)) contact = contact_with_defaults(law, contact);
    for (const StopKey& key : stop_keys) {
        if (key.law != law) table.refuse(key.name, reason_for_other_law(key.law));
    }
    std::visit([&](auto& stop) { describe(table, stop); }, contact);
}

}  // namespace peterka::job
