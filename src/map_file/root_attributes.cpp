#include "map_file/root_attributes.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "hdf5/attributes.hpp"
#include "job/derived.hpp"
#include "job/names.hpp"
#include "job/write.hpp"
#include "map_file/layout.hpp"

namespace peterka::map_file {

namespace {

double natural_frequency_hz(const job::Job& job) {
    return job.hammer.natural_frequency_hz.value_or(derive(job.hammer).omega_rad_per_s /
                                                    (2 * std::numbers::pi));
}

}  // namespace

void write_root_attributes(const hdf5::Checked& check, hid_t file, const job::Job& job,
                           const Provenance& provenance) {
    const auto write = [&](const char* name, const auto& value) {
        hdf5::write_attribute(check, file, name, value);
    };
    write("Conventions", std::string("CF-1.8"));
    write("title", job.title);
    write("source", "peterka " + provenance.program_version);
    write(attribute::kind, std::string(job::name(job.kind)));
    write(attribute::layout, layout_version);
    write(attribute::job, job::resolved_text(job));
    write(attribute::job_identity, job::identity_text(job));

    write("natural_frequency_hz", natural_frequency_hz(job));
    write("damping_ratio", derive(job.hammer).zeta);
    write("cart_amplitude_m", job.cart.amplitude_m);
    write("hammer_mass_kg", job.hammer.mass_kg);
    if (job.kind == job::Kind::basin || job.kind == job::Kind::trace) {
        write("frequency_ratio", job.operating_point.frequency_ratio);
        write("gap_ratio", job.operating_point.gap_ratio);
    }

    write("git_commit", provenance.git_commit);
    write("hdf5_version", provenance.hdf5);
    write("mpi_version", provenance.mpi);
    write("sundials_version", provenance.sundials);
    write("eigen_version", provenance.eigen);
    write("fmt_version", provenance.fmt);
    write(attribute::arithmetic, provenance.arithmetic);
}

}  // namespace peterka::map_file
