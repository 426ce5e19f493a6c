"""A map file opens in every common reader with named axes, units, classes and provenance."""

import math
import warnings

import h5py
import netCDF4
import numpy
import pytest
import xarray

ENGINES = ["netcdf4", "h5netcdf"]
GROUPS = {"map": ["tiles", "run", "summary"], "basin": ["tiles", "run", "summary", "attractors"]}
ALWAYS = {
    "regime": "int8", "status": "int8", "engine": "int8", "impacts": "int32", "period": "int32", "peak_force_ratio": "float64",
    "impact_rate": "float64", "cycles": "int32", "observed_cycles": "int32",
}
ON_REQUEST = ["multiplier", "lyapunov", "sensitivity", "orbit_displacement", "orbit_velocity"]
FIELDS = {
    "map": ALWAYS | dict.fromkeys(ON_REQUEST, "float64"),
    "basin": ALWAYS | dict.fromkeys(["orbit_displacement", "orbit_velocity"], "float64") | {"attractor": "int32"},
}
AXES = {
    "map": {"frequency_ratio": (0.5, 3.5), "gap_ratio": (0.0, 4.5)},
    "basin": {"displacement_ratio": (-3.0, 0.0), "velocity_ratio": (-0.8, 2.2)},
}
# The same axes in the other unit: name, unit, and the conversion factor.
TWINS = {
    "map": {"frequency_hz": ("frequency_ratio", "Hz", 4.5), "gap_m": ("gap_ratio", "m", 0.89e-3)},
    "basin": {"displacement_m": ("displacement_ratio", "m", 0.89e-3),
              "velocity_m_per_s": ("velocity_ratio", "m/s", 0.89e-3 * 2 * numpy.pi * 4.5)},
}
REGIMES = "no_impact periodic chaotic sustained_contact unresolved failed"
STATUSES = ("verified budget conservative too_many_events not_finite solver_failed rounding imprecise"
            " chaotic_so_far")


@pytest.fixture(params=["map", "basin"])
def kind(request):
    return request.param


@pytest.fixture
def path(kind, request):
    return request.getfixturevalue(f"{kind}_file")


@pytest.fixture(params=ENGINES)
def dataset(path, request):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with xarray.open_dataset(path, engine=request.param) as opened:
            yield opened.load()


def test_xarray_names_axes_and_fields(dataset, kind):
    assert set(dataset.coords) == set(AXES[kind])
    fields = dataset.drop_vars(list(TWINS[kind])).data_vars
    assert {name: str(variable.dtype) for name, variable in fields.items()} == FIELDS[kind]
    columns, rows = AXES[kind]
    assert all(variable.dims == (rows, columns) for variable in fields.values())


def test_xarray_has_each_axis_in_two_units(dataset, kind):
    for name, (axis, units, factor) in TWINS[kind].items():
        assert dataset[name].dims == (axis,) and dataset[name].attrs["units"] == units
        numpy.testing.assert_allclose(dataset[name], factor * dataset[axis].values, rtol=1e-14)


def test_xarray_coordinates_are_linspace(dataset, kind):
    for name, (first, last) in AXES[kind].items():
        numpy.testing.assert_array_equal(dataset[name], numpy.linspace(first, last, 4))
        assert dataset[name].attrs["units"] == "1"


def test_xarray_units_and_names_of_fields(dataset, kind):
    for name, variable in dataset.drop_vars(list(TWINS[kind])).variables.items():
        assert variable.attrs["long_name"]
        assert variable.attrs.get("units") == (None if name in ("regime", "status", "engine") else "1")
    assert dataset.peak_force_ratio.attrs["long_name"] == "peak impact force over hammer weight, F/(m g0)"


def test_xarray_flags(dataset):
    for name, meanings in [("regime", REGIMES), ("status", STATUSES), ("engine", "exact split cvode arkode")]:
        attributes = dataset[name].attrs
        assert attributes["flag_meanings"] == meanings
        assert attributes["flag_values"].dtype == numpy.int8
        assert list(attributes["flag_values"]) == list(range(len(meanings.split())))


def test_xarray_selects_by_label(dataset, kind):
    columns, rows = AXES[kind]
    corner = dataset.sel({columns: AXES[kind][columns][1], rows: AXES[kind][rows][0]}, method="nearest")
    assert corner.regime.item() == dataset.regime.values[0, -1]


@pytest.mark.parametrize("engine", ENGINES)
def test_xarray_opens_every_group(path, kind, engine):
    for group in GROUPS[kind]:
        with xarray.open_dataset(path, engine=engine, group=group) as opened:
            assert opened.load().variables


def test_xarray_provenance(dataset, kind):
    attributes = dataset.attrs
    assert attributes["Conventions"] == "CF-1.8"
    assert attributes["title"] == "four by four"
    assert attributes["source"].startswith("peterka ")
    assert attributes["peterka_layout"] == 3
    assert attributes["peterka_kind"] == kind
    assert 'title = "four by four"' in attributes["job"]
    assert "four by four" not in attributes["job_identity"]
    for name in ["git_commit", "arithmetic", *(f"{library}_version" for library in
                                               ["hdf5", "mpi", "sundials", "eigen", "fmt"])]:
        assert attributes[name]


def test_xarray_scales_for_si_units(dataset, kind):
    scales = {"natural_frequency_hz": 4.5, "cart_amplitude_m": 0.89e-3, "hammer_mass_kg": 0.298}
    if kind == "basin":
        scales |= {"frequency_ratio": 1.8, "gap_ratio": 1.6}
    assert {name: dataset.attrs[name] for name in scales} == scales


def test_netcdf4_reads_all_variables(path, kind):
    with netCDF4.Dataset(path) as opened:
        assert opened.data_model == "NETCDF4"
        columns, rows = AXES[kind]
        assert {name: len(dimension) for name, dimension in opened.dimensions.items()} == {columns: 4, rows: 4}
        for group in [opened, *(opened[name] for name in GROUPS[kind])]:
            for variable in group.variables.values():
                assert numpy.shape(variable[...]) == variable.shape
        assert opened["regime"].flag_meanings == REGIMES


def test_h5py_reads_types_fills_and_scales(path, kind):
    columns, rows = AXES[kind]
    with h5py.File(path) as opened:
        for name, number in FIELDS[kind].items():
            field = opened[name]
            assert field.dtype == number
            assert [dimension[0].name for dimension in field.dims] == [f"/{rows}", f"/{columns}"]
        assert opened["regime"].fillvalue == -128
        assert opened["impacts"].fillvalue == -1
        assert math.isnan(opened["peak_force_ratio"].fillvalue)
        assert isinstance(opened.attrs["job"], str)


def test_every_dimension_of_every_dataset_has_a_scale(path):
    bare = []

    def look(name, item):
        if isinstance(item, h5py.Dataset) and not h5py.h5ds.is_scale(item.id):
            bare.extend(name for dimension in item.dims if len(dimension) != 1)

    with h5py.File(path) as opened:
        opened.visititems(look)
    assert bare == []


def test_finished_file_says_so(path):
    with h5py.File(path) as opened:
        assert opened["summary/finished"][()] == 1
        assert opened["tiles/done"][:].tolist() == [1]
        unresolved = int((opened["regime"][:] == 4).sum())
        told = opened["summary/failures"][()].decode()
        assert told.startswith(f"{unresolved} cell") if unresolved else told == ""
        assert opened["run/ranks"][()] == 1
        assert opened["run/hosts"][()]
        assert not (opened["regime"][:] == -128).any()


def test_cells_of_a_basin_point_at_their_attractor(basin_file):
    with h5py.File(basin_file) as opened:
        table = opened["attractors"]
        count = table["count"][()]
        rows = opened["attractor"][:]
        assert 2 <= count == len(numpy.unique(rows))
        assert table["regime"][0] == 0 == rows[0, 3]
        assert rows.min() == 0
        for column in ["regime", "impacts", "period"]:
            numpy.testing.assert_array_equal(table[column][:][rows], opened[column][:])
        numpy.testing.assert_allclose(table["orbit_displacement"][:][rows], opened["orbit_displacement"][:],
                                      atol=1e-6, equal_nan=True)
        assert table["cells"][:count].tolist() == numpy.bincount(rows.ravel()).tolist()
        assert not table["cells"][count:].any()


@pytest.mark.parametrize("engine", ENGINES)
def test_xarray_opens_a_sweep(sweep_file, engine):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with xarray.open_dataset(sweep_file, engine=engine) as opened:
            sweep = opened.load()
    assert dict(sweep.sizes) == {"branch": 4, "frequency_ratio": 4, "sample": 5}
    assert sweep.gap_ratio.values.tolist() == [0, 0, 1.5, 1.5] and sweep.gap_ratio.dims == ("branch",)
    assert sweep.direction.values.tolist() == [0, 1, 0, 1]
    assert sweep.direction.attrs["flag_meanings"] == "up down independent"
    numpy.testing.assert_array_equal(sweep.frequency_ratio, numpy.linspace(0.5, 3.5, 4))
    sampled = {f"{where}_{what}" for where in ("stroboscopic", "impact") for what in ("displacement", "velocity")}
    cells = set(ALWAYS) | {"jump"}
    assert set(sweep.data_vars) == cells | sampled | {"gap_ratio", "gap_m", "frequency_hz", "direction"}
    assert all(sweep[name].dims == ("branch", "frequency_ratio") for name in cells)
    assert all(sweep[name].dims == ("branch", "frequency_ratio", "sample") for name in sampled)
    assert all(variable.attrs["long_name"] for variable in sweep.variables.values())
    assert all(sweep[name].attrs["units"] == "1" for name in sampled)
    assert (sweep.regime.values != -128).all()
    with h5py.File(sweep_file) as file:
        assert file["tiles/done"][:].tolist() == [1] * 4 and file["summary/finished"][()] == 1
