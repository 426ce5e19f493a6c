// The table of a map or sweep that tells how its cells are disturbed at random.
#pragma once

#include "job/job.hpp"
#include "job/key.hpp"
#include "job/rules.hpp"

namespace peterka::job {

template <typename Walker>
void describe(Walker& table, Noise& noise) {
    table.number(
        {"acceleration_m_s2_per_sqrt_hz",
         "white noise in the acceleration of the hammer against the cart, one-sided amplitude spectral "
         "density; a force over the mass is one [m/s^2/sqrt(Hz)]"},
        noise.acceleration_m_s2_per_sqrt_hz,
        from_to(0.0, 1e6, "an amplitude spectral density is no less, and no hammer is shaken more"));
    table.number(
        {"amplitude_relative",
         "standard deviation of the cart's amplitude, drawn for each cycle, over the amplitude [1]"},
        noise.amplitude_relative,
        from_to(0.0, 0.1,
                "a standard deviation is no less, and with more some cycles would have no amplitude left"));
    table.number(
        {"frequency_relative",
         "standard deviation of the excitation frequency, drawn for each cycle, over the frequency [1]"},
        noise.frequency_relative,
        from_to(0.0, 0.1, "a standard deviation is no less, and with more some cycles would last for ever"));
    table.integer({"cycles", "disturbed cycles computed for each motion, roughly [forcing cycles]"},
                  noise.cycles, from_to<std::int64_t>(1'000, 1'000'000'000, "some lives must be seen to end"));
}

template <typename Walker>
void describe_noise(Walker& file, Job& job) {
    // Without it the text of a job is what it was before there was this table.
    const std::size_t faults_before = file.count_faults();
    file.table({.name = "noise",
                .meaning = "random disturbances, under which settled motions last for a mean life",
                .is_written = job.noise != Noise{}},
               [&](auto& table) { describe(table, job.noise); });
    if (!file.has("noise") || file.count_faults() > faults_before) return;
    file.rule({"noise"}, [&] { return rule_of_noise(job.noise); });
}

}  // namespace peterka::job
