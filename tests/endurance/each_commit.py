#!/usr/bin/python3
"""The faults tested at each commit, so that the table is complete. A test that no longer exists is an error."""

import sys
import tempfile
import xml.etree.ElementTree as xml
from collections import Counter
from pathlib import Path

import pytest

import parts

TESTS = Path(__file__).parents[1] / "end_to_end"
WHAT_IS_TRIED = {  # the test: the fault, and the outcome if it passes
    "test_kills_at_random_moments_lose_nothing": ("ten kills at random moments in a row", "no loss, the same bytes"),
    "test_a_run_with_a_killed_rank_ends_and_goes_on": ("one rank killed", "all end, the same command goes on"),
    "test_a_damaged_tile_is_computed_again": ("a tile that fails its checksum", "computed again, the same bytes"),
    "test_a_damaged_finished_map_is_not_shown": ("a finished map is damaged", "exit 3, nothing shown"),
    "test_a_file_that_another_run_writes_is_not_entered": ("a file that another run writes", "exit 3, untouched"),
    "test_output_of_another_job": ("a file of another job", "exit 3, names the keys that differ, untouched"),
    "test_output_that_is_another_kind_of_file": ("a file that is no map", "exit 3, untouched"),
    "test_output_that_is_cut_short": ("a file cut short", "exit 3, untouched"),
    "test_a_disk_too_small_for_the_map": ("a disk too small for the map", "exit 3 before anything is created"),
    "test_a_disk_that_fills_up_on_the_way": (
        "a disk that fills up on the way", "exit 3, path and cause; with room again, the same bytes"),
    "test_a_file_that_vanishes": ("the file is removed during the run", "exit 3, path and cause"),
    "test_a_limit_of_file_sizes": ("a limit of file sizes (ulimit -f)", "exit 3, path and cause"),
    "test_a_folder_that_cannot_be_written_is_named": ("a folder that can't be written", "exit 3, path and cause"),
    "test_libraries_in_the_current_folder_are_not_loaded": (
        "libraries of the program's own names in the current folder", "not loaded"),
    "test_a_cycle_that_takes_minutes_is_left_in_its_middle": (
        "a forcing cycle that takes minutes, `--max-wall 1`", "exit 5 in its middle"),
    "test_a_summary_that_cannot_be_printed_is_told_and_the_file_is_whole": (
        "a full or closed standard output", "exit 3 with a word on stderr, the file is whole"),
    "test_a_log_that_nobody_reads_changes_nothing": ("stderr is a pipe that nobody reads", "the same exit codes"),
    "test_no_value_that_is_accepted_ends_in_an_internal_error": (
        "both ends of every key's range, and every choice, one after the other; each job's all are one",
        "2, 3, or computed; never an internal error"),
    "test_more_failed_cells_than_allowed": ("cells that fail", "counted with their reason, exit 4"),
    "test_one_rank_that_fails_ends_all": ("an exception on one rank", "all end, its message once"),
    "test_a_failure_of_all_is_told_once": ("an exception on all ranks", "all end, one message"),
    "test_a_call_that_fails_leaves_the_right_file_or_says_so": (
        "a write, read, fsync, fallocate or rename fails or falls short, in a map, basin, sweep, trace and study",
        "the right file, or exit 3 with path and cause and the right file from the next run"),
    "test_a_read_that_fails_while_attractors_are_numbered": (
        "reads that fail while a basin's attractors are numbered", "exit 3, path and cause; the next run mends it"),
    "test_one_flipped_bit_in_any_dataset_is_found": (
        "one bit flipped in each dataset of a finished file, one after the other", "refused by every reader"),
    "test_a_changed_attribute_is_found": ("an attribute of a finished file changed", "refused by run and by every reader"),
    "test_a_strangers_map_leads_a_run_nowhere": (
        "an unfinished map whose datasets are links, lie elsewhere or are one another", "exit 3, nothing written anywhere"),
    "test_a_second_run_by_another_name_is_kept_out": (
        "a second run that comes by a link", "exit 3, or complete once the first is"),
    "test_a_file_that_is_replaced_during_the_run_is_noticed": (
        "the file is replaced during the run", "exit 3, path and cause; the other file untouched"),
    "test_a_link_in_the_place_of_a_side_file_is_not_followed": (
        "a link under the name of a lock or a temporary file", "exit 3, what it leads to untouched"),
    "test_a_map_is_the_same_at_any_number_of_ranks": ("1, 2, 3, 4, 7 ranks", "the same bytes"),
}


def main():
    with tempfile.TemporaryDirectory() as name:
        report = Path(name) / "report.xml"
        pytest.main(["-q", "-p", "no:cacheprovider", str(TESTS), "-k", " or ".join(WHAT_IS_TRIED),
                     f"--junitxml={report}"])
        cases = list(xml.parse(report).iter("testcase"))
    found, skipped, passed = Counter(), Counter(), Counter()
    for case in cases:
        test = case.get("name").split("[")[0]
        found[test] += 1
        skipped[test] += case.find("skipped") is not None
        passed[test] += len(case) == 0
    for test, (fault, what_happens) in WHAT_IS_TRIED.items():
        tried = found[test] - skipped[test]
        if found[test] == 0:
            what_happens = f"**there is no test {test}**"
        elif tried == 0:
            what_happens = "not tried: skipped on this machine"
        elif passed[test] < tried:
            what_happens = f"**{tried - passed[test]} times not as it should be**"
        parts.row(fault, tried, what_happens)
    return 0 if found == skipped + passed and found.keys() >= WHAT_IS_TRIED.keys() else 1


if __name__ == "__main__":
    sys.exit(main())
