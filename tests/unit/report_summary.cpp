// The summary reports the statistics, in words and units for a newcomer.
#include "report/summary.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "rig.hpp"

namespace peterka {
namespace {

job::Job job_of(job::Kind kind) {
    job::Job job = testing::job_170mm(0);
    job.hammer.mass_kg = 2.5 / scene::standard_gravity;
    job.kind = kind;
    job.title = "a title";
    job.columns = {0.5, 4.5, 41, job::Spacing::linear};
    job.rows = {0.0, 5.0, 51, job::Spacing::linear};
    job.operating_point = {1.8, 1.6};
    job.steady_state.chaos_cycles = 1234;
    return job;
}

findings::Statistics statistics_of_a_hundred_cells() {
    findings::Statistics statistics;
    statistics.counts.by_regime = {60, 30, 7, 0, 2, 1};
    statistics.counts.unresolved_by_status = {0, 1, 1, 0, 0};
    statistics.counts.failed_by_status = {0, 0, 0, 0, 1};
    statistics.counts.open_by_status = {82, 0, 0, 0, 0, 0, 6, 2};
    statistics.chaos = {370, 1234};
    statistics.counts.cells = 100;
    statistics.counts.cycles = 2500;
    statistics.periodic_cells = {{{1, 1}, 10}, {{2, 1}, 15}, {{2, 2}, 5}};
    statistics.largest.any_regime = {80.0, 10, 20};
    statistics.largest.one_to_one = {70.0, 0, 15};
    statistics.tile_seconds = 0.5;
    return statistics;
}

std::string summary(const findings::Statistics& statistics, job::Kind kind = job::Kind::map,
                    const std::vector<std::string>& omitted = {},
                    const std::optional<map_file::AuditReport>& audit = {}) {
    return summary_text({scene::Scene(job_of(kind)), {statistics, audit, omitted}, "maps/a.h5", {3, 12.5}});
}

// The line of the text that contains `word`.
std::string line_with(const std::string& text, const std::string& word) {
    const std::size_t found = text.find(word);
    if (found == std::string::npos) return "no line with " + word;
    const std::size_t begin = text.rfind('\n', found) + 1;
    return text.substr(begin, text.find('\n', found) - begin);
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Summary, RegimesWithSharesAndOnlyThoseThatOccur) {
    const std::string text = summary(statistics_of_a_hundred_cells());
    EXPECT_TRUE(contains(line_with(text, "no impact"), "60.0 %")) << text;
    EXPECT_TRUE(contains(line_with(text, "chaotic  "), "for the 370 to 1,234 cycles that were observed"))
        << text;
    EXPECT_TRUE(contains(text, "in 6 cells: rounding may decide the label")) << text;
    EXPECT_TRUE(contains(text, "in 2 cells: the peak force may be off by more than")) << text;
    EXPECT_FALSE(contains(text, "sustained")) << text;
}

TEST(Summary, CellsWithoutARegimeComeWithReasons) {
    const std::string text = summary(statistics_of_a_hundred_cells());
    EXPECT_TRUE(contains(line_with(text, "unresolved"), "1: nothing verified in all the cycles")) << text;
    EXPECT_TRUE(contains(line_with(text, "unresolved"), "1: nothing dissipates")) << text;
    EXPECT_TRUE(contains(line_with(text, "failed"), "   numbers grew out of range")) << text;
}

TEST(Summary, NoStatusIsLeftWithoutWords) {
    for (std::size_t status = 1; status < cell::status_names.size(); ++status) {
        findings::Statistics statistics = statistics_of_a_hundred_cells();
        statistics.counts.unresolved_by_status = {};
        statistics.counts.unresolved_by_status[status] = 4321;
        statistics.counts.unresolved_by_status[status == 1 ? 2 : 1] = 1;  // the number of each is shown
        const std::string line = line_with(summary(statistics), "4,321: ");
        EXPECT_TRUE(contains(line, "unresolved")) << cell::status_names[status];
        EXPECT_FALSE(line.ends_with("4,321: ")) << cell::status_names[status];
    }
}

TEST(Summary, ChaosThatWasNotFollowedLongEnoughNamesTheCyclesThatAre) {
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    EXPECT_FALSE(contains(summary(statistics), "chaotic for all"));
    statistics.counts.unresolved_by_status[static_cast<std::size_t>(regime::Status::chaotic_so_far)] = 3;
    statistics.longest = {0.3, 5, 20};
    job::Job job = job_of(job::Kind::map);
    job.contact = job::Restitution{0.95};
    const std::string text = summary_text({scene::Scene(job), {statistics, {}, {}}, "maps/a.h5", {3, 12.5}});
    EXPECT_TRUE(contains(text, "chaotic for all 3,000 cycles, and no longer followed: 3 cells")) << text;
    EXPECT_TRUE(contains(text, "with steady_state.max_cycles = ")) << text;
    statistics.longest.impact_rate = 30;  // an impact takes 0.1
    EXPECT_FALSE(contains(summary_text({scene::Scene(job), {statistics, {}, {}}, "a.h5", {3, 12.5}}),
                          "with steady_state.max_cycles = "));
}

TEST(Summary, TwoAttractorsWithOneLabelAreNotOne) {
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    const findings::AttractorLabel one{regime::Regime::periodic, 1, 1};
    const findings::AttractorLabel free{regime::Regime::no_impact, 1, 0};
    statistics.starts.counts.cells = 100;
    statistics.starts.pairs = {{{one, one}, 30}, {{free, one}, 20}};
    job::Job job = job_of(job::Kind::map);
    job.starts.count = 16;
    const std::string text = summary_text({scene::Scene(job), {statistics, {}, {}}, "maps/a.h5", {3, 12.5}});
    EXPECT_TRUE(contains(text, "1/1 with another 1/1 30.0 %")) << text;
    EXPECT_TRUE(contains(text, "1/1 with no impact 20.0 %")) << text;
}

TEST(Summary, OneRankIsNoneOfSeveral) {
    const auto text = [](int ranks) {
        return summary_text({scene::Scene(job_of(job::Kind::map)),
                             {statistics_of_a_hundred_cells(), {}, {}},
                             "a.h5",
                             {ranks, 12.5}});
    };
    EXPECT_TRUE(contains(text(1), "on 1 rank\n"));
    EXPECT_TRUE(contains(text(2), "on 2 ranks\n"));
}

TEST(Summary, ClassesByFrequency) {
    EXPECT_TRUE(contains(summary(statistics_of_a_hundred_cells()), "1/2 15.0 %, 1/1 10.0 %, 2/2 5.0 %\n"));
}

TEST(Summary, ForcesInWeightsNewtonsHertzAndMillimetres) {
    const std::string text = summary(statistics_of_a_hundred_cells());
    EXPECT_TRUE(contains(line_with(text, "of all"), "80 weights = 200 N")) << text;
    EXPECT_TRUE(contains(line_with(text, "of all"), "Omega/omega 2.5 (11.25 Hz), gap/A0 1 (0.89 mm)")) << text;
    EXPECT_TRUE(contains(line_with(text, "of z = 1/1"), "70 weights = 175 N")) << text;
    EXPECT_TRUE(contains(line_with(text, "of z = 1/1"), "Omega/omega 2 (9 Hz), gap/A0 0 (0 mm)")) << text;
}

TEST(Summary, AJobInHertzAndMetresIsToldInTheseFirst) {
    job::Job job = job_of(job::Kind::map);
    job.columns = {2.25, 20.25, 41, job::Spacing::linear, "frequency_hz"};
    job.rows = {0.0, 4.4517e-3, 51, job::Spacing::linear, "gap_m"};
    const std::string text =
        summary_text({scene::Scene(job), {statistics_of_a_hundred_cells(), {}, {}}, "maps/a.h5", {3, 12.5}});
    EXPECT_TRUE(contains(line_with(text, "of all"), "200 N = 80 weights  ")) << text;
    EXPECT_TRUE(contains(line_with(text, "of all"),
                         "frequency 11.25 Hz (Omega/omega 2.5), gap 0.89034 mm (gap/A0 1.00038)"))
        << text;
}

TEST(Summary, ABasinIsToldInTheUnitsOfItsOwnPlaceAndStarts) {
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    job::Job job = job_of(job::Kind::basin);
    job.columns = {-4.45e-3, 0.89e-3, 41, job::Spacing::linear, "displacement_m"};
    job.operating_point = {1.8, 1.6, 8.1};
    const std::string text = summary_text({scene::Scene(job), {statistics, {}, {}}, "maps/a.h5", {3, 12.5}});
    EXPECT_TRUE(contains(text, "frequency 8.1 Hz (Omega/omega 1.8), gap/A0 1.6 (1.424 mm)")) << text;
    EXPECT_TRUE(contains(line_with(text, "of all"), "from x -1.78 mm, x'/(A0 omega) 1 (0.02516 m/s)")) << text;
}

TEST(Summary, ABasinNamesItsPointAndItsStarts) {
    const std::string text = summary(statistics_of_a_hundred_cells(), job::Kind::basin);
    EXPECT_TRUE(contains(text, "Omega/omega 1.8 (8.1 Hz), gap/A0 1.6 (1.424 mm)")) << text;
}

TEST(Summary, InABasinAnOrbitHasOneForceAndChaosOneForEachStart) {
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    statistics.largest.any_regime.regime = static_cast<std::int64_t>(regime::Regime::chaotic);
    statistics.largest.one_to_one.regime = static_cast<std::int64_t>(regime::Regime::periodic);
    const std::string text = summary(statistics, job::Kind::basin);
    EXPECT_TRUE(contains(line_with(text, "of all"),
                         "without a period, from x/A0 2.5 (2.225 mm), x'/(A0 omega) 1 (0.02516 m/s)"))
        << text;
    EXPECT_TRUE(contains(line_with(text, "of z = 1/1"), "on an orbit: the same from every start")) << text;
    EXPECT_FALSE(contains(line_with(text, "of z = 1/1"), "x/A0")) << text;
    statistics.largest.any_regime.regime = static_cast<std::int64_t>(regime::Regime::sustained_contact);
    EXPECT_TRUE(contains(line_with(summary(statistics, job::Kind::basin), "of all"),
                         "in lasting contact: the same from every start"));
}

TEST(Summary, ALargestForceOnTheBorderSaysSo) {
    findings::Statistics statistics = statistics_of_a_hundred_cells();  // of z = 1/1 in row 0
    std::string text = summary(statistics);
    EXPECT_FALSE(contains(line_with(text, "of all"), "border")) << text;
    EXPECT_TRUE(contains(line_with(text, "of z = 1/1"), ", on the map's border (smallest gap)")) << text;
    statistics.largest.any_regime = {80.0, 50, 40};
    text = summary(statistics);
    EXPECT_TRUE(contains(line_with(text, "of all"), ", on the map's border (highest frequency, largest gap)"))
        << text;
}

TEST(Summary, LargeForcesAreInKilonewtons) {
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    statistics.largest.any_regime = {1085.6, 10, 20};
    const std::string text = summary(statistics);
    EXPECT_TRUE(contains(line_with(text, "of all"), "1086 weights = 2.714 kN")) << text;
}

TEST(Summary, StartsInsideAStopThatYieldsAreTold) {
    EXPECT_FALSE(contains(summary(statistics_of_a_hundred_cells()), "inside the stop"));
    job::Job job = job_of(job::Kind::map);
    job.rows = {-2.0, 2.0, 5, job::Spacing::linear};
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    statistics.largest.any_regime.row = 4;
    const std::string text = summary_text({scene::Scene(job), {statistics, {}, {}}, "a.h5", {1, 1}});
    // 5.5e6 N/m times 1.78 mm, minus the dashpot's part: the cart moves at A0 Omega, slowest at 0.5 omega
    EXPECT_TRUE(contains(text,
                         "82 of 205 starts lie inside the stop, by up to 2 A0 (1.78 mm): it presses with "
                         "up to 9.77 kN at once\n"))
        << text;
}

TEST(Summary, LivesOfImpactsThatEndWhereTheyAreStored) {
    job::Job job = job_of(job::Kind::basin);
    job.steady_state.max_cycles = 900;
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    statistics.transients = {100, 20, 5000, 801, {50, 40, 25, 0, 0, 0}};
    const auto text = [&] { return summary_text({scene::Scene(job), {statistics, {}, {}}, "a.h5", {1, 1}}); };
    EXPECT_FALSE(contains(text(), "Impacts that end"));
    job.output.fields = {job::OptionalField::last_impact};
    EXPECT_TRUE(
        contains(text(), "20 cells end without impact after 250 cycles with impacts on average, 801 at most"))
        << text();
    EXPECT_TRUE(contains(text(), "after 30 cycles: 50.0 %, 100 cycles: 40.0 %, 300 cycles: 25.0 %\n"))
        << text();
    job.refine.levels = 2;
    EXPECT_TRUE(contains(text(), "20 computed cells end without impact")) << text();
    EXPECT_TRUE(
        contains(text(), "of the 100 computed cells that settled, not of the plane, still impacting after 30"))
        << text();
    statistics.transients = {};
    EXPECT_TRUE(contains(text(), "No cell strikes the stop first and ends without impact")) << text();
}

TEST(Summary, NoForceIsSaidInWords) {
    findings::Statistics statistics;
    statistics.counts.by_regime = {10, 0, 0, 0, 0, 0};
    statistics.counts.cells = 10;
    statistics.largest.any_regime = {0.0, 0, 0};
    const std::string text = summary(statistics);
    EXPECT_TRUE(contains(text, "No cell strikes the stop for ever")) << text;
    EXPECT_FALSE(contains(text, "inf")) << text;
}

TEST(Summary, ARigidStopHasNoPeakForceAndThatIsSaid) {
    job::Job job = job_of(job::Kind::map);
    job.contact = job::Restitution{0.5};
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    statistics.largest = {};
    const scene::Scene scene(job);
    const std::string text = summary_text({scene, {statistics, {}, {}}, "a.h5", {1, 1}});
    EXPECT_TRUE(contains(text, "No peak forces: a rigid stop")) << text;
    EXPECT_TRUE(contains(text, "Ask for impact_speed or impulse")) << text;
    job.output.fields = {job::OptionalField::impact_speed};
    const scene::Scene asked(job);
    const std::string answered = summary_text({asked, {statistics, {}, {}}, "a.h5", {1, 1}});
    EXPECT_FALSE(contains(answered, "Ask for")) << answered;
    EXPECT_TRUE(contains(answered, "The file has what was asked for instead")) << answered;
    EXPECT_FALSE(contains(text, "No cell strikes the stop for ever")) << text;
    statistics.counts.by_regime = {100, 0, 0, 0, 0, 0};
    EXPECT_TRUE(contains(summary_text({scene, {statistics, {}, {}}, "a.h5", {1, 1}}),
                         "No cell strikes the stop for ever"));
}

TEST(Summary, BordersStandBeforeTheFileAndTheCommandThatDrawsIt) {
    const findings::Statistics statistics = statistics_of_a_hundred_cells();
    const std::string text = summary_text({scene::Scene(job_of(job::Kind::map)),
                                           {statistics, {}, {}},
                                           "maps/a.h5",
                                           {3, 12.5},
                                           "\nBorders at gap/A0 1\n"});
    EXPECT_LT(text.find("Borders at gap/A0 1"), text.find("This run")) << text;
    EXPECT_TRUE(text.ends_with("postprocess/draw.py maps/a.h5\n")) << text;
}

TEST(Summary, EffortFileAndCommand) {
    const std::string text = summary(statistics_of_a_hundred_cells());
    EXPECT_TRUE(
        contains(text, "25.0 forcing cycles and 5.0 ms per cell, 500.0 ms on the clocks of all ranks together"))
        << text;
    EXPECT_TRUE(contains(text, "12.5 s on 3 ranks")) << text;
    EXPECT_TRUE(contains(text, "postprocess/draw.py maps/a.h5")) << text;
}

TEST(Summary, WhatWasLeftOutIsListed) {
    EXPECT_FALSE(contains(summary(statistics_of_a_hundred_cells()), "Left out"));
    const std::string text =
        summary(statistics_of_a_hundred_cells(), job::Kind::map, {"the cubic term: too small"});
    EXPECT_TRUE(contains(text, "  - the cubic term: too small\n")) << text;
}

TEST(Summary, AnAuditIsReportedWithItsErrorsAndItsTime) {
    const map_file::AuditReport audit{.cells = 40,
                                      .agreeing = 39,
                                      .compared = 12,
                                      .median_force_error = 2.5e-5,
                                      .force_error_99_percent = 3e-4,
                                      .largest_force_error = 4e-4,
                                      .seconds_per_cell = 0.25};
    const std::string text = summary(statistics_of_a_hundred_cells(), job::Kind::map, {}, audit);
    EXPECT_TRUE(contains(line_with(text, "same regime"), "39 of 40 (97.5 %)")) << text;
    EXPECT_TRUE(
        contains(line_with(text, "peak force   "), "2.5e-05 (median), 3.0e-04 (99 %), 4.0e-04 (largest) in 12"))
        << text;
    EXPECT_TRUE(contains(line_with(text, "time per cell"), "250.0 ms by the integrator, 5.0 ms in the map"))
        << text;
    EXPECT_TRUE(contains(line_with(text, "other label"), "1: 1 for another reason; /audit in the file"))
        << text;
    EXPECT_FALSE(contains(summary(statistics_of_a_hundred_cells()), "Audit"));
}

TEST(Summary, ASingleForceIsEnoughToTellItsError) {
    const auto text = [](std::int64_t compared) {
        return summary(statistics_of_a_hundred_cells(), job::Kind::map, {},
                       map_file::AuditReport{.cells = 1,
                                             .agreeing = 1,
                                             .compared = compared,
                                             .median_force_error = 2e-5,
                                             .force_error_99_percent = 2e-5,
                                             .largest_force_error = 2e-5});
    };
    EXPECT_TRUE(contains(text(1), "2.0e-05 (largest) in 1 cell")) << text(1);
    const std::string refined = summary(statistics_of_a_hundred_cells(), job::Kind::map, {},
                                        map_file::AuditReport{.cells = 9,
                                                              .agreeing = 9,
                                                              .filled = 4,
                                                              .agreeing_filled = 4,
                                                              .compared = 5,
                                                              .compared_filled = 3,
                                                              .median_filled_error = 4e-5,
                                                              .largest_filled_error = 2e-3});
    EXPECT_TRUE(contains(refined, "(largest) in 5 computed cells")) << refined;
    EXPECT_TRUE(
        contains(refined, "interpolated forces off by 4.0e-05 (median), 2.0e-03 (largest) in 3 filled cells"))
        << refined;
    EXPECT_FALSE(contains(text(0), "(largest)")) << text(0);
}

TEST(Summary, ProofsAreCountedByWhatTheyProve) {
    job::Job job = job_of(job::Kind::map);
    job.certificate.cells = 10;
    findings::Statistics statistics = statistics_of_a_hundred_cells();
    const auto set = [&](cell::Certified what, std::int64_t cells) {
        statistics.proofs.by_verdict.at(
            static_cast<std::size_t>(static_cast<int>(what) - cell::first_certified)) = cells;
    };
    set(cell::Certified::not_tried, 90);
    set(cell::Certified::orbit, 5);
    set(cell::Certified::near_grazing, 2);
    const auto text = [&] {
        return summary_text({scene::Scene(job), {statistics, {}, {}}, "maps/a.h5", {3, 12.5}});
    };
    EXPECT_TRUE(contains(line_with(text(), "proved   "), "5 (")) << text();
    EXPECT_FALSE(contains(text(), "that the start leads there")) << text();
    set(cell::Certified::start, 3);
    EXPECT_TRUE(contains(text(), "of 10 cells\n")) << text();
    EXPECT_TRUE(contains(line_with(text(), "proved   "), "8 (80.0 %), in 3 that the start leads there, too"))
        << text();
}

TEST(Summary, AnAuditTellsFilledCellsApart) {
    const auto told = [](std::int64_t agreeing, std::int64_t by_rounding, std::int64_t agreeing_filled) {
        return summary(statistics_of_a_hundred_cells(), job::Kind::map, {},
                       map_file::AuditReport{.cells = 40,
                                             .agreeing = agreeing,
                                             .decided_by_rounding = by_rounding,
                                             .filled = 10,
                                             .agreeing_filled = agreeing_filled});
    };
    EXPECT_TRUE(contains(line_with(told(34, 2, 7), "of these"),
                         "27 of 30 computed cells, 7 of 10 filled from the cells around (70.0 %)"));
    EXPECT_TRUE(contains(line_with(told(34, 2, 7), "other label"),
                         "6: 3 in cells filled from those around; in 2 a perturbation"));
    EXPECT_TRUE(contains(line_with(told(34, 2, 7), "other label"), "; 1 for another reason"));
    EXPECT_TRUE(contains(line_with(told(37, 0, 7), "other label"), "3: all in cells filled from those around"));
    EXPECT_TRUE(contains(line_with(told(39, 0, 9), "other label"), "1: in a cell filled from those around"));
}

TEST(Summary, AnAuditSaysWhereRoundingDecides) {
    const auto text = [](std::int64_t agreeing, std::int64_t decided_by_rounding) {
        return summary(statistics_of_a_hundred_cells(), job::Kind::map, {},
                       map_file::AuditReport{
                           .cells = 100, .agreeing = agreeing, .decided_by_rounding = decided_by_rounding});
    };
    EXPECT_FALSE(contains(text(100, 0), "other label"));
    EXPECT_TRUE(contains(text(98, 2),
                         "other label         2: in each a perturbation grew by e^20 or more "
                         "(sensitivity), so rounding decides the label\n"))
        << text(98, 2);
    EXPECT_TRUE(contains(text(99, 1), "1: in it a perturbation grew")) << text(99, 1);
    EXPECT_TRUE(contains(text(95, 3), "5: in 3 a perturbation grew")) << text(95, 3);
    EXPECT_TRUE(contains(text(95, 3), "; 2 for another reason; /audit in the file has the cells\n"))
        << text(95, 3);
}

TEST(Summary, FitsAScreen) {
    const std::string text = summary(statistics_of_a_hundred_cells(), job::Kind::map, {"one", "two"});
    EXPECT_LE(std::ranges::count(text, '\n'), 28);
}

}  // namespace
}  // namespace peterka
