"""Runs into files of the same name in different folders are independent: what a killed one leaves in shared memory blocks no later one."""

import subprocess
from pathlib import Path

import jobs
import launch

SEMAPHORES = Path("/dev/shm")
TAKEN = bytes(32)  # a semaphore held by another process


def test_what_a_killed_run_left_keeps_nobody_waiting(tmp_path):
    jobs.write(tmp_path, jobs.small_map())
    left = SEMAPHORES / f"sem.OMPIO_{tmp_path.name}.h5"
    left.write_bytes(TAKEN)
    try:
        done = subprocess.run(launch.command("run", "job.toml", "--output", f"{tmp_path.name}.h5"), cwd=tmp_path,
                              env=launch.ENVIRONMENT, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120,
                              check=False)
        assert done.returncode == 0, done.stderr
    finally:
        left.unlink()
