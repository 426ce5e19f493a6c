"""Whether two maps, basins or maps of uncertain rigs by different arithmetic agree: labels wherever both are verified
(status 0; elsewhere rounding decides, or how many cycles are allowed), forces, speeds and impulses of settled motions to 1e-9.   usage: close_map.py FILE EXPECTED

Says in one line what was found; ends with 1 where they don't agree."""

import sys

import h5py
import numpy as np

LABELS = ("regime", "impacts", "period")
BLOWS = ("peak_force_ratio", "impact_speed", "impulse", "force_q05_ratio", "force_q50_ratio", "force_q95_ratio")
PERIODIC, SUSTAINED = 1, 3
VERIFIED = 0
TOLERANCE = 1e-9


def contents(path):
    with h5py.File(path, "r") as file:
        return file.attrs["arithmetic"], {name: item[()] for name, item in file.items() if isinstance(item, h5py.Dataset)}


def furthest(one, other):
    """The largest difference, as a share of the expected number; infinite where only one of the two is a number."""
    if (np.isnan(one) != np.isnan(other)).any():
        return np.inf
    some = ~np.isnan(other) & (one != other)
    return float(np.max(np.abs(one[some] / other[some] - 1), initial=0.0))


def main(path, expected_path):
    (arithmetic, file), (expected_arithmetic, expected) = contents(path), contents(expected_path)
    if file.keys() != expected.keys() or file["regime"].shape != expected["regime"].shape:
        print("the files have different variables or shapes")
        return 1
    differs = np.any([file[name] != expected[name] for name in LABELS], axis=0)
    verified = (file["status"] == VERIFIED) & (expected["status"] == VERIFIED)
    settled = ~differs & verified & np.isin(file["regime"], (PERIODIC, SUSTAINED))
    apart = max(furthest(file[name][settled], expected[name][settled]) for name in BLOWS if name in file)
    wrong = int((differs & verified).sum())
    print(f"{arithmetic} against {expected_arithmetic}: of {differs.size} cells {wrong} have another label where both are verified, "
          f"and {int((differs & ~verified).sum())} of the {int((~verified).sum())} others; blows of {int(settled.sum())} settled "
          f"motions to {apart:.0e}")
    return int(wrong > 0 or not settled.any() or not apart <= TOLERANCE)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
