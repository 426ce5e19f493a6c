#!/usr/bin/python3
"""Two hundred kills at random times, of one rank, of all, of mpirun, each resumed with another number of ranks."""

import random
import sys
import tempfile
from pathlib import Path

import parts
import jobs
import kills
import launch

KILLS = 200


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        jobs.write(folder, jobs.small_map(columns=256, rows=256))
        assert launch.run("run", "job.toml", "--quiet", "--output", "whole.h5", cwd=folder).returncode == 0
        toll = kills.campaign(folder, folder / "whole.h5", KILLS, random.Random(2026))
    print(toll)
    end = (f"{toll.half_done} met a map with some of its tiles done; {toll.unreadable} unreadable files, "
           f"{toll.wrong_tiles} tiles marked as done and wrong; resumed at other numbers of ranks, "
           f"{toll.maps - toll.different_maps} of {toll.maps} maps came out the same byte for byte")
    by_victim = ", ".join(f"{victim} {count}" for victim, count in sorted(toll.kills.items()))
    parts.row(f"kill -9 at a random moment ({by_victim})", toll.kills.total(), end)
    return 1 if toll.harm else 0


if __name__ == "__main__":
    sys.exit(main())
