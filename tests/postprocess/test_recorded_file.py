"""Recordings as loggers write them: each of these files gives the same samples, or words."""

import warnings

import numpy as np
import pytest
import scipy.io
from peterka.errors import PeterkaFileError
from peterka.files import number_table
from peterka.identification import recorded_file, recording
from peterka.identification.columns import Layout
from peterka.identification.recorded_file import read_recording
from scipy.io import wavfile

COUNT, RATE = 400, 1000.0
TIME = np.arange(COUNT) / RATE
FORCE = np.round(700 * np.exp(-np.square((TIME - 0.2) / 5e-3)) + np.sin(300 * TIME), 3)
PLACE = np.round(1e-3 * np.sin(20 * TIME), 7)


def rows(*columns, separator=",", decimal=".", digits=".9g"):
    return "".join(separator.join(format(number, digits).replace(".", decimal) for number in row) + "\n" for row in zip(*columns))


def written(tmp_path, text, name="a.csv", encoding="utf-8"):
    (tmp_path / name).write_bytes(text.encode(encoding))
    return tmp_path / name


NAMELESS = Layout(columns=("time", "force"))
TEXTS = {
    "own names": ("time_s,force_n\n" + rows(TIME, FORCE), Layout()),
    "lines before": ("Logger 7;serial 12\nStart;2024-05-01 12:30:00\nChannels;2\n\ntime_s;force_n\n" + rows(TIME, FORCE, separator=";"), Layout()),
    "names and units": ("Time (ms)\tForce [kN]\r\n" + rows(1e3 * TIME, 1e-3 * FORCE, separator="\t").replace("\n", "\r\n"), Layout()),
    "a line of units": ("Time;Force\ns;kN\n" + rows(TIME, 1e-3 * FORCE, separator=";", decimal=","), Layout()),
    "a line of units in brackets": ("Operator: nobody\nTime,Force\n(ms),(N)\n" + rows(1e3 * TIME, FORCE), Layout()),
    "no names": (rows(TIME, FORCE), NAMELESS),
    "no names after a head": ("some words\nmore, words\n" + rows(TIME, FORCE), NAMELESS),
    "no names, decimal commas": (rows(TIME, FORCE, separator="\t", decimal=","), NAMELESS),
    "spaces": (rows(TIME, FORCE, separator="   "), NAMELESS),
    "spaces, decimal commas": (rows(TIME, FORCE, separator=" ", decimal=","), NAMELESS),
    "units in --columns": (rows(1e3 * TIME, 1e-3 * FORCE), Layout(columns=("time[ms]", "force [kN]"))),
    "foreign names": ("Zeit [ms];Kanal 1 [kN]\n" + rows(1e3 * TIME, 1e-3 * FORCE, separator=";", decimal=","), NAMELESS),
    "another column": ("Time [s],Temperature [K],Force [N]\n" + rows(TIME, 0 * TIME, FORCE), Layout(columns=("time", "-", "force"))),
    "a voltage": ("Time [s],Force [mV]\n" + rows(TIME, 22.4 * FORCE), Layout(sensitivity={"force": 0.0224})),
    "a scale": ("Time [s],Force [counts]\n" + rows(TIME, FORCE / 8), Layout(columns=("time", "force"), scale={"force": 8.0})),
    "no time": ("Force [N]\n" + rows(FORCE), Layout(rate=RATE)),
    "comments": ("# made by hand\ntime_s,force_n\n# more\n" + rows(TIME, FORCE), Layout()),
    "names in a comment": ("# time_s,force_n\n" + rows(TIME, FORCE), Layout()),
    "quoted": ('"time_s","force_n"\n' + "".join(f'"{t:.9g}","{f:.9g}"\n' for t, f in zip(TIME, FORCE)), Layout()),
    "empty lines": ("\n\ntime_s,force_n\n\n" + rows(TIME, FORCE).replace("\n", "\n\n"), Layout()),
    "spaces around": ("time_s , force_n\n" + rows(TIME, FORCE, separator=" , "), Layout()),
}


@pytest.mark.parametrize("case", TEXTS)
@pytest.mark.parametrize("block", [2**22, 300], ids=["at once", "in blocks"])
def test_texts_of_loggers(tmp_path, monkeypatch, case, block):
    monkeypatch.setattr(number_table, "BLOCK_BYTES", block)
    text, layout = TEXTS[case]
    found = read_recording(written(tmp_path, text), None, None, layout)
    assert found.count == COUNT and found.step == pytest.approx(1 / RATE, rel=1e-9) and found.missing == 0
    np.testing.assert_allclose(found.signals["force"], FORCE, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("case", [case for case in TEXTS if case not in ("quoted", "comments")])
def test_plain_texts_are_read_fast(tmp_path, monkeypatch, case):
    """Not cell by cell, which takes six times as long."""
    monkeypatch.setattr(number_table.NumberTable, "_one_by_one", None)
    text, layout = TEXTS[case]
    assert read_recording(written(tmp_path, text), None, None, layout).count == COUNT


def test_units_of_accelerations_and_displacements(tmp_path):
    text = "Time [s],Acceleration [g],Displacement [mm]\n" + rows(TIME, FORCE / 9.80665, 1e3 * PLACE)
    found = read_recording(written(tmp_path, text), None, None)
    np.testing.assert_allclose(found.signals["acceleration"], FORCE, rtol=1e-7, atol=1e-7)
    np.testing.assert_allclose(found.signals["displacement"], PLACE, rtol=1e-7, atol=1e-12)
    square = read_recording(written(tmp_path, "Time [s];Acceleration [m/s²]\n" + rows(TIME, FORCE, separator=";"), encoding="latin-1"), None, None)
    np.testing.assert_allclose(square.signals["acceleration"], FORCE, rtol=1e-8)
    volts = read_recording(written(tmp_path, "Time [s],Acceleration [mV]\n" + rows(TIME, 100 * FORCE / 9.80665)), None, None,
                           Layout(sensitivity={"acceleration": 0.1 / 9.80665}))
    np.testing.assert_allclose(volts.signals["acceleration"], FORCE, rtol=1e-7, atol=1e-7)
    tenths = read_recording(written(tmp_path, "Time [s],Acceleration [mV]\n" + rows(TIME, 1000 * FORCE / 9.80665)), None, None,
                            Layout(sensitivity={"acceleration": 0.1 / 9.80665}, scale={"acceleration": 0.1}))
    np.testing.assert_allclose(tenths.signals["acceleration"], FORCE, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("held", [10**9, 0], ids=["in memory", "mapped"])
def test_missing_samples(tmp_path, monkeypatch, held):
    """Missing rows, empty cells, NaN and dashes are gaps, which are told."""
    monkeypatch.setattr(recorded_file, "HELD", held)
    monkeypatch.setattr(recording, "AT_ONCE", 70)
    lines = rows(TIME, FORCE).splitlines()
    for at, word in ((20, ""), (21, "NaN"), (22, "--")):
        lines[at] = lines[at].split(",")[0] + "," + word
    kept = [*lines[:100], *lines[131:]]
    found = read_recording(written(tmp_path, "time_s,force_n\n" + "\n".join(kept)), None, None)
    expected = FORCE.copy()
    expected[20:23] = expected[100:131] = np.nan
    np.testing.assert_allclose(found.signals["force"], expected, rtol=1e-8)
    count, longest, begin = found.gaps()
    assert (found.count, found.missing, count) == (COUNT, 34, 2)
    assert (longest, begin) == (pytest.approx(0.031), pytest.approx(0.1))


def test_times_of_few_digits(tmp_path, monkeypatch):
    """At 51.2 kHz in whole microseconds: steps of 19 and 20 of them; the step is known much better."""
    monkeypatch.setattr(recording, "AT_ONCE", 1000)
    time = np.round(np.arange(50_000) / 51200, 6) + 100
    kept = np.delete(np.arange(50_000), np.arange(20_000, 30_000))
    found = read_recording(written(tmp_path, "time_s,force_n\n" + rows(time[kept], kept, digits=".10g")), None, None)
    assert found.step == pytest.approx(1 / 51200, rel=1e-8) and found.begin == pytest.approx(100, abs=1e-7)
    assert found.count == 50_000 and found.signals["force"][-1] == 49_999 and np.isnan(found.signals["force"][20_000:30_000]).all()


def test_one_time_that_is_off_changes_little():
    time = np.append(TIME, TIME[-1] + 1.2e-3)
    times = recording.even_times(time)
    assert times.begin == pytest.approx(0, abs=3e-6) and times.step == pytest.approx(1e-3, rel=1e-5) and times.count == COUNT + 1
    with pytest.raises(recording.UnevenTimes, match="at 0.4"):
        recording.even_times(np.append(TIME, TIME[-1] + 1.45e-3))


def test_matlab(tmp_path):
    scipy.io.savemat(tmp_path / "a.mat", {"time_s": TIME, "force_n": FORCE[:, None], "note": "words", "gain": 3.0})
    found = read_recording(tmp_path / "a.mat", None, None)
    np.testing.assert_array_equal(found.signals["force"], FORCE)
    scipy.io.savemat(tmp_path / "b.mat", {"data": np.array([1e3 * TIME, FORCE])}, do_compression=True)
    found = read_recording(tmp_path / "b.mat", None, None, Layout(columns=("time[ms]", "force")))
    np.testing.assert_array_equal(found.signals["force"], FORCE)


@pytest.mark.parametrize("kind, full", [("int16", 2**15), ("int32", 2**31), ("uint8", 2**7), ("float32", 1)])
def test_wav(tmp_path, kind, full):
    middle = 128 if kind == "uint8" else 0
    samples = (np.transpose([FORCE, 1e5 * PLACE]) / 1000 * full + middle)
    wavfile.write(tmp_path / "a.wav", int(RATE), samples.round().astype(kind) if full > 1 else samples.astype(kind))
    found = read_recording(tmp_path / "a.wav", None, None, Layout(columns=("force", "-"), scale={"force": 1000.0}))
    assert found.step == 1 / RATE
    np.testing.assert_allclose(found.signals["force"], FORCE, atol=1000 / full if full > 1 else 1e-4)


def noise(count):
    return np.random.default_rng(1).integers(0, 256, count, dtype=np.uint8).tobytes()


@pytest.mark.parametrize("text, layout, reason", [
    (rows(TIME, FORCE), Layout(), "names no columns; --columns says what each of the 2 is"),
    (rows(TIME, FORCE), Layout(columns=("time", "force", "-")), "has 2 columns, and --columns names 3"),
    (rows(TIME, FORCE), Layout(columns=("time", "weight")), "unknown column 'weight'"),
    ("Time,Force\n" + rows(TIME, FORCE), Layout(), "has no unit for 'Time'"),
    ("Time [s],Force [mV]\n" + rows(TIME, FORCE), Layout(), "--sensitivity force=10mV/N"),
    ("Time [s],Force [N]\n" + rows(TIME, FORCE), Layout(sensitivity={"force": 1.0}), "which is no voltage"),
    ("Time [s],Force [N]\n" + rows(TIME, FORCE), Layout(sensitivity={"force": 1.0}, scale={"force": 2.0}), "--columns 'force[V]' says that --scale force=2 "),
    ("Time [s],Force\n" + rows(TIME, FORCE), Layout(sensitivity={"force": 1.0}, scale={"force": 2.0}), "has its force in no voltage"),
    ("Time [s],Force [kg]\n" + rows(TIME, FORCE), Layout(), "has its force in 'kg'"),
    ("Time [s],Force [N]\n" + rows(TIME, FORCE), Layout(rate=RATE), "has Time [s] and a sample rate"),
    ("time_s,force_n\n" + rows(TIME, FORCE) + rows(TIME, FORCE), Layout(), "it goes back"),
    ("time_s,force_n\n" + rows(TIME, FORCE, digits=".2g"), Layout(), "two samples have one time"),
    ("time_s,force_n\n" + rows(TIME, FORCE, decimal=","), Layout(), ":3 has 4 cells, and its first line names 2 columns; decimal commas need"),
    ("time_s,force_n\n" + rows(TIME, FORCE) + "end of data\n", Layout(), ":402 has 1 cells"),
    ("time_s,force_n\n" + rows(TIME, FORCE) + "0.4,12_5\n", Layout(), ":402 has '12_5' as force_n"),
    ("time_s,force_n\n" + rows(TIME, FORCE) + ",5\n", Layout(), ":402 has no time_s"),
    ("", Layout(), "has no samples"),
    ("words\n" * 2000, Layout(), "has no samples"),
    ("time_s,force_n\n", Layout(), "has no samples"),
    ("time_s,force_n\n" + rows(TIME, FORCE) + "5" * 20_000, Layout(), "more than 10000 characters"),
])
def test_texts_that_are_no_recording_get_words(tmp_path, text, layout, reason):
    with pytest.raises(PeterkaFileError) as refusal:
        read_recording(written(tmp_path, text), None, None, layout)
    assert reason in str(refusal.value), refusal.value


@pytest.mark.parametrize("name, content, layout, reason", [
    ("a.csv", "time_s,force_n\n1,2\n".encode("utf-16"), Layout(), "is a text in UTF-16"),
    ("a.csv", b"time_s,force_n\n\0\0\n", Layout(), "is not a text"),
    ("a.csv", noise(10**5), Layout(), "is not a text"),
    ("a.mat", b"", Layout(), "can't be read as mat"),
    ("a.mat", noise(10**4), Layout(), "can't be read as mat"),
    ("a.wav", noise(10**4), Layout(), "can't be read as wav"),
    ("a.wav", b"RIFF\x24\0\0\0WAVEfmt ", Layout(), "can't be read as wav"),
    ("a.uff", b"    -1\n    58\n", Layout(), "is a file of UFF 58, which isn't read here"),
    ("a.TDMS", b"TDSm", Layout(), "is a file of TDMS, which isn't read here"),
])
def test_files_that_are_no_recording_get_words(tmp_path, name, content, layout, reason):
    (tmp_path / name).write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(PeterkaFileError) as refusal:
            read_recording(tmp_path / name, None, None, layout)
    assert reason in str(refusal.value), refusal.value


@pytest.mark.parametrize("variables, layout, reason", [
    ({"time_s": TIME, "force_n": FORCE[:-1]}, Layout(), "vectors of several lengths"),
    ({"a": np.ones((9, 9)), "b": np.ones((9, 9))}, Layout(), "or one matrix"),
    ({"note": "words"}, Layout(), "or one matrix"),
    ({"time_s": TIME, "force_n": 1j * FORCE}, Layout(), "complex numbers in force_n"),
    ({"time_s": np.append(TIME[:-1], np.nan), "force_n": FORCE}, Layout(), "has no time_s"),
])
def test_matlab_files_that_are_no_recording_get_words(tmp_path, variables, layout, reason):
    scipy.io.savemat(tmp_path / "a.mat", variables)
    with pytest.raises(PeterkaFileError, match=reason):
        read_recording(tmp_path / "a.mat", None, None, layout)


@pytest.mark.parametrize("layout, reason", [
    (Layout(), "names no columns"),
    (Layout(columns=("force",)), "--scale force=FACTOR says what full scale is"),
    (Layout(columns=("force",), scale={"force": 1.0}, rate=5.0), "has its own rate, 1000 Hz"),
])
def test_wav_files_need_columns_and_scale(tmp_path, layout, reason):
    wavfile.write(tmp_path / "a.wav", int(RATE), FORCE.astype("float32"))
    with pytest.raises(PeterkaFileError, match=reason):
        read_recording(tmp_path / "a.wav", None, None, layout)


@pytest.mark.parametrize("arguments, reason", [
    (("--scale", "weight=3"), "doesn't begin with one of time="),
    (("--scale", "force=0"), "a factor other than 0"),
    (("--sensitivity", "force=10"), "no sensitivity of a sensor of force"),
    (("--sensitivity", "force=-1mV/N"), "no sensitivity of a sensor of force"),
    (("--scale", "force=1", "force=2"), "force is given twice"),
    (("--rate-hz", "0"), "a number above 0"),
])
def test_bad_arguments_of_columns_get_words(run_program, arguments, reason):
    code, _, err = run_program("identify", "a.csv", "--mass-kg", 1, *arguments)
    assert code == 2 and reason in err and err.count("\n") == 1, err
