"""Claims on the effect of a drift, on both sides of their limit, on synthetic maps with [starts]."""

import numpy as np
import pytest
from claim_samples import verdicts
from peterka.claims import drift
from peterka.claims.folder import Folder
from peterka.claims.record import AGREES, DIFFERS, OPEN
from picture_samples import NO_IMPACT, orbit, write_map
from starts_samples import EMPTY, add_starts

ONE = orbit(1, 1)
HERTZ = np.linspace(4, 6, 9)  # steps of a quarter of a hertz, two of which are the drift
NEWTON = 1 / (0.298 * 9.80665)
COLUMNS, MIDDLE = len(HERTZ), 4


def write(folder, forces, quiet=0.0, rigs=("170mm", "150mm", "135mm")):
    """forces: for each gap [N], (gaps, columns); a share of the starts at larger gaps ends without impacts."""
    forces = np.array(forces, dtype=float) * NEWTON
    first = [[ONE] * COLUMNS for _ in forces]
    second = [[EMPTY if row == 0 or quiet == 0 else NO_IMPACT] * COLUMNS for row in range(len(forces))]
    shares = np.where(np.array(second)[..., 0] == EMPTY[0], 0.0, quiet)
    for rig in rigs:
        path = write_map(folder / f"drift_{rig}.h5", first, frequency_ratio=HERTZ / 4.5,
                         gap_ratio=np.arange(len(forces)) / 0.89, forces=forces)
        add_starts(path, [first, second], [1 - shares, shares], [forces, 0 * forces], np.zeros(forces.shape))
    return folder


def slope(at_drift):
    """100 N in the middle, this fraction of it half a hertz away."""
    away = np.abs(np.arange(COLUMNS) - MIDDLE) / 2
    return 100 - away * (100 - at_drift)


@pytest.mark.parametrize("left, gap_0, higher", [(90.5, AGREES, DIFFERS), (89.5, DIFFERS, AGREES)])
def test_what_is_left_decides(tmp_path, left, gap_0, higher):
    found = drift.claims(Folder(write(tmp_path, [slope(left)] * 4)))
    assert verdicts(found) == {"drift_gap_0": gap_0, "drift_higher_gaps": higher}
    assert f"170mm: 0 mm 100 N, {left:g} % of it with the drift" in found[0].computed
    assert "3 mm 100 N" in found[1].computed


def test_every_higher_gap_must_lose(tmp_path):
    found = drift.claims(Folder(write(tmp_path, [slope(95), slope(50), slope(91), slope(0)])))
    assert verdicts(found) == {"drift_gap_0": AGREES, "drift_higher_gaps": DIFFERS}


def test_starts_that_end_elsewhere_leave_nothing(tmp_path):
    found = drift.claims(Folder(write(tmp_path, [slope(95)] * 4, quiet=0.02)))
    assert verdicts(found) == {"drift_gap_0": AGREES, "drift_higher_gaps": AGREES}
    assert "none with the drift" in found[1].computed


def test_a_missing_rig_is_named(tmp_path):
    found = drift.claims(Folder(write(tmp_path, [slope(95)] * 4, rigs=("170mm", "135mm"))))
    assert set(verdicts(found).values()) == {OPEN} and "drift_150mm.h5" in found[0].computed
