"""Single impacts, each verdict on both sides of its limit: the stop identified from one of them, and the peaks of spectra."""

import numpy as np
import pytest
from claim_samples import JOB
from peterka.claims import pulse
from peterka.errors import PeterkaFileError
from peterka.claims.folder import Folder
from peterka.claims.record import AGREES, DIFFERS
from trace_samples import JUMP, MASS, PEAK, write_trace
from sealing import SealedFile

STEPS = 200.0 * np.arange(50)  # Hz


def claims(folder, restitution=0.3169, contact_s=0.5708e-3, touch=JUMP, **spectra):
    """With two identical traces; `touch`: force at first touch in weights; `spectra`: columns of the impact's."""
    for name in (pulse.RELEASE, pulse.STRONGEST):
        path = write_trace(folder / f"{name}.h5", job=JOB)
        with SealedFile(path, "r+") as file:
            file["impacts/impulse"][:] = MASS * 0.3 * (1 + restitution)
            file["impacts/contact_time"][:] = contact_s
            file["impacts/touch_force_ratio"][:] = touch
            for column, values in spectra.items():
                file["impact_spectrum"][column][:] = values
    return {claim.key: claim for claim in pulse.claims(Folder(folder))}


def strikes(folder, **changes):
    return {key: claim.verdict for key, claim in claims(folder, **changes).items()}


def with_peaks(*hertz, lowest=0.9):
    """A decreasing spectrum in steps of 200 Hz with added peaks, the last of height `lowest`."""
    values = 1 / (1 + np.arange(50.0))
    values[[hz // 200 for hz in hertz]] = 0.9
    values[hertz[-1] // 200] = lowest
    return values


def flights(folder, *hertz, **changes):
    return strikes(folder, frequency=STEPS, flight_acceleration_amplitude=with_peaks(*hertz, **changes))["fig_20_flight"]


def moments(folder, *hertz, **changes):
    return strikes(folder, frequency=STEPS, force_spectrum=with_peaks(*hertz, **changes))["fig_21_peaks"]


def test_an_impact_in_closed_form():
    # m = ki = 1, damping ratio 0.2: e(0.2) as tabulated, contact 2 acos(0.2)/sqrt(1 - 0.2^2)
    assert pulse.identified(1, 0.57174002758478, 2 * np.arccos(0.2) / np.sqrt(0.96)) == pytest.approx((1, 0.4), rel=1e-8)


def test_single_impacts(tmp_path):
    assert strikes(tmp_path) == {"fig_13_parameters": AGREES, "fig_13_profile": AGREES, "fig_20_flight": DIFFERS,
                                 "fig_21_envelope": AGREES, "fig_21_peaks": DIFFERS}
    assert strikes(tmp_path, restitution=0.33)["fig_13_parameters"] == DIFFERS
    assert strikes(tmp_path, contact_s=0.58e-3)["fig_13_parameters"] == DIFFERS


@pytest.mark.parametrize("touch, verdict", [(PEAK, AGREES), (0.11 * PEAK, AGREES), (0.09 * PEAK, DIFFERS), (0, DIFFERS)])
def test_the_force_jumps_by_more_than_a_tenth_of_its_peak(tmp_path, touch, verdict):
    assert strikes(tmp_path, touch=touch)["fig_13_profile"] == verdict


@pytest.mark.parametrize("hertz, verdict", [(490, DIFFERS), (510, AGREES), (1490, AGREES), (1510, DIFFERS)])
def test_a_contact_is_half_a_wave_of_the_envelope(tmp_path, hertz, verdict):
    assert strikes(tmp_path, contact_s=0.5 / hertz)["fig_21_envelope"] == verdict


def test_the_flight_has_several_low_peaks_and_one_of_the_axial_vibration(tmp_path):
    assert flights(tmp_path, 400, 800, 7000) == flights(tmp_path, 400, 800, 7000, lowest=0.11) == AGREES
    for fewer in ((400, 800), (400, 7000), (400, 1200, 7000), (400, 800, 6600, 7000)):
        assert flights(tmp_path, *fewer) == DIFFERS, fewer
    assert flights(tmp_path, 400, 800, 7000, lowest=0.09) == DIFFERS
    told = claims(tmp_path)["fig_20_flight"].computed
    assert told == ("the largest value lies at the first line (steps of 100 Hz): the swing of the only mode, at 4.5 Hz; no "
                    "other peak reaches 10 % of it. Below 1000 Hz counts as low")
    told = claims(tmp_path, frequency=STEPS, flight_acceleration_amplitude=with_peaks(400, lowest=2))["fig_20_flight"].computed
    assert "the largest value lies at 400 Hz (steps of 200 Hz); a peak at 400 Hz reaches 10 % of it" in told


def test_the_moment_of_impact_has_three_peaks(tmp_path):
    assert moments(tmp_path, 1000, 3000, 6000) == moments(tmp_path, 600, 2800, 6400) == AGREES
    for fewer in ((1000, 3000), (1000, 6000), (3000, 6000), (1600, 3000, 6000), (1000, 2600, 6000), (1000, 3000, 6800)):
        assert moments(tmp_path, *fewer) == DIFFERS, fewer
    assert moments(tmp_path, 1000, 3000, 6000, lowest=0.11) == AGREES
    assert moments(tmp_path, 1000, 3000, 6000, lowest=0.09) == DIFFERS


def test_a_spectrum_that_never_falls_to_half_is_told_so(tmp_path):
    assert "which falls to half of its value at 0 Hz at 200 Hz" in claims(tmp_path)["fig_21_peaks"].computed
    flat = claims(tmp_path, force_spectrum=np.linspace(1, 0.6, 50))["fig_21_peaks"]
    assert flat.verdict == DIFFERS and "which never falls to half of its value at 0 Hz" in flat.computed


def test_traces_that_cannot_be_judged_are_refused(tmp_path):
    with pytest.raises(PeterkaFileError, match="an impact without speed or time of contact"):
        strikes(tmp_path, contact_s=0)  # as on a rigid stop
    for name in (pulse.RELEASE, pulse.STRONGEST):
        write_trace(tmp_path / f"{name}.h5", impacts=False, job=JOB)
    with pytest.raises(PeterkaFileError, match="shows no impact with the flight after it"):
        pulse.claims(Folder(tmp_path))
