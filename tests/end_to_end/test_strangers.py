"""An unfinished map forged by a third party: the run writes into that file or into none."""

import h5py
import numpy as np
import pytest

import jobs
import launch

PLACE = "tiles/checksum"


def external_link(file, victim):
    del file[PLACE]
    file[PLACE] = h5py.ExternalLink(victim.name, "sums")


def external_group(file, victim):
    del file["tiles"]
    file["tiles"] = h5py.ExternalLink(victim.name, "tiles")


def soft_link(file, victim):
    del file[PLACE]
    file[PLACE] = h5py.SoftLink("/tiles/tile")


def external_storage(file, victim):
    size = file[PLACE].shape
    del file[PLACE]
    file.create_dataset(PLACE, size, "u8", external=[(str(victim), 0, 8 * size[0])])


def virtual(file, victim):
    layout = h5py.VirtualLayout(file[PLACE].shape, "u8")
    layout[:] = h5py.VirtualSource(victim.name, "sums", shape=file[PLACE].shape)
    del file[PLACE]
    file.create_virtual_dataset(PLACE, layout)


def two_names(file, victim):
    del file["period"]
    file["period"] = file["impacts"]


@pytest.mark.parametrize("make", [external_link, external_group, soft_link, external_storage, virtual, two_names])
def test_a_strangers_map_leads_a_run_nowhere(tmp_path, make):
    jobs.write(tmp_path, jobs.small_map())
    assert launch.run("run", "job.toml", "--max-wall", "1e-9", cwd=tmp_path).returncode == 5
    victim = tmp_path / "victim.h5"
    with h5py.File(victim, "w") as file:
        file["sums"] = np.zeros(9, "u8")
        for name, kind in (("tile", "i8"), ("done", "i1"), ("checksum", "u8")):
            file[f"tiles/{name}"] = np.zeros(9, kind)
    with h5py.File(tmp_path / "job.h5", "r+") as file:
        make(file, victim)
    before = [path.read_bytes() for path in (victim, tmp_path / "job.h5")]
    finished = launch.run("run", "job.toml", cwd=tmp_path)
    assert finished.returncode == 3
    assert "job.h5: is damaged: " in finished.stderr
    assert [path.read_bytes() for path in (victim, tmp_path / "job.h5")] == before
    trace = tmp_path / "trace.toml"
    trace.write_text(jobs.trace_of("job.h5", "row = 0\ncolumn = 0"))
    traced = launch.run("run", trace, cwd=tmp_path)
    assert traced.returncode == 2 and 'trace.map = "job.h5" is damaged' in traced.stderr
