"""Forces of a wheel: the program's numbers, numpy's rules of shapes, and errors that name."""

import csv
import json
import pickle
import subprocess
import sys

import numpy as np
import pytest
import regoplan
from wheel_port import Port


def random_rows(count, seed=1):
    random = np.random.default_rng(seed)
    return (290 * np.exp(random.uniform(np.log(0.2), np.log(2), count)),
            random.uniform(-0.85, 0.9, count), random.uniform(-0.9, 0.9, count))


def same(a, b):
    return all(np.array_equal(getattr(a, n), getattr(b, n), equal_nan=True)
               for n in ("fx_n", "fy_n", "torque_nm", "sinkage_m", "status"))


def test_forces_are_the_programs_bit_for_bit(program, wheel, tmp_path):
    load, slip, angle = random_rows(300)
    angle_deg = np.degrees(angle)
    rows = tmp_path / "rows.csv"
    lines = [f"{a!r},{b!r},{c!r}" for a, b, c in zip(load.tolist(), slip.tolist(),
                                                      angle_deg.tolist())]
    rows.write_text("load_n,slip_ratio,slip_angle_deg\n" + "\n".join(lines) + "\n")
    model = tmp_path / "model.yaml"
    keys = wheel.to_dict()
    soil = "\n".join(f"  {key}: {value!r}" for key, value in keys["soil"].items())
    model.write_text(f"model: ishigami2007\nwheel: {{radius_m: 0.41, width_m: 0.23}}\n"
                     f"gravity_mps2: 1.62\nsoil:\n{soil}\n")
    ran = program("wheel", rows, "--model", model)
    assert ran.returncode == 0, ran.stderr
    table = list(csv.DictReader(ran.stdout.splitlines()))
    radians = angle_deg * (np.pi / 180)
    forces = wheel.forces(load, slip, radians)
    fc_n, fb_n = regoplan.cornering_and_drag(forces.fx_n, forces.fy_n, radians)
    for name, column in [*forces.to_dict().items(), ("fc_n", fc_n), ("fb_n", fb_n)]:
        if name == "status":
            assert [row["status"] for row in table] == list(column)
        else:
            assert [float(row[name]) for row in table] == column.tolist(), name
    assert same(forces, regoplan.Wheel.from_file(model).forces(load, slip, radians))


def test_forces_agree_with_the_paper_coded_in_numpy(wheel, soil):
    load, slip, angle = random_rows(2000)
    forces = wheel.forces(load, slip, angle)
    port = Port(0.41, 0.23, 1.62, soil.model_keys()).forces(load, slip, angle)
    assert np.all(forces.ok)
    for ours, theirs in zip((forces.fx_n, forces.fy_n), port[:2]):
        assert np.max(np.abs(ours - theirs) / load) < 1e-6
    assert np.max(np.abs(forces.sinkage_m - port[3])) < 1e-8


def test_shapes_broadcast_as_numpy_has_them(wheel):
    load, slip, angle = np.array([[100.0], [300.0]]), np.linspace(-0.5, 0.9, 7), 0.1
    forces = wheel.forces(load, slip, angle)
    assert forces.fx_n.shape == (2, 7)
    for i in range(2):
        for j in range(7):
            one = wheel.forces(load[i, 0], slip[j], angle)
            assert one.fx_n == forces.fx_n[i, j]
            assert isinstance(one.fx_n, float)
    assert wheel.forces([], 0.1, 0.0).fx_n.shape == (0,)
    assert wheel.forces(np.empty((3, 0)), 0.1, 0.0).fx_n.shape == (3, 0)
    ints = wheel.forces([100, 300], 0, 0)
    assert np.array_equal(ints.fx_n, wheel.forces([100.0, 300.0], 0.0, 0.0).fx_n)


def as_strided(a):
    wide = np.empty((len(a), 3))
    wide[:, 1] = a
    return wide[:, 1]


def unaligned(a):
    raw = np.empty(8 * len(a) + 1, np.uint8)
    view = raw[1:].view(np.float64)
    view[:] = a
    return view


@pytest.mark.parametrize("layout", [
    lambda a: a[::-1].copy()[::-1], as_strided, unaligned, lambda a: a.astype(">f8"),
    lambda a: np.broadcast_to(a, (2, len(a)))[1], list,
    lambda a: np.asfortranarray(np.stack([a, a]))[0],
])
def test_layout_changes_no_bit(wheel, layout):
    load, slip, angle = random_rows(3000)
    plain = wheel.forces(load, slip, angle)
    assert same(plain, wheel.forces(layout(load), layout(slip), layout(angle)))


def test_matrices_of_any_order_are_read_where_they_are(wheel):
    load, slip, angle = (column.reshape(40, 50) for column in random_rows(2000))
    plain = wheel.forces(load, slip, angle)
    assert same(plain, wheel.forces(np.asfortranarray(load), slip, angle[:, ::-1][:, ::-1]))
    cube = np.stack([load, load])
    assert np.array_equal(wheel.forces(cube.transpose(1, 2, 0), slip[..., None], 0.1).fx_n[..., 1],
                          wheel.forces(load, slip, 0.1).fx_n)


def test_read_only_arrays_are_read_and_stay(wheel):
    load, slip, angle = random_rows(10)
    for column in (load, slip, angle):
        column.flags.writeable = False
    before = load.copy()
    assert wheel.forces(load, slip, angle).fx_n.flags.writeable
    assert np.array_equal(load, before)


def test_threads_change_no_bit(wheel):
    rows = random_rows(20000)
    assert same(wheel.forces(*rows), wheel.forces(*rows, threads=3))


def test_a_wheel_without_forces_has_a_status_and_no_numbers(wheel):
    forces = wheel.forces([0.0, 1e9], 0.1, 0.0)
    assert forces.status.tolist() == [regoplan.STATUS["lifted"], regoplan.STATUS["sinks_to_axle"]]
    assert forces.fx_n[0] == 0 and np.isnan(forces.fx_n[1])


def test_a_table_is_within_its_error(wheel, soil):
    load, slip, angle = random_rows(5000)
    table = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62, method="table", nominal_load_n=290)
    direct, tabled = wheel.forces(load, slip, angle), table.forces(load, slip, angle)
    worst = table.table_facts()["error_worst"]
    assert worst <= 5e-3
    fx_n, fy_n = table.plane_forces(load, slip, angle)
    for ours, theirs in ((tabled.fx_n, direct.fx_n), (tabled.fy_n, direct.fy_n),
                         (fx_n, direct.fx_n), (fy_n, direct.fy_n)):
        assert np.max(np.abs(ours - theirs) / np.maximum(load, 29)) <= 1.2 * worst


def test_a_model_file_may_be_a_pipe(wheel):
    code = ("import regoplan; print(repr(float(regoplan.Wheel.from_file('/dev/stdin')"
            ".forces(290, 0.2, 0.1).fx_n)))")
    ran = subprocess.run([sys.executable, "-c", code], input=json.dumps(wheel.to_dict()), check=True,
                         capture_output=True, text=True)
    assert float(ran.stdout) == wheel.forces(290, 0.2, 0.1).fx_n


def test_mechanisms_act_and_are_listed(soil):
    ids = {entry["id"] for entry in regoplan.mechanisms()}
    assert "slip_sinkage" in ids
    base = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62)
    sinking = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62,
                             mechanisms=[{"id": "slip_sinkage"}])
    assert sinking.forces(290, 0.5, 0).sinkage_m > base.forces(290, 0.5, 0).sinkage_m
    worn = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62, mechanisms=[{"id": "multi_pass"}])
    first, second = worn.channels([290, 290], 0.2, 0, pass_number=[1, 2]).sinkage_m
    assert second < first
    with pytest.raises(regoplan.InputError, match="nothing_known"):
        regoplan.Wheel(0.41, 0.23, soil, mechanisms=[{"id": "nothing_known"}])


def test_objects_travel_between_processes(wheel, soil):
    assert same(wheel.forces(290, 0.2, 0.1), pickle.loads(pickle.dumps(wheel)).forces(290, 0.2, 0.1))
    vehicle = regoplan.Vehicle.preset("lrv")
    assert pickle.loads(pickle.dumps(vehicle)) == vehicle
    lrv = regoplan.VehicleOnSoil(vehicle, soil, 1.62, mechanisms=[{"id": "slip_sinkage"}], method="fast")
    there = pickle.loads(pickle.dumps(lrv))
    assert there.margins(2, 0.05).margin == lrv.margins(2, 0.05).margin
    assert (there.soil, repr(there.wheel)) == (soil, repr(lrv.wheel))


def test_what_was_checked_as_a_whole_does_not_change_in_parts(wheel, soil):
    for whole in (wheel, soil, regoplan.VehicleOnSoil("lrv", soil, 1.62)):
        for name in ("x", "soil", "_source"):
            with pytest.raises(AttributeError, match="cannot be changed"):
                setattr(whole, name, 3)
            with pytest.raises(AttributeError, match="cannot be changed"):
                delattr(whole, name)


def test_a_soil_is_taken_as_the_dict_that_it_gives(wheel, soil):
    keys = regoplan.Soil(**soil.model_keys(), source="a shear box").to_dict()
    of_dict = regoplan.Wheel(0.41, 0.23, keys, gravity_mps2=1.62)
    assert same(of_dict.forces(290, 0.2, 0.1), wheel.forces(290, 0.2, 0.1))
    lrv = regoplan.VehicleOnSoil("lrv", keys, 1.62)
    assert lrv.margins(2).margin == regoplan.VehicleOnSoil("lrv", soil, 1.62).margins(2).margin
    assert lrv.soil.source == "a shear box"


@pytest.mark.parametrize("arguments, field, allowed", [
    ((100, [0, 0, 1.5], 0), "slip_ratio[2]", "-1 to 1"),
    ((100, np.full((2, 3), np.nan), 0), "slip_ratio[0, 0]", "-1 to 1"),
    ((-1, 0, 0), "load_n", "at least 0"),
    ((np.inf, 0, 0), "load_n", "at least 0"),
    ((100, 0, [0, 2]), "slip_angle_rad[1]", None),
    (("100", 0, 0), "load_n", None),
    ((100, np.array([0.1, "x"], object), 0), "slip_ratio", None),
    ((100, 0.1j, 0), "slip_ratio", None),
    ((100, None, 0), "slip_ratio", None),
    ((100, True, 0), "slip_ratio", None),
    ((100, np.array(["2020-01-01"], "M8[D]"), 0), "slip_ratio", None),
    ((100, np.zeros(2, [("a", "f8")]), 0), "slip_ratio", None),
])
def test_bad_input_is_named(wheel, arguments, field, allowed):
    with pytest.raises(regoplan.InputError) as caught:
        wheel.forces(*arguments)
    assert caught.value.field == field
    assert allowed is None or caught.value.allowed == allowed


def test_the_lowest_bad_row_is_named_whatever_the_threads(wheel):
    slip = np.zeros(50000)
    slip[[1500, 49000]] = 7
    for threads in (1, 3):
        with pytest.raises(regoplan.InputError, match=r"slip_ratio\[1500\]: 7"):
            wheel.forces(100, slip, 0, threads=threads)


def test_shapes_that_do_not_broadcast_are_told(wheel):
    with pytest.raises(regoplan.InputError, match=r"slip_ratio.*load_n \(2,\), slip_ratio \(3,\)"):
        wheel.forces([1, 2], [0, 0, 0], 0)
    with pytest.raises(regoplan.InputError, match="load_n"):
        wheel.forces([[1, 2], [3]], 0, 0)


@pytest.mark.parametrize("change, told", [
    ({"radius_m": 0}, "wheel.radius_m: 0.0 is not valid"),
    ({"gravity_mps2": 1000}, "gravity_mps2: 1000.0 is not valid"),
    ({"width_m": float("nan")}, "wheel.width_m: nan is not valid"),
    ({"model": "ishigami"}, "model: 'ishigami' is not valid"),
    ({"method": "slow"}, "method: 'slow' is not valid"),
    ({"mechanisms": [{"id": "grousers", "n": 1}]}, r"mechanisms\[0\].n: unknown key"),
])
def test_bad_wheels_are_refused(soil, change, told):
    with pytest.raises(regoplan.InputError, match=told):
        regoplan.Wheel(**{"radius_m": 0.4, "width_m": 0.2, "soil": soil, **change})


def test_errors_of_files_know_their_place(wheel, tmp_path):
    file = tmp_path / "model.yaml"
    file.write_text(json.dumps({**wheel.to_dict(), "gravity_mps2": -1}, indent=1))
    with pytest.raises(regoplan.InputError) as caught:
        regoplan.Wheel.from_file(file)
    bad = caught.value
    assert (bad.file, bad.field, bad.value) == (str(file), "gravity_mps2", "-1") and bad.line > 1


def test_the_module_itself_knows_its_methods(wheel):
    with pytest.raises(regoplan.InputError, match="method: slow is not valid .*direct . fast"):
        regoplan._physics.WheelSource(json.dumps(wheel.to_dict()), "slow", 0)


def test_soils_are_strict_and_immutable(soil):
    assert soil.replace(cohesion_pa=500).cohesion_pa == 500
    assert soil.lambda_ == 0.9 and soil == regoplan.Soil(**soil.to_dict())
    with pytest.raises(regoplan.InputError, match="friction_angle_deg"):
        soil.replace(friction_angle_deg=80)
    with pytest.raises(regoplan.InputError, match="cohesion_kpa") as caught:
        regoplan.Soil(cohesion_kpa=1, **soil.model_keys())
    assert caught.value.field == "cohesion_kpa"
    with pytest.raises(AttributeError):
        soil.n = 2


def test_uncertain_soils_keep_what_is_not_known_of_them(soil):
    known = regoplan.Soil(**soil.model_keys())
    assert known.standard_deviations == {}
    uncertain = known.replace(cohesion_pa={"mean": 170, "std": 30}, lambda_={"mean": 0.8, "std": 0.1})
    assert (uncertain.cohesion_pa, uncertain.lambda_) == (170, 0.8)
    assert uncertain.standard_deviations == {"cohesion_pa": 30, "lambda": 0.1}
    assert uncertain == regoplan.Soil(**uncertain.to_dict()) == pickle.loads(pickle.dumps(uncertain))
    assert uncertain.replace(cohesion_pa=170).standard_deviations == {"lambda": 0.1}
    at_means = regoplan.Soil(**uncertain.model_keys())
    assert at_means.standard_deviations == {} and at_means != uncertain
    of_both = [regoplan.Wheel(0.4, 0.2, each).forces(100, 0.2, 0.1).fx_n for each in (uncertain, at_means)]
    assert of_both[0] == of_both[1]
    with pytest.raises(regoplan.InputError, match="std"):
        known.replace(cohesion_pa={"mean": 170, "std": -1})


def test_frames_have_the_columns_of_the_program(wheel):
    pandas = pytest.importorskip("pandas")
    frame = wheel.forces([100, 200], 0.1, 0.1).to_dataframe()
    assert isinstance(frame, pandas.DataFrame)
    assert list(frame) == ["fx_n", "fy_n", "torque_nm", "sinkage_m", "status"]
    channels = wheel.channels([100, 200], 0.1, 0.1)
    assert list(channels.to_dataframe()) == [*frame, "rut_left_m", "rut_right_m", "roll_moment_nm"]
    assert np.all(channels.rut_left_m >= 0) and wheel.forces(100, 0.1, 0.1).rut_left_m is None
    series = wheel.forces(pandas.Series([100.0, 200.0]), 0.1, 0.1)
    assert np.array_equal(series.fx_n, frame.fx_n)
    for dtype in ("Float64", "Int64"):  # pandas' own, which know of missing numbers
        loads = pandas.Series([100, 200], dtype=dtype)
        assert np.array_equal(wheel.forces(loads, 0.1, 0.1).fx_n, frame.fx_n)
    with pytest.raises(regoplan.InputError, match=r"load_n\[1\]: nan"):
        wheel.forces(pandas.Series([100, None], dtype="Float64"), 0.1, 0.1)
