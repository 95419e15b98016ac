"""Vehicles on soils: the program's margins and charts."""

import csv

import numpy as np
import pytest
import regoplan


@pytest.fixture(scope="module")
def lrv(soil):
    return regoplan.VehicleOnSoil("lrv", soil, 1.62)


def test_margins_follow_their_definitions(lrv):
    speed, curvature = np.array([[1.0], [3.0]]), np.array([0, 1 / 20, -1 / 20])
    m = lrv.margins(speed, curvature)
    mass = lrv.vehicle.mass_kg
    np.testing.assert_allclose(m.demand_n, mass * speed**2 * curvature, rtol=1e-12)
    weight = mass * 1.62
    cornering = np.minimum(m.supply_max_n - m.demand_n, m.demand_n - m.supply_min_n) / weight
    np.testing.assert_allclose(m.cornering, cornering, rtol=1e-12)
    assert np.array_equal(m.margin, np.minimum(np.minimum(m.cornering, m.tip_over), m.traction))
    np.testing.assert_allclose(m.margin[:, 1], m.margin[:, 2], rtol=1e-6)  # left as right
    assert np.all(m.margin[1] <= m.margin[0])


def test_supply_names_what_ends_it(lrv):
    supply = lrv.supply(2, 1 / 15)
    m = lrv.margins(2, 1 / 15)
    assert supply["left"]["force_n"] == m.supply_max_n
    assert supply["right"]["force_n"] == m.supply_min_n
    assert supply["left"]["limit"] == "slip angle"
    names = [wheel["name"] for wheel in lrv.vehicle.wheels]
    assert supply["left"]["wheel"] in names
    steep = lrv.supply(1, 0, slope_forward_rad=1.0)
    assert steep["left"] is None and steep["reason"] in ("traction", "yaw")


def test_a_trim_balances_the_vehicle(lrv):
    trim = lrv.trim(2, 1 / 15)
    assert trim["found"]
    wheels = trim["wheels"]
    mass = lrv.vehicle.mass_kg
    assert sum(w["load_n"] for w in wheels) == pytest.approx(mass * 1.62, rel=1e-9)
    # Forces (fx, -fy) of the wheels, turned into the body and then the path: m v^2 k to the left.
    forward = sum(w["fx_n"] * np.cos(w["steer_rad"]) + w["fy_n"] * np.sin(w["steer_rad"])
                  for w in wheels)
    left = sum(w["fx_n"] * np.sin(w["steer_rad"]) - w["fy_n"] * np.cos(w["steer_rad"])
               for w in wheels)
    slip = trim["body_slip_angle_rad"]
    assert left * np.cos(slip) - forward * np.sin(slip) == pytest.approx(mass * 4 / 15, rel=1e-6)
    none = lrv.trim(8, 1 / 15)
    assert not none["found"] and none["limit"]


def test_safe_curvatures_are_those_of_the_programs_chart(program, soil, tmp_path):
    keys = "\n".join(f"    {key}: {value!r}" for key, value in soil.model_keys().items())
    soils = tmp_path / "soils.yaml"
    soils.write_text(f"soils:\n  firm:\n    source: test\n{keys}\n")
    ran = program("evaluate", "--chart", tmp_path / "chart", "--vehicle", "lrv", "--soils", soils,
                  "--gravity-mps2", "1.62", "--chart-slopes-deg", "0", "10")
    assert ran.returncode == 0, ran.stderr
    with open(tmp_path / "chart" / "safe-curvature.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 38
    speed = np.array([float(row["speed_mps"]) for row in rows])
    slope = np.array([float(row["slope_deg"]) for row in rows]) * (np.pi / 180)
    found = regoplan.VehicleOnSoil("lrv", soil, 1.62).largest_safe_curvature(speed, slope)
    printed = [f"{curvature:.5g}" for curvature in found.curvature_1pm]
    assert [row["curvature_max_1pm"] for row in rows] == printed
    assert [row["limited_by"] for row in rows] == found.limit.tolist()


def test_margins_across_a_slope_are_those_of_the_programs_chart(program, soil, tmp_path):
    soils = tmp_path / "soils.yaml"
    soils.write_text("soils:\n  firm:\n    source: test\n" + "".join(
        f"    {key}: {value!r}\n" for key, value in soil.model_keys().items()))
    ran = program("evaluate", "--chart", tmp_path / "chart", "--vehicle", "curiosity", "--soils",
                  soils, "--gravity-mps2", "3.71")
    assert ran.returncode == 0, ran.stderr
    with open(tmp_path / "chart" / "side-slope.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    slope_rad = np.radians([float(row["slope_deg"]) for row in rows])
    rover = regoplan.VehicleOnSoil("curiosity", soil, 3.71, method="fast")
    found = rover.margins(0.01, 0, slope_left_rad=slope_rad)
    assert np.any(found.traction < 0) and np.any(found.traction > 0)
    for column, values in (("cornering_margin", found.cornering), ("tip_over_margin", found.tip_over),
                           ("traction_margin", found.traction), ("margin", found.margin)):
        told = [float(row[column]) for row in rows]
        np.testing.assert_allclose(values, told, rtol=1e-4, atol=1e-5, err_msg=column)


def test_without_any_supply_only_the_tip_over_margin_is_told(lrv):
    steep = lrv.margins(1, 0, slope_forward_rad=1.0)
    assert np.isnan(steep.supply_min_n) and np.isfinite(steep.tip_over)
    assert np.isnan([steep.cornering, steep.traction, steep.margin]).all()


def test_soils_that_come_with_regoplan_are_those_that_the_program_prints(program, tmp_path):
    for name in regoplan.Soil.presets():
        file = tmp_path / f"{name}.yaml"
        file.write_text(program("soil", name).stdout)
        assert regoplan.Soil.from_file(file)[name] == regoplan.Soil.preset(name)
    assert " | ".join(regoplan.Soil.presets()) in program("soil", "dust").stderr


def test_vehicles_read_and_write_what_files_say(tmp_path):
    assert set(regoplan.Vehicle.presets()) == {"tohoku", "lrv", "curiosity"}
    for name in regoplan.Vehicle.presets():
        vehicle = regoplan.Vehicle.preset(name)
        assert regoplan.Vehicle(**vehicle.to_dict()) == vehicle
    heavy = vehicle.replace(mass_kg=1000)
    assert heavy.mass_kg == 1000 and heavy != vehicle
    with pytest.raises(regoplan.InputError, match="mass_kg"):
        vehicle.replace(mass_kg=-1)
    with pytest.raises(regoplan.InputError, match="masse"):
        vehicle.replace(masse=1)


def test_without_a_curvature_the_vehicle_drives_straight_on(lrv):
    assert lrv.margins(speed_mps=50).margin == lrv.margins(50, 0).margin
    assert lrv.supply(2) == lrv.supply(2, 0)
    assert lrv.trim(2) == lrv.trim(2, 0)


def test_bad_moments_are_named(lrv):
    for arguments, keywords, field in [
        (([1, -1], 0), {}, "speed_mps[1]"),
        ((1, 1e3), {}, "curvature_1pm"),
        ((1, 0), {"slope_left_rad": np.nan}, "slope_left_rad"),
    ]:
        with pytest.raises(regoplan.InputError) as caught:
            lrv.margins(*arguments, **keywords)
        assert caught.value.field == field
    for bad in (1, -0.1, np.nan):
        with pytest.raises(regoplan.InputError) as caught:
            lrv.largest_safe_curvature(1, margin_min=bad)
        assert (caught.value.field, caught.value.allowed) == ("margin_min", "0 to below 1")
    with pytest.raises(regoplan.InputError, match="slope_up"):
        lrv.margins(1, 0, slope_up=1)
    with pytest.raises(regoplan.InputError, match="single number"):
        lrv.trim([1, 2], 0)
    with pytest.raises(regoplan.InputError, match="gravity_mps2"):
        regoplan.VehicleOnSoil("lrv", lrv.soil, -1)


def test_results_are_columns_by_name(lrv):
    found = lrv.largest_safe_curvature([[1.0, 2.0]], [[0.0], [0.1]])
    assert list(found.to_dict()) == ["curvature_1pm", "supply_n", "limit"]
    assert all(column.shape == (2, 2) for column in found.to_dict().values())
    assert lrv.largest_safe_curvature([]).limit.shape == (0,)
    assert isinstance(lrv.largest_safe_curvature(1).limit, str)
    pytest.importorskip("pandas")
    assert len(found.to_dataframe()) == 4
    assert list(lrv.margins(1, [0, 0.05]).to_dataframe())[-1] == "margin"


def test_results_show_what_they_are(lrv):
    shown = repr(lrv.largest_safe_curvature(1))
    assert shown.startswith("SafeCurvature(0.52") and shown.endswith(" N, limited by steering)")
    assert repr(lrv.largest_safe_curvature([1, 3])).startswith("SafeCurvature(shape (2,), ")
    assert repr(lrv.largest_safe_curvature([])) == "SafeCurvature(shape (0,))"
    assert repr(lrv.margins(1, [0, 0.1])) == "Margins(shape (2,))"


def test_threads_change_no_bit(lrv):
    speed = np.linspace(0.5, 3.5, 60)
    assert np.array_equal(lrv.margins(speed, 0.05).margin,
                          lrv.margins(speed, 0.05, threads=3).margin)
