#!/usr/bin/python3
"""The claims of end_to_end/test_kept_claims.py over many more random rigs: Kelvin-Voigt stops, rigid ones, springs with a cubic
term, negative gaps. A broken claim fails the part and is named.

    PETERKA_ENDURANCE_RIGS=10 tests/endurance.sh kept_claims     of each kind, instead of 60
"""

import os
import sys
import tempfile
from pathlib import Path

import parts
import kept_claims

COUNT = int(os.environ.get("PETERKA_ENDURANCE_RIGS", "60"))
SPRINGS = kept_claims.random_rigs(20261122, COUNT)
DAMPED = kept_claims.random_rigs(7071, COUNT, least=0.1)
RIGID = kept_claims.rigid_rigs(31, COUNT)


def over(rigs, check):
    """The results of a check over many rigs; rigs in which a claim is violated are reported."""
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for rig in rigs:
            results.append(check(Path(folder), rig))
            if results[-1][1]:
                print(f"{check.__name__}: {results[-1]} {rig}", flush=True)
    return list(zip(*results, strict=True))


def main():
    broken_claims = 0
    for claim, rigs, check in (
            ("the cubic spring left out, against runs that keep it", [{**rig, "points": 30} for rig in SPRINGS],
             kept_claims.cubic_left_out),
            ("a label, against runs with the last bit of an input moved", SPRINGS + RIGID, kept_claims.last_bit_of_an_input)):
        tried, broken = map(sum, over(rigs, check))
        broken_claims += broken
        parts.row(f"{claim}: cells of {len(rigs)} random rigs", tried, f"{broken} claims broken")
    tried, broken, longest = over(DAMPED + RIGID, kept_claims.one_orbit_one_force)
    broken_claims += sum(broken)
    parts.row(f"one orbit, found from two starts: pairs in {len(DAMPED + RIGID)} random rigs, periods up to {max(longest)}",
              sum(tried), f"{sum(broken)} have two forces or multipliers")
    tried, turned = over(SPRINGS + RIGID, kept_claims.chaos_that_turns)
    broken_claims += sum(turned) > 0.05 * sum(tried)
    parts.row(f"chaos where impacts go on for ever, followed for 20,000 cycles: cells of {len(SPRINGS + RIGID)} random rigs",
              sum(tried), f"{sum(turned)} settle")
    return 1 if broken_claims else 0


if __name__ == "__main__":
    sys.exit(main())
