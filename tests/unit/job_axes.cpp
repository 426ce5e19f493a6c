// Axes over any number that may vary from cell to cell: which exist, the resulting cells, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "job/axis_key.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/read.hpp"
#include "job/write.hpp"
#include "scene/scene.hpp"

namespace peterka::job {
namespace {

const std::string rig_of_axes = R"(
[hammer]
mass_kg = 0.298
natural_frequency_hz = 4.5
damping_ns_per_m = 0.06
[cart]
amplitude_m = 0.89e-3
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 5.5e6
damping_ns_per_m = 1.2e3
)";

std::string axis_table(const std::string& key, double from, double to, int points = 3) {
    return "[axes." + key + "]\nfrom = " + std::to_string(from) + "\nto = " + std::to_string(to) +
           "\npoints = " + std::to_string(points) + "\n";
}

std::string map_text(const std::string& more, const std::string& rig = rig_of_axes) {
    return "schema = 1\nkind = \"map\"\n" + rig + more;
}

Job map_over(const std::string& more, const std::string& rig = rig_of_axes) {
    return read_job_text(map_text(more, rig), "job");
}

std::string sweep_text_over(const std::string& more) {
    return "schema = 1\nkind = \"sweep\"\n" + rig_of_axes + more;
}

std::string complaint_about_axes(const std::string& text) {
    try {
        (void)read_job_text(text, "job");
    } catch (const JobFaults& faults) {
        return faults.what();
    }
    return "accepted";
}

#define EXPECT_COMPLAINT(text, words) \
    EXPECT_NE(complaint_about_axes(text).find(words), std::string::npos) << complaint_about_axes(text)

TEST(Axes, TheFirstOfTheFileIsTheColumns) {
    const Job job = map_over(axis_table("hammer.mass_kg", 0.2, 0.4, 5) + axis_table("gap_ratio", 0, 1, 7) +
                             "[operating_point]\nfrequency_hz = 9.0\n");
    EXPECT_EQ(column_key(job), "hammer.mass_kg");
    EXPECT_EQ(row_key(job), "gap_ratio");
    EXPECT_EQ(job.columns.points, 5);
    EXPECT_EQ(axis_names(job).columns, "hammer_mass_kg");
    const Job swapped = map_over(axis_table("gap_ratio", 0, 1, 7) + axis_table("frequency_ratio", 1, 2, 5));
    EXPECT_EQ(column_key(swapped), "gap_ratio");
    EXPECT_EQ(row_key(swapped), "frequency_ratio");
}

TEST(Axes, TheUsualOnesHaveNoNameOfTheirOwn) {
    const Job job = map_over(axis_table("frequency_ratio", 1, 2) + axis_table("gap_ratio", 0, 1));
    EXPECT_EQ(job.columns, (Axis{1, 2, 3}));
    EXPECT_EQ(job.rows, (Axis{0, 1, 3}));
}

TEST(Axes, ResolvedTextReadsBackEqualAndHasNoNumberThatAnAxisReplaces) {
    for (const std::string key :
         {"contact.stiffness_n_per_m", "hammer.damping_ratio", "hammer.stiffness_n_per_m", "cart.amplitude_m",
          "start.velocity_ratio", "hammer.cubic_stiffness_n_per_m3", "gap_m", "frequency_hz"}) {
        SCOPED_TRACE(key);
        const bool is_frequency_axis = key == "frequency_hz";
        const Job job = map_over(
            axis_table(key, 1, 2, 4) + axis_table(is_frequency_axis ? "gap_ratio" : "frequency_ratio", 1, 2) +
            (is_frequency_axis || key == "gap_m" ? "" : "[operating_point]\ngap_m = 1e-3\n"));
        const std::string text = resolved_text(job);
        EXPECT_EQ(read_job_text(text, "resolved"), job) << text;
        EXPECT_EQ(identity_text(read_job_text(text, "resolved")), identity_text(job));
        EXPECT_NE(text.find("[axes." + key + "]"), std::string::npos);
        if (key == "contact.stiffness_n_per_m") {
            EXPECT_EQ(text.find("stiffness_n_per_m ="), std::string::npos);
        }
    }
}

TEST(Axes, EveryNumberOfTheSchemaCanBeSetAndChangesItsCell) {
    for (const ContactLaw law :
         {ContactLaw::kelvin_voigt, ContactLaw::restitution, ContactLaw::hunt_crossley}) {
        for (const std::string_view key : axis_keys(law)) {
            SCOPED_TRACE(std::string(key));
            CellNumbers numbers =
                numbers_in(map_over(axis_table("frequency_ratio", 1, 2) + axis_table("gap_ratio", 0, 1)));
            if (law == ContactLaw::restitution) numbers.contact = Restitution{0.25};
            if (law == ContactLaw::hunt_crossley) numbers.contact = HuntCrossley{3e8, 1.5, 0.25};
            const auto seen = [](const CellNumbers& of) {
                const auto scene = scene::oscillator_of(of);
                const auto scales = scene::scales_of(of);
                return std::tuple(of.frequency_ratio(), of.gap_ratio(), of.start, of.contact,
                                  scene.damping_ratio, scene.cubic, scales.length_m, scales.frequency_rad_per_s,
                                  scales.weight_n);
            };
            const auto before = seen(numbers);
            set_number(numbers, key, 0.75);
            EXPECT_NE(seen(numbers), before);
        }
    }
}

TEST(Axes, ACellHasTheNumbersOfAJobThatHasThemInItsTables) {
    const Job map = map_over(axis_table("hammer.stiffness_n_per_m", 100, 400, 4) +
                             axis_table("cart.amplitude_m", 1e-3, 2e-3, 3) +
                             "[operating_point]\nfrequency_hz = 9.0\ngap_m = 1e-3\n");
    const scene::Scene scene(map);
    EXPECT_TRUE(scene.rigs_differ());
    const Job alone = map_over(axis_table("frequency_ratio", 1, 2) + axis_table("gap_ratio", 0, 1),
                               "[hammer]\nmass_kg = 0.298\nstiffness_n_per_m = 300\ndamping_ns_per_m = 0.06\n"
                               "[cart]\namplitude_m = 2e-3\n[contact]\nlaw = \"kelvin_voigt\"\n"
                               "stiffness_n_per_m = 5.5e6\ndamping_ns_per_m = 1.2e3\n");
    const scene::Cell cell = scene.cell(2, 2);
    const scene::Oscillator<double> same = scene::oscillator_of(alone);
    EXPECT_TRUE(scene::same_rig(cell.oscillator, same));
    const double omega = std::sqrt(300 / 0.298);
    EXPECT_DOUBLE_EQ(cell.oscillator.frequency, 9.0 * 2 * std::numbers::pi / omega);
    EXPECT_DOUBLE_EQ(cell.oscillator.gap, 0.5);
    EXPECT_DOUBLE_EQ(cell.scales.length_m, 2e-3);
    EXPECT_DOUBLE_EQ(cell.scales.frequency_rad_per_s, omega);
}

TEST(Axes, WithoutTheCubicAnAmplitudeChangesNoRig) {
    const scene::Scene scene(map_over(axis_table("cart.amplitude_m", 1e-3, 2e-3) +
                                      axis_table("frequency_ratio", 1, 2) +
                                      "[operating_point]\ngap_ratio = 1\n"));
    EXPECT_FALSE(scene.rigs_differ());
    EXPECT_EQ(scene.cell(0, 2).scales.length_m, 2e-3);
}

TEST(Axes, OnePointIsAllowed) {
    const Job job = map_over(axis_table("frequency_ratio", 1, 1, 1) + axis_table("gap_ratio", 0, 1));
    EXPECT_EQ(job.cells(), 3);
}

TEST(Axes, AnAxisReplacesTheNumberOfItsTableAndTheOneThatSaysTheSame) {
    const Job job = map_over(axis_table("hammer.stiffness_n_per_m", 100, 200) +
                             axis_table("frequency_ratio", 1, 2) + "[operating_point]\ngap_ratio = 0\n");
    EXPECT_FALSE(job.hammer.natural_frequency_hz);
    EXPECT_EQ(job.hammer.stiffness_n_per_m, 100);
}

TEST(Axes, ASweepRunsOverAnyOfThem) {
    const Job gaps = read_job_text(
        sweep_text_over(axis_table("gap_ratio", 0, 2) + "[operating_point]\nfrequency_ratio = 2\n"), "job");
    EXPECT_EQ(gaps.sweep.branches(), 2);
    EXPECT_EQ(read_job_text(resolved_text(gaps), "resolved"), gaps);
    const Job dampers =
        read_job_text(sweep_text_over(axis_table("contact.damping_ns_per_m", 1, 2) +
                                      "[sweep]\ngap_ratio = [0, 1]\n[operating_point]\nfrequency_hz = 9\n"),
                      "job");
    EXPECT_EQ(dampers.sweep.branches(), 4);
    EXPECT_EQ(read_job_text(resolved_text(dampers), "resolved"), dampers);
    const scene::Scene scene(dampers);
    EXPECT_EQ(scene.cell(2, 0).oscillator.gap, 1);
    EXPECT_EQ(scene.cell(2, 0).oscillator.frequency, 2);
}

TEST(Axes, UnknownOnesGetTheNearestName) {
    EXPECT_COMPLAINT(map_text(axis_table("contact.dampling_ns_per_m", 1, 2) + axis_table("gap_ratio", 0, 1)),
                     "unknown table [axes.contact.dampling_ns_per_m]; it would have no effect; "
                     "did you mean [axes.contact.damping_ns_per_m]?");
    EXPECT_COMPLAINT(map_text(axis_table("solver.tolerance", 1, 2) + axis_table("gap_ratio", 0, 1)),
                     "unknown table [axes.solver.tolerance]");
}

TEST(Axes, OfAnotherLawOrNoNumberAreRefused) {
    EXPECT_COMPLAINT(
        map_text(axis_table("contact.coefficient", 0.1, 0.2) + axis_table("frequency_ratio", 1, 2)),
        "[axes.contact.coefficient] belongs to law = \"restitution\"");
    EXPECT_COMPLAINT(map_text(axis_table("hammer.cubic", 0.1, 0.2) + axis_table("frequency_ratio", 1, 2)),
                     "[axes.hammer.cubic] is over a key that is no number");
    EXPECT_COMPLAINT(map_text(axis_table("contact.law", 0.1, 0.2) + axis_table("frequency_ratio", 1, 2)),
                     "[axes.contact.law] is over a key that is no number");
}

TEST(Axes, ThatSayTheSameAreRefused) {
    EXPECT_COMPLAINT(map_text(axis_table("hammer.natural_frequency_hz", 1, 2) +
                              axis_table("hammer.stiffness_n_per_m", 1, 2)),
                     "[axes.hammer.stiffness_n_per_m] says the same as [axes.hammer.natural_frequency_hz]; one "
                     "follows from the other, so they can't run apart; remove one of them");
    EXPECT_COMPLAINT(map_text(axis_table("frequency_hz", 1, 2) + axis_table("frequency_ratio", 1, 2)),
                     "[axes.frequency_ratio] says the same as [axes.frequency_hz]");
    EXPECT_COMPLAINT(map_text(axis_table("gap_m", 1, 2) + axis_table("gap_m", 1, 2)), "TOML syntax");
}

TEST(Axes, TooManyAndTooFewAreRefused) {
    EXPECT_COMPLAINT(map_text(axis_table("frequency_ratio", 1, 2) + axis_table("gap_ratio", 0, 1) +
                              axis_table("hammer.mass_kg", 1, 2)),
                     "[axes.hammer.mass_kg] is one too many; a map has two axes, columns and rows; remove one");
    EXPECT_COMPLAINT(map_text(axis_table("hammer.mass_kg", 1, 2)),
                     "[axes] has one axis, hammer.mass_kg; a map has two, columns and rows");
    EXPECT_COMPLAINT(sweep_text_over(axis_table("gap_ratio", 0, 2) + axis_table("frequency_ratio", 1, 2)),
                     "[axes.frequency_ratio] is one too many; a sweep has one axis; remove one");
}

TEST(Axes, WhatIsNoAxisIsAskedFor) {
    EXPECT_COMPLAINT(map_text(axis_table("hammer.mass_kg", 1, 2) + axis_table("frequency_ratio", 1, 2)),
                     "the table [operating_point] is missing");
    EXPECT_COMPLAINT(map_text(axis_table("hammer.mass_kg", 1, 2) + axis_table("frequency_ratio", 1, 2) +
                              "[operating_point]\nfrequency_hz = 9\ngap_ratio = 1\n"),
                     "operating_point.frequency_hz is given already, as an axis or in a list; remove this key");
    EXPECT_COMPLAINT(
        sweep_text_over(axis_table("gap_ratio", 0, 2) + "[sweep]\ngap_ratio = [1]\n[operating_point]\n"
                                                        "frequency_hz = 9\n"),
        "sweep.gap_ratio is what the axis runs over");
}

TEST(Axes, ValuesOutOfRangeAreTold) {
    EXPECT_COMPLAINT(
        map_text(axis_table("contact.stiffness_n_per_m", -1, 2) + axis_table("frequency_ratio", 1, 2) +
                 "[operating_point]\ngap_ratio = 0\n"),
        "axes.contact.stiffness_n_per_m.from = -1.0 is out of range; a contact stiffness must be positive");
    EXPECT_COMPLAINT(map_text(axis_table("cart.amplitude_m", 1, 2) + axis_table("frequency_hz", 1e8, 2e8) +
                              "[operating_point]\ngap_ratio = 0\n"),
                     "is 2.22e+07 times the natural frequency");
}

TEST(Axes, NoCellStartsBeyondARigidStop) {
    const std::string rigid =
        "[hammer]\nmass_kg = 0.3\nnatural_frequency_hz = 4.5\ndamping_ns_per_m = 0.06\n[cart]\namplitude_m = "
        "0.89e-3\n[contact]\nlaw = \"restitution\"\ncoefficient = 0.6\n";
    EXPECT_COMPLAINT(map_text(axis_table("start.displacement_ratio", -1, 2) +
                                  axis_table("frequency_ratio", 1, 2) + "[operating_point]\ngap_ratio = 1\n",
                              rigid),
                     "start.displacement_ratio = 2.0 lies beyond a rigid stop at the lowest gap_ratio = 1.0");
    EXPECT_COMPLAINT(map_text(axis_table("frequency_ratio", 1, 2) + axis_table("gap_m", 0.001, 0.002) +
                                  "[start]\ndisplacement_m = 0.005\n",
                              rigid),
                     "start.displacement_m = 0.005 lies beyond a rigid stop at the lowest axes.gap_m = 0.001");
}

TEST(Axes, ASpreadWithOneEndIsRefused) {
    for (const std::string end : {"from = 5e6", "to = 6e6"}) {
        EXPECT_COMPLAINT(
            map_text(axis_table("frequency_ratio", 1, 2) + axis_table("gap_ratio", 0, 1) +
                     "[uncertainty]\nrigs = 4\n[uncertainty.contact]\nstiffness_n_per_m = { " + end + " }\n"),
            "uncertainty.contact.stiffness_n_per_m");
    }
}

}  // namespace
}  // namespace peterka::job
