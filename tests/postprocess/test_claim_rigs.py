"""Claims tested for rigs drawn within the errors of a measured one: their jobs, how their gaps are called, what the page tells."""

import tomllib

import numpy as np
import pytest
from claim_samples import ONE, QUIET, basin, plane
from peterka.claims import page
from peterka.claims.drawn_rigs import Agreement, DrawnRig, agreements, drawn_rig, job_of
from peterka.claims.markdown import markdown
from peterka.claims.record import claim, not_computed

RIG = DrawnRig(stiffness=0.98, damping=1.03, gap_mm=0.05)
TABLES = """[cart]
amplitude_m = 0.0005 # amplitude

[contact]
law = "kelvin_voigt" # law
stiffness_n_per_m = 5500000.0 # ki (line 3)
damping_ns_per_m = 1200.0 # ci

"""
AXES = "[axes.frequency_ratio]\nfrom = 0.5\nto = 4.5\n\n[axes.gap_ratio]\nfrom = 0.0 # first\nto = 5.0\npoints = 3\n"
BASIN = ("[operating_point]\nfrequency_ratio = 1.8\ngap_ratio = 1.74\n\n[axes.displacement_ratio]\nfrom = -4.0\nto = {to}\n\n"
         "[axes.velocity_ratio]\nfrom = -4.0\nto = 1.74\n")


def moved(text):
    return tomllib.loads(job_of(TABLES + text, RIG))


def test_rigs_fill_their_ranges_evenly():
    rigs = [drawn_rig(number) for number in range(1, 65)]
    for values, middle, spread in (([rig.stiffness for rig in rigs], 1, 0.05), ([rig.damping for rig in rigs], 1, 0.05),
                                   ([rig.gap_mm for rig in rigs], 0, 0.1)):
        places = (np.sort(values) - middle) / spread
        assert np.abs(places - np.linspace(-1, 1, 129)[1::2]).max() < 0.08
    assert len(set(rigs)) == 64


def test_the_stop_is_scaled_and_gaps_are_shifted():
    job = moved(AXES + "\n[sweep]\ngap_ratio = [0.0, 1.0, 3.5] # mm\n\n[curves]\ngap_ratio = [0.0]\n")
    assert job["contact"] == {"law": "kelvin_voigt", "stiffness_n_per_m": 5.39e6, "damping_ns_per_m": pytest.approx(1236)}
    assert job["axes"] == {"frequency_ratio": {"from": 0.5, "to": 4.5}, "gap_ratio": {"from": pytest.approx(0.1), "to": pytest.approx(5.1), "points": 3}}
    assert job["sweep"]["gap_ratio"] == pytest.approx([0.1, 1.1, 3.6]) and job["curves"]["gap_ratio"] == pytest.approx([0.1])
    assert job["cart"]["amplitude_m"] == 0.0005


@pytest.mark.parametrize("to, becomes", [(1.74, 1.84), (1.5, 1.5)])
def test_starts_of_a_basin_that_end_at_the_stop_go_on_doing_so(to, becomes):
    job = moved(BASIN.format(to=to))
    assert job["operating_point"] == {"frequency_ratio": 1.8, "gap_ratio": pytest.approx(1.84)}
    assert job["axes"] == {"displacement_ratio": {"from": -4.0, "to": pytest.approx(becomes)}, "velocity_ratio": {"from": -4.0, "to": 1.74}}


def test_gaps_are_told_as_they_are_called():
    assert plane([[ONE], [QUIET]], rows=[0.1, 1.1]).called_nearer(0.1).rows == pytest.approx([0, 1])
    started = basin(1, 1, gap_ratio=1.84)
    point = type(started)(**{**vars(started), "kind": "basin"}).called_nearer(0.1).job["operating_point"]
    assert point == {"gap_ratio": pytest.approx(1.74), "frequency_ratio": 2.0}


def test_the_page_counts_rigs_that_agree():
    def of(first, second):
        return [claim("a", "1", "A.", "5 N", first), claim("b", "2", "B.", "5 N", second), not_computed("c", "3", "C.", "c.h5")]

    found = agreements([of(True, False), of(False, False), of(True, False)])
    assert found == {"a": Agreement(2, 3), "b": Agreement(0, 3)}
    text = markdown(page.blocks([("Group", of(False, True))], [], lambda name: False, found), "pictures")
    assert "| A. | 1 | **differs** | 2 of 3 |" in text and "| C. | 3 | **not computed** |  |" in text
    assert "again for 3 rigs" in text and "Of the 1 claims that differ, 1 agree with at least one" in text
    assert "0 agree with none. Of those that agree, 1 differ for at least one." in text
    assert "- Rigs drawn: 2 of 3 agree" in text
