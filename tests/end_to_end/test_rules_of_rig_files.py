"""A violated rule over tables of a job and of its rig file is reported at the job's own line; the rig file is valid."""

import launch

RIG = """[hammer]
mass_kg = 2.0
natural_frequency_hz = 12.0
damping_ratio = 0.01
[cart]
amplitude_m = 0.5e-3
[contact]
law = "kelvin_voigt"
stiffness_n_per_m = 2e7
damping_ns_per_m = 2500
"""
JOB = """schema = 1
kind = "trace"
rig = "rig.toml"
[trace]
duration_s = 3.0
[operating_point]
frequency_ratio = 0.0
gap_ratio = 0.0
"""


def test_a_rule_is_told_where_the_job_breaks_it(tmp_path):
    (tmp_path / "rig.toml").write_text(RIG)
    (tmp_path / "job.toml").write_text(JOB)
    checked = launch.run("check", "job.toml", cwd=tmp_path)
    assert checked.returncode == 2
    assert checked.stderr.startswith("peterka: job.toml:") and 'trace.from = "steady_state" means nothing' in checked.stderr
