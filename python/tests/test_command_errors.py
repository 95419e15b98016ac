"""What the commands refuse, and how they name it."""

import tempfile

import numpy as np
import pytest
import regoplan


@pytest.mark.parametrize("drives, told", [
    ({"log_x": [1, 2]}, "time_s"), ([], "drives: is empty"), (5, "drives: int is not valid"),
])
def test_bad_drives_are_named(scenario, drives, told):
    with pytest.raises(regoplan.InputError, match=told):
        regoplan.diagnose_drives(drives, scenario)


@pytest.mark.parametrize("change, told", [
    ({"goal": {"x_m": 40, "y_m": 25, "radius_m": -3}}, "scenario: goal.radius_m: -3 is not valid"),
    ({"gravity_mps2": float("nan")}, "scenario.gravity_mps2: nan is not valid"),
    ({"gravity": 1.62}, "scenario: gravity: unknown key"),
    ({"vehicle": "nothing.yaml"}, "scenario: vehicle: .*nothing.yaml"),
    ({"map": {"elevation": "no.tif", "soils": "no.yaml"}}, "no.yaml: no such file"),
    ({"start": object()}, "scenario: object is not valid"),
    ({3.5: 1}, "3.5 is not valid as a key"),
])
def test_bad_scenarios_are_named(scenario, change, told):
    with pytest.raises(regoplan.InputError, match=told):
        regoplan.plan({**scenario, **change})


@pytest.mark.parametrize("option, value, told", [
    ("time_s", float("inf"), "time_s: inf is not valid"),
    ("time_s", np.nan, "time_s: nan is not valid"),
    ("time_s", -1, "^time_s: -1.0 is not valid .allowed: above 0"),
    ("time_s", "5", "time_s: dtype"),
    ("seed", 0.5, "seed: 0.5 is not valid .allowed: an integer"),
    ("seed", True, "seed: True is not valid .allowed: an integer"),
    ("seed", -1, "^seed: -1 is not valid .allowed: a whole number, 0 to 9223372036854775807"),
    ("seed", 2**64, "^seed: 18446744073709551616 is not valid .allowed: a whole number, 0 to 92"),
    ("iterations", 1e3, "iterations: 1000.0 is not valid .allowed: an integer"),
    ("candidates", 101, "^candidates: 101 is not valid .allowed: a whole number, 1 to 100"),
    ("threads", 0, "^threads: 0 is not valid .allowed: a whole number, 1 to 256"),
    ("planner", 3, "planner: 3 is not valid"),
    ("planner", "\ud800", "planner: .* is not valid"),
    ("improve", "no", "improve: 'no' is not valid"),
    ("force", np.ones(2), "force: .* is not valid"),
    ("out", "\ud800", "out: str is not valid"),
])
def test_bad_options_are_named(scenario, option, value, told):
    with pytest.raises(regoplan.InputError, match=told) as caught:
        regoplan.plan(scenario, **{option: value})
    assert caught.value.field in (option, None) and "--" not in str(caught.value)


@pytest.mark.parametrize("path, told", [
    ({"x_m": [1, 2], "y_m": [1]}, "columns differ in length"),
    ({"x_m": [10, 20], "y_m": [25, np.nan]}, "row 1: y_m: NaN is not valid"),
    ({"x_m": [10, 20], "z": [25, 25]}, "y_m"),
    ({"x_m": [[10]], "y_m": [[25]]}, "x_m: shape"),
    ("missing.csv", "missing.csv"),
    (np.ones((2, 2)), "ndarray is not valid .allowed: named columns"),
])
def test_bad_paths_are_named(scenario, path, told):
    with pytest.raises(regoplan.InputError, match=told):
        regoplan.evaluate(scenario, [path], draws=10)


@pytest.mark.parametrize("name", ["a/b", "../x", "", "two\nlines", "a" * 200, "suite", 5])
def test_names_of_scenarios_stay_within_their_folder(scenario, name, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    suite = {"name": "small", "scenarios": {name: scenario, "5": scenario}, "planners": ["Lattice"],
             "seeds": 1, "iterations": 1}
    with pytest.raises(regoplan.InputError, match="^name: .* is not valid"):
        regoplan.benchmark(suite)
    assert all(item.name.startswith("regoplan-") for item in tmp_path.iterdir())


def test_paths_by_name_and_columns_are_told_apart(scenario):
    for paths, told in [
        ({"y_m": [1, 2]}, "x_m"),
        ({"turn": {"y_m": [1, 2]}}, "turn"),
        ({"turn": {"x_m": [10, 20], "y_m": [25, 25]}, "other": 5}, "other: int is not valid"),
        ({"a/b": {"x_m": [10, 20], "y_m": [25, 25]}}, "name: 'a/b' is not valid"),
        ({r"back\1": {"x_m": [10, 20], "z": [25, 25]}}, r"back\\1: .*y_m"),
        (5, "paths: int is not valid"),
    ]:
        with pytest.raises(regoplan.InputError, match=told):
            regoplan.evaluate(scenario, paths, draws=10)


def test_bad_maps_are_named(soil):
    flat = np.zeros((10, 10))
    for arguments, told in [
        ({"elevation_m": np.zeros(10)}, "elevation_m: shape"),
        ({"elevation_m": flat + 1j}, "elevation_m: dtype"),
        ({"elevation_m": flat + np.inf}, r"elevation_m\[0, 0\]: inf"),
        ({"elevation_m": flat + 1e7}, r"elevation_m\[0, 0\]: 10000000.0 is not valid .allowed: -1000000 to"),
        ({"elevation_m": flat + np.nan}, "^elevation_m: NaN everywhere is not valid"),
        ({"soil_class": np.where(np.eye(10), np.nan, 1), "classes": {1: "soil"}},
         r"^soil_class\[0, 0\]: nan is not valid .allowed: integers"),
        ({"soil_class": flat + .5, "classes": {1: "soil"}}, "soil_class: dtype float64"),
        ({"rocks": [[1, 2, 3, np.nan]]}, r"rocks\[0, 3\]: nan"),
        ({"cell_m": 0}, "cell_m"),
        ({"soil_class": np.ones((3, 3), int), "classes": {1: "soil"}}, "soil_class: shape"),
        ({"soil_class": flat, "classes": {1: "soil"}}, "soil_class"),
        ({"soil_class": flat.astype(int)}, "classes"),
        ({"rocks": [[1, 2, 3]]}, "rocks"), ({"soils": {}}, "soils"),
    ]:
        with pytest.raises(regoplan.InputError, match=told):
            regoplan.TerrainMap(**{"elevation_m": flat, "cell_m": 1, "soils": soil, **arguments})


def test_what_the_program_says_of_a_map_names_the_arguments(scenario, soil):
    flat = np.zeros((120, 120))
    rocks = regoplan.TerrainMap(flat, 0.5, soil, rocks=[[25, 30, 1, 1], [25, 20, -1, 1]])
    for call in (rocks.info, lambda: regoplan.plan({**scenario, "map": rocks})):
        with pytest.raises(regoplan.InputError, match="rocks, row 1: radius_m: -1.0") as caught:
            call()
        assert "csv" not in str(caught.value) and "given" not in str(caught.value)


def test_a_misspelt_key_is_told_from_the_one_that_is_missing(scenario):
    misspelt = {**scenario, "gaol": scenario["goal"]}
    del misspelt["goal"]
    with pytest.raises(regoplan.InputError, match=r"goal is missing \(gaol: did you mean goal\?\)$"):
        regoplan.plan(misspelt)
    for goal in ({"y_m": 25, "radius_m": 3}, {"y_m": 25, "radius_m": 3, "z": 1}):
        with pytest.raises(regoplan.InputError, match="x_m is missing$"):
            regoplan.plan({**scenario, "goal": goal})
    start = {"x_m": 10, "y_m": 25, "heading_rad": 0}
    with pytest.raises(regoplan.InputError, match=r"heading_deg is missing \(heading_rad is in another unit\)$"):
        regoplan.plan({**scenario, "start": start})


def test_every_refusal_says_of_which_argument(scenario, soil):
    flat, track = np.zeros((3, 3)), {"x_m": [10, 20], "y_m": [25, 25]}
    for field, call in [
        ("progress", lambda: regoplan.plan(scenario, progress=3)),
        ("out", lambda: regoplan.plan(scenario, out="/proc/x")),
        ("start", lambda: regoplan.plan({**scenario, "start": {"x_m": 1e6, "y_m": 25, "heading_deg": 0}})),
        ("scenario", lambda: regoplan.plan({**scenario, "start": object()})),
        ("scenario", lambda: regoplan.plan("a\0b.yaml")),
        ("drives", lambda: regoplan.diagnose_drives([], scenario)),
        ("path-1", lambda: regoplan.evaluate(scenario, {"x_m": [1, 2], "y_m": [1]})),
        ("sensors", lambda: regoplan.drive(scenario, track, sensors="C")),
        ("suite.scenarios", lambda: regoplan.benchmark({"name": "a", "scenarios": 3})),
        ("soils", lambda: regoplan.TerrainMap(flat, 1, 3)),
        ("soils", lambda: regoplan.TerrainMap(flat, 1, {3: soil})),
        ("vehicle", lambda: regoplan.VehicleOnSoil("lrx", soil, 1.62)),
        ("mechanisms[0]", lambda: regoplan.Wheel(0.4, 0.2, soil, gravity_mps2=1.62,
                                                 mechanisms=[{"id": "slip_sinkag"}])),
    ]:
        with pytest.raises(regoplan.InputError) as caught:
            call()
        assert caught.value.field == field, str(caught.value)


def test_advice_is_pythons(scenario, wheel, tmp_path):
    plan = tmp_path / "plan.json"
    plan.write_text("of others")
    drive = {"time_s": [0, 1], "x_m": [0, 1], "y_m": [0, 0], "yaw_deg": [0, 0]}
    setup = {key: value for key, value in wheel.to_dict().items() if key != "mechanisms"}
    for field, told, call in [
        ("out", "force=True replaces it$", lambda: regoplan.plan(scenario, out=tmp_path)),
        ("paths", "manoeuvres= is not given$", lambda: regoplan.evaluate(scenario)),
        ("iterations", "either time_s or iterations, not both$",
         lambda: regoplan.plan(scenario, time_s=1, iterations=1)),
        ("run_id", "is diagnosed with diagnose_drives", lambda: regoplan.diagnose(drive, setup)),
        ("time_s", "columns=", lambda: regoplan.diagnose_drives({"log_x": [1, 2]}, scenario)),
    ]:
        with pytest.raises(regoplan.InputError, match=told) as caught:
            call()
        assert caught.value.field == field and "--" not in str(caught.value), str(caught.value)
    assert plan.read_text() == "of others"
    assert [item.name for item in tmp_path.iterdir()] == ["plan.json"]


def test_files_are_no_fields():
    with pytest.raises(regoplan.InputError) as caught:
        regoplan.Wheel.from_file("nothing.yaml")
    assert caught.value.field is None


def test_a_map_of_one_row_of_metres_at_the_origin_lies_there(soil):
    info = regoplan.TerrainMap(np.zeros((1, 5)), 1, soil).info()
    assert (info["west_m"], info["south_m"], info["east_m"], info["north_m"]) == (0, 0, 5, 1)
