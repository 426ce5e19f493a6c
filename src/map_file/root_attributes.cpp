#include "map_file/root_attributes.hpp"

#include <string>
#include <vector>

#include "hdf5/attributes.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/derived.hpp"
#include "job/names.hpp"
#include "job/write.hpp"
#include "map_file/layout.hpp"

namespace peterka::map_file {

namespace {

using job::CellNumbers;

// What all cells share, for plots in SI units; a number that varies from cell to cell follows from the axes.
class SharedNumbers {
  public:
    SharedNumbers(const hdf5::Checked& check, hid_t file, const job::Job& job)
        : check_(check), file_(file), numbers_(job::numbers_at_corners(job)) {}

    template <class ValueOf>
    void write(const char* name, ValueOf value_of) const {
        const double value = value_of(numbers_.front());
        for (const CellNumbers& other : numbers_) {
            if (value_of(other) != value) return;
        }
        hdf5::write_attribute(check_, file_, name, value);
    }

    void write_rig() const {
        write("natural_frequency_hz", [](const CellNumbers& n) { return natural_frequency_hz(n.hammer); });
        write("damping_ratio", [](const CellNumbers& n) { return derive(n.hammer).zeta; });
        write("cart_amplitude_m", [](const CellNumbers& n) { return n.cart.amplitude_m; });
        write("hammer_mass_kg", [](const CellNumbers& n) { return n.hammer.mass_kg; });
    }
    void write_frequency() const {
        write("frequency_ratio", [](const CellNumbers& n) { return n.frequency_ratio(); });
        if (const auto& given = numbers_.front().place.frequency_hz)
            hdf5::write_attribute(check_, file_, "frequency_hz", *given);
    }
    void write_gap() const {
        write("gap_ratio", [](const CellNumbers& n) { return n.gap_ratio(); });
        if (const auto& given = numbers_.front().place.gap_m)
            hdf5::write_attribute(check_, file_, "gap_m", *given);
    }

  private:
    const hdf5::Checked& check_;
    hid_t file_;
    std::vector<CellNumbers> numbers_;
};

void write_shared_numbers(const hdf5::Checked& check, hid_t file, const job::Job& job) {
    const SharedNumbers shared(check, file, job);
    shared.write_rig();
    if (job.kind == job::Kind::study) return;
    if (!has_axis(job, job::is_frequency)) shared.write_frequency();
    if (!has_axis(job, job::is_gap) && job.sweep.gaps().empty()) shared.write_gap();
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

    write_shared_numbers(check, file, job);

    write("git_commit", provenance.git_commit);
    write("hdf5_version", provenance.hdf5);
    write("mpi_version", provenance.mpi);
    write(attribute::sundials, provenance.sundials);
    write("eigen_version", provenance.eigen);
    write("fmt_version", provenance.fmt);
    write(attribute::arithmetic, provenance.arithmetic);
}

}  // namespace peterka::map_file
