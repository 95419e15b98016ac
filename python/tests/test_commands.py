"""The program's commands from dicts and tables: the same numbers, to the last bit."""

import html
import json
import pickle
import signal
import threading
import time

import numpy as np
import pytest
import regoplan
from regoplan import _program, _tables

# Differ between two runs of the program as well: times, and in what files the input stood.
CLOCKS = ("before_search", "planning_time_s", "verification_time_s", "first_verified_s",
          "evaluation_time_s", "inputs")


def without_clocks(found):
    return {key: value for key, value in found.items() if key not in CLOCKS}


@pytest.fixture(scope="module")
def planned(scenario, tmp_path_factory):
    return regoplan.plan(scenario, out=tmp_path_factory.mktemp("plan") / "out")


def as_file(scenario, folder):
    file = folder / "scenario.yaml"
    file.write_text(json.dumps({**scenario, "map": scenario["map"].write(folder / "map")}))
    return file


def test_a_plan_is_the_programs(program, scenario, planned, tmp_path):
    file = as_file(scenario, tmp_path)
    ran = program("plan", file, "--out", tmp_path / "out", "--quiet")
    assert ran.returncode == 0, ran.stderr
    theirs = json.loads((tmp_path / "out" / "plan.json").read_text())
    assert json.dumps(without_clocks(theirs)) == json.dumps(without_clocks(planned.json))
    best = planned.candidates[0]
    assert best.csv == (tmp_path / "out" / "candidate-1.csv").read_text()
    assert planned.status == "feasible"
    assert best.columns["margin"].min() == best.margin_min
    again = regoplan.plan(file)
    assert again.candidates[0].csv == best.csv


def test_a_plan_of_python_is_exported_and_repeated_by_the_program(program, scenario, wheel, tmp_path):
    vehicle = regoplan.Vehicle.preset("lrv").replace(mass_kg=650)
    out = tmp_path / "new" / "out"
    model = {**wheel.to_dict(), "soil_name": "soil"}
    regoplan.plan({**scenario, "vehicle": vehicle}, model=model, out=out)
    (tmp_path / "new").rename(tmp_path / "moved")
    out = tmp_path / "moved" / "out"
    exported = program("export", out, "--nav2", tmp_path / "nav2")
    assert exported.returncode == 0, exported.stderr
    again = program("plan", "--again", out / "plan.json", "--out", tmp_path / "again", "--quiet")
    assert again.returncode == 0, again.stderr
    told = json.loads((tmp_path / "again" / "plan.json").read_text())["again"]
    assert told["changed"] == [] and told["same_candidates"]


def test_a_wheel_is_a_model_of_the_soil_that_it_names(scenario, soil):
    weaker = regoplan.Wheel(0.41, 0.23, soil.replace(cohesion_pa=20), gravity_mps2=1.62,
                            soil_name="soil")
    turn = [{"kind": "steady_turn", "radius_m": 20, "speed_mps": 1}]
    best, worse = (regoplan.evaluate(scenario, manoeuvres=turn, draws=2, model=model).paths[0]
                   for model in (None, weaker))
    assert worse["margin_min"] < best["margin_min"] - 0.01
    with pytest.raises(regoplan.InputError, match="^model: soil_name is missing"):
        regoplan.plan(scenario, model=regoplan.Wheel(0.41, 0.23, soil))


def test_what_is_refused_leaves_the_folder_as_it_was(scenario, tmp_path):
    out = tmp_path / "new" / "out"
    bad = {**scenario, "goal": {"x_m": 40, "y_m": 25, "radius_m": -3}}
    with pytest.raises(regoplan.InputError):
        regoplan.plan(bad, out=out)
    assert list(tmp_path.iterdir()) == []
    regoplan.plan({**scenario, "planner": {"name": "Lattice", "iterations": 1}}, out=out)
    kept = (out / "plan-inputs" / "scenario.yaml").read_text()
    with pytest.raises(regoplan.InputError):
        regoplan.plan(bad, out=out)
    assert (out / "plan-inputs" / "scenario.yaml").read_text() == kept


def test_results_show_their_report(planned):
    page = planned._repr_html_()
    assert page.startswith("<iframe srcdoc=") and html.escape(planned.report_html) in page
    assert (planned.folder / "candidate-1.geojson").exists()


def test_what_nobody_asks_for_is_not_read(planned, monkeypatch):
    def refuse(*_):
        raise AssertionError("is read")

    with monkeypatch.context() as patch:
        patch.setattr(_tables, "read_csv", refuse)
        patch.setattr(_program.ResultFolder, "text",
                      lambda folder, name: refuse() if name.endswith("html")
                      else (folder.path / name).read_text())
        again = type(planned)(_program.ResultFolder(planned.folder), [])
        assert again.status == planned.status and again.candidates[0].rank == 1
    assert again.report_html == planned.report_html
    best = pickle.loads(pickle.dumps(again.candidates[0]))
    assert best.columns is best.columns and np.array_equal(best.x_m, planned.candidates[0].x_m)
    assert again.candidates[0].csv == best.csv


def test_results_are_frames_where_pandas_is(planned):
    pytest.importorskip("pandas")
    assert list(planned.to_dataframe()["rank"]) == [1]
    assert len(planned.candidates[0].to_dataframe()) == len(planned.candidates[0].columns["x_m"])


def test_an_evaluation_is_the_programs(program, scenario, planned, tmp_path):
    turn = {"x_m": [10, 20, 27, 30, 30], "y_m": [25, 25, 28, 35, 45.5], "speed_mps": [2.9] * 5}
    judged = regoplan.evaluate(scenario, {"best": planned.candidates[0], "turn": turn}, draws=10)
    (tmp_path / "best.csv").write_text(planned.candidates[0].csv)
    rows = zip(turn["x_m"], turn["y_m"], turn["speed_mps"])
    (tmp_path / "turn.csv").write_text(
        "x_m,y_m,speed_mps\n" + "".join(f"{x},{y},{v}\n" for x, y, v in rows))
    ran = program("evaluate", as_file(scenario, tmp_path), tmp_path / "best.csv",
                  tmp_path / "turn.csv", "--draws", 10, "--out", tmp_path / "out", "--quiet")
    assert ran.returncode == 0, ran.stderr
    theirs = json.loads((tmp_path / "out" / "evaluation.json").read_text())
    for path in theirs["paths"]:
        path["file"] = path["file"].removeprefix(f"{tmp_path}/")
    assert json.dumps(without_clocks(theirs)) == json.dumps(without_clocks(judged.json))
    assert judged.paths[0]["recorded"]["difference"] < 0.02


def test_an_evaluation_drives_by_the_follower_that_is_asked_for(scenario, planned):
    by = {name: regoplan.evaluate(scenario, planned.candidates[0], draws=10, follower=name)
          for name in ("compensated", "pursuit")}
    for name, judged in by.items():
        assert judged.json["follower"] == name
    assert by["pursuit"].paths[0]["tracked"] != by["compensated"].paths[0]["tracked"]
    with pytest.raises(regoplan.InputError, match="follower"):
        regoplan.evaluate(scenario, planned.candidates[0], draws=10, follower="bold")


def test_a_drive_asks_a_follower_of_ones_own(scenario, planned):
    asked = []

    def own(view):
        asked.append(view.time_s)
        # Back to the path within about 4 m.
        turn = view.path_curvature_1pm - view.offset_m / 16 - view.heading_error_rad / 2
        return view.path_speed_mps, max(-0.3, min(0.3, turn))

    driven = regoplan.drive(scenario, planned.candidates[0], follower=own)
    assert driven.follower == "own"
    assert driven.cross_track_max_m < 1
    assert asked[0] == 0 and asked == sorted(asked) and len(asked) > 50

    # As docs/drive.md has the answer: by names.
    named = regoplan.drive(scenario, planned.candidates[0], follower=lambda view: dict(
        zip(("speed_mps", "curvature_1pm"), own(view))))
    assert named.cross_track_rms_m == driven.cross_track_rms_m

    with pytest.raises(ZeroDivisionError):
        regoplan.drive(scenario, planned.candidates[0], follower=lambda view: (1 / 0, 0))
    with pytest.raises(regoplan.InputError, match="its answer is not valid"):
        regoplan.drive(scenario, planned.candidates[0], follower=lambda view: None)
    with pytest.raises(regoplan.InputError, match="its answer is not valid"):
        regoplan.drive(scenario, planned.candidates[0], follower=lambda view: {"speed_mps": 1})
    with pytest.raises(regoplan.InputError, match="curvature_1pm: 99"):
        regoplan.drive(scenario, planned.candidates[0], follower=lambda view: (0.1, 99))


def test_two_results_are_compared_as_the_program_does(program, planned, tmp_path):
    same = regoplan.compare(planned, planned)
    assert same.kind == "plan" and same.inputs == []
    assert all(entry["change"]["margin_min"] == 0 for entry in same.entries)
    ran = program("compare", planned.folder, planned.folder, "--out", tmp_path / "out")
    assert ran.returncode == 0
    theirs = json.loads((tmp_path / "out" / "comparison.json").read_text())
    assert {**theirs, "a": None, "b": None} == {**same.json, "a": None, "b": None}
    with pytest.raises(regoplan.InputError, match="no result"):
        regoplan.compare(planned, tmp_path)


def test_a_drive_is_the_programs(program, scenario, planned, tmp_path):
    truth = {"vehicle": {"wheels": {"front_left": {"drag_nm": 2}}}}
    driven = regoplan.drive(scenario, planned.candidates[0], follower="compensated", sensors="A",
                            truth=truth, seed=3)
    assert driven.status in ("reached", "limits_broken", "not_reached")
    (tmp_path / "path.csv").write_text(planned.candidates[0].csv)
    (tmp_path / "truth.yaml").write_text(json.dumps(truth))
    ran = program("drive", as_file(scenario, tmp_path), tmp_path / "path.csv", "--out",
                  tmp_path / "out", "--follower", "compensated", "--sensors", "A", "--truth",
                  tmp_path / "truth.yaml", "--seed", "3", "--quiet")
    assert ran.returncode in (0, 2), ran.stderr
    theirs = _tables.read_csv((tmp_path / "out" / "drive.csv").read_text())
    assert driven.recording.keys() == theirs.keys()
    for key in driven.recording.keys() - {"drive_id"}:
        np.testing.assert_array_equal(driven.recording[key], theirs[key], key)
    assert np.isnan(driven.recording["x_m"]).any()  # a pose comes once a second
    assert len(driven.to_dataframe()) == len(theirs["time_s"])


def test_what_a_drive_cannot_take_is_named(scenario, planned):
    for wrong, word in (({"follower": "bold"}, "follower"), ({"sensors": "C"}, "sensors"),
                        ({"truth": {"mud": 1}}, "mud"), ({"deviation_max_m": -1}, "deviation_max_m"),
                        ({"seed": 1.5}, "seed")):
        with pytest.raises(regoplan.InputError, match=word):
            regoplan.drive(scenario, planned.candidates[0], **wrong)


def test_manoeuvres_are_evaluated_without_a_path(scenario):
    judged = regoplan.evaluate(scenario, manoeuvres=[
        {"kind": "steady_turn", "radius_m": 20, "speed_mps": 1}], draws=10)
    assert len(judged.paths) == 1


def test_a_soil_varies_in_the_draws_as_it_does_from_a_file(scenario, soil):
    assert soil.standard_deviations
    flat = np.zeros((120, 120))
    path = {"x_m": [10, 40], "y_m": [25, 25]}

    def margins(given):
        here = {**scenario, "map": regoplan.TerrainMap(flat, 0.5, given)}
        judged = regoplan.evaluate(here, path, draws=40, threads=1)
        return judged.paths[0]["quantiles"]["margin"]

    assert margins(soil) == margins({"soil": soil.to_dict()})
    assert margins(soil)["p05"] < margins(soil)["p95"]
    known = margins(regoplan.Soil(**soil.model_keys()))
    assert known["p05"] == known["p95"]


@pytest.fixture(scope="module")
def recording():
    """Of a wheel whose sinkage grows with slip, which the base model leaves out."""
    soil = regoplan.Soil(cohesion_pa=800, friction_angle_deg=37.2, kc=1370, kphi=8.14e5, n=1, a0=0.4,
                         a1=0.15, lambda_=0.9, density_kgpm3=1600, kx0_m=0.036, kx1_m=0.043,
                         ky0_m=0.013, ky1_m=0.02)
    wheel = regoplan.Wheel(0.09, 0.1, soil, mechanisms=[{"id": "slip_sinkage"}])
    slip, angle = (grid.ravel() for grid in np.meshgrid(np.linspace(-0.2, 0.8, 6),
                                                        np.radians([0, 8, 16])))
    slip, angle = np.tile(slip, 2), np.tile(angle, 2)
    random = np.random.default_rng(4)
    forces = wheel.forces(60, slip, angle)
    noise = {"fx_n": 0.6, "fy_n": 0.6, "torque_nm": 0.06, "sinkage_m": 3e-4}
    table = {"run_id": np.array([f"r{i:03d}" for i in range(len(slip))]),
             "load_n": np.full(len(slip), 60.0), "slip_ratio": slip,
             "slip_angle_deg": np.degrees(angle)}
    for name, deviation in noise.items():
        table[name] = getattr(forces, name) + random.normal(0, deviation, len(slip))
    uncertain = {"cohesion_pa": 120, "friction_angle_deg": 1, "kphi": 8e4}
    setup = {"model": "ishigami2007", "wheel": {"radius_m": 0.09, "width_m": 0.1},
             "gravity_mps2": 9.80665,
             "soil": {key: {"mean": value, "std": uncertain[key]} if key in uncertain else value
                      for key, value in soil.model_keys().items()}}
    return table, setup


def test_a_diagnosis_is_the_programs(program, recording, tmp_path):
    pandas = pytest.importorskip("pandas")
    table, setup = recording
    seen = []
    found = regoplan.diagnose(pandas.DataFrame(table), setup,
                              progress=lambda *told: seen.append(told))
    columns = [column.tolist() for column in table.values()]
    (tmp_path / "recording.csv").write_text(",".join(table) + "\n" + "".join(
        ",".join(cell if isinstance(cell, str) else repr(cell) for cell in row) + "\n"
        for row in zip(*columns)))
    (tmp_path / "setup.yaml").write_text(json.dumps(setup))
    ran = program("diagnose", tmp_path / "recording.csv", "--setup", tmp_path / "setup.yaml",
                  "--out", tmp_path / "out", "--quiet")
    assert ran.returncode in (0, 2), ran.stderr
    text = (tmp_path / "out" / "diagnosis.json").read_text().replace(f"{tmp_path}/", "")
    assert json.loads(text) == found.json
    assert "slip_sinkage" in [entry["id"] for entry in found.ranking[:5]]
    assert seen and all(0 <= share <= 1 for _, share, _ in seen)
    corrected, base = found.corrected_wheel(), regoplan.Wheel.from_file(tmp_path / "setup.yaml")
    measured = np.array(table["sinkage_m"])
    at = (60, table["slip_ratio"], np.radians(table["slip_angle_deg"]))
    miss = [np.sqrt(np.mean((wheel.forces(*at).sinkage_m - measured) ** 2))
            for wheel in (corrected, base)]
    assert miss[0] < miss[1] / 2
    assert len(found.residuals["run_id"]) == len(measured)


@pytest.fixture(scope="module")
def drive():
    """Five minutes in a circle on the map of the scenario."""
    time_s = np.arange(3000) / 10
    angle = time_s / 10
    return {"time_s": time_s, "x_m": 30 + 8 * np.cos(angle), "y_m": 30 + 8 * np.sin(angle),
            "yaw_deg": np.degrees(angle) + 90, "pitch_deg": np.arange(3000) % 3 / 10}


def test_drives_are_diagnosed_under_their_own_names(program, scenario, drive, tmp_path):
    known = regoplan.diagnose_drives(drive, scenario)
    foreign = {f"log_{name}": column for name, column in drive.items()}
    columns = {"columns": {name: f"log_{name}" for name in drive}}
    for drives, threads in ((foreign, 1), ([foreign], 2)):  # change no result
        found = regoplan.diagnose_drives(drives, scenario, columns=columns, threads=threads)
        assert found.fit == known.fit and found.verdict == known.verdict
    (tmp_path / "drive-1.csv").write_text(",".join(drive) + "\n" + "".join(
        ",".join(map(repr, row)) + "\n" for row in zip(*(c.tolist() for c in drive.values()))))
    ran = program("diagnose", tmp_path / "drive-1.csv", "--scenario", as_file(scenario, tmp_path),
                  "--out", tmp_path / "out", "--quiet")
    assert ran.returncode == (2 if known.verdict == "undecided" else 0), ran.stderr
    text = (tmp_path / "out" / "diagnosis.json").read_text().replace(f"{tmp_path}/", "")
    assert without_clocks(json.loads(text)) == without_clocks(known.json)


def test_a_benchmark_goes_on_where_it_was(scenario, tmp_path):
    suite = {"name": "small", "scenarios": {"open": scenario}, "planners": ["Lattice"], "seeds": 2,
             "time_s": 5, "iterations": 500, "soil_draws": 5}
    first = regoplan.benchmark(suite, out=tmp_path / "out")
    again = regoplan.benchmark(suite, out=tmp_path / "out")
    assert first.experiments == again.experiments
    assert first.experiments[0]["planners"][0]["runs"] == 2


def test_a_seed_arrives_to_the_last_bit(scenario):
    seed = 2**53 + 1
    judged = regoplan.evaluate(scenario, manoeuvres=[
        {"kind": "steady_turn", "radius_m": 20, "speed_mps": 1}], draws=np.int64(2), seed=seed)
    assert judged.seed == seed


def test_a_map_says_what_the_program_reads(program):
    soils = {name: regoplan.Soil.preset(name) for name in ("firm_regolith", "soft_patch")}
    height = np.add.outer(np.arange(40.0), np.zeros(50)) * -0.1
    height[0, 0] = np.nan
    codes = np.ones((40, 50), np.int64)
    codes[:, :10] = 7
    info = regoplan.TerrainMap(height, 2.0, soils, west_m=100, south_m=-30, soil_class=codes,
                               classes={1: "firm_regolith", 7: "soft_patch"}).info()
    assert (info["west_m"], info["south_m"], info["columns"], info["rows"]) == (100, -30, 50, 40)
    assert info["height_min_m"] == pytest.approx(-3.9) and info["known_share"] == 0.9995
    assert info["soils"]["soft_patch"] == pytest.approx(0.2)


def test_ctrl_c_ends_a_plan_with_whole_files(scenario, tmp_path):
    long = {**scenario, "planner": {"name": "RRT", "time_s": 120, "candidates": 50}}
    begun = time.monotonic()
    threading.Timer(3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        regoplan.plan(long, out=tmp_path / "out")
    assert time.monotonic() - begun < 60
    assert json.loads((tmp_path / "out" / "plan.json").read_text())["interrupted"]


def test_what_progress_raises_ends_the_plan(scenario):
    class Enough(Exception):
        pass

    def progress(*_):
        raise Enough

    with pytest.raises(Enough):
        regoplan.plan(scenario, progress=progress)
