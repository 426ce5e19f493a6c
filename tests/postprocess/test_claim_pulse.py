"""Single impacts: the stop told from one of them, and the peaks of spectra."""

import h5py
import numpy as np
import pytest
from claim_samples import JOB, verdicts
from peterka_claims import pulse
from peterka_claims.folder import Folder, NotDrawable
from peterka_claims.record import AGREES, DIFFERS
from trace_samples import MASS, write_trace


def strikes(folder, restitution=0.3169, contact_s=0.5708e-3, **spectra):
    """Claims on two traces that are alike; `spectra`: columns of the impact's."""
    for name in (pulse.RELEASE, pulse.STRONGEST):
        path = write_trace(folder / f"{name}.h5", job=JOB)
        with h5py.File(path, "r+") as file:
            file["impacts/impulse"][:] = MASS * 0.3 * (1 + restitution)
            file["impacts/contact_time"][:] = contact_s
            for column, values in spectra.items():
                file["impact_spectrum"][column][:] = values
    return verdicts(pulse.claims(Folder(folder)))


def with_peaks(*hertz):
    """A falling spectrum in steps of 200 Hz, but for its peaks."""
    values = 1 / (1 + np.arange(50.0))
    values[[int(f) // 200 for f in hertz]] = 0.9
    return values


def test_an_impact_in_closed_form():
    # m = ki = 1, damping ratio 0.2: e(0.2) as tabulated, contact 2 acos(0.2)/sqrt(1 - 0.2^2)
    assert pulse.identified(1, 0.57174002758478, 2 * np.arccos(0.2) / np.sqrt(0.96)) == pytest.approx((1, 0.4), rel=1e-8)


def test_single_impacts(tmp_path):
    assert strikes(tmp_path) == {"fig_13_parameters": AGREES, "fig_13_profile": AGREES, "fig_20_flight": DIFFERS,
                                 "fig_21_envelope": AGREES, "fig_21_peaks": DIFFERS}
    assert strikes(tmp_path, restitution=0.33)["fig_13_parameters"] == DIFFERS
    assert strikes(tmp_path, contact_s=0.58e-3)["fig_13_parameters"] == DIFFERS
    assert strikes(tmp_path, contact_s=0.2e-3)["fig_21_envelope"] == DIFFERS
    steps = 200.0 * np.arange(50)
    ringing = strikes(tmp_path, frequency=steps, force_spectrum=with_peaks(1000, 3000, 6000),
                      flight_acceleration_amplitude=with_peaks(400, 800, 7000))
    assert (ringing["fig_20_flight"], ringing["fig_21_peaks"]) == (AGREES, AGREES)
    fewer = strikes(tmp_path, frequency=steps, force_spectrum=with_peaks(1000, 3000),
                    flight_acceleration_amplitude=with_peaks(400, 800))
    assert (fewer["fig_20_flight"], fewer["fig_21_peaks"]) == (DIFFERS, DIFFERS)


def test_traces_that_cannot_be_judged_are_refused(tmp_path):
    with pytest.raises(NotDrawable, match="an impact without speed or time of contact"):
        strikes(tmp_path, contact_s=0)  # as on a rigid stop
    for name in (pulse.RELEASE, pulse.STRONGEST):
        write_trace(tmp_path / f"{name}.h5", impacts=False, job=JOB)
    with pytest.raises(NotDrawable, match="shows no impact with the flight after it"):
        pulse.claims(Folder(tmp_path))
