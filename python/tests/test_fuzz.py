"""Arguments that nobody would give: an answer or an error of the package, never a crash.

A few seconds with every run of the tests; REGOPLAN_FUZZ_S=600 for a campaign, as under
AddressSanitizer (python/README.md).
"""

import os
import time

import numpy as np
import pytest
import regoplan

SECONDS = float(os.environ.get("REGOPLAN_FUZZ_S", "4"))


class Hostile:
    """Claims to be an array, and is none."""

    __array_interface__ = {"shape": (10,), "typestr": "<f8", "data": None, "version": 3}


class Raising:
    def __array__(self, *_, **__):
        raise ValueError("no array")

    def __float__(self):
        raise OverflowError("no number")


def shape(random):
    """Most broadcast with each other."""
    if random.random() < 0.2:
        return tuple(int(n) for n in random.integers(0, 5, int(random.integers(0, 4))))
    return [(), (1,), (3,), (2, 3), (2, 1), (4, 1, 3)][int(random.integers(0, 6))]


def numeric(random):
    values = random.normal(0, 10.0 ** random.integers(-3, 4), shape(random))
    kind = random.choice(["f2", "f4", "f8", ">f8", "<f4", "g", "i1", "i2", ">i4", "i8", "u1", "u8",
                          "?", "c16", "O", "U8", "S4", "M8[s]", "m8[s]"])
    with np.errstate(all="ignore"):
        try:
            array = values.astype(kind)
        except (TypeError, ValueError):
            array = np.zeros(values.shape, kind)
    return laid_out(random, array)


def laid_out(random, array):
    how = random.integers(0, 7)
    if how == 1 and array.ndim:
        array = np.repeat(array, 2, axis=-1)[..., ::2]
    elif how == 2 and array.ndim:
        array = array[::-1]
    elif how == 3:
        array = array.T
    elif how == 4:
        array = np.broadcast_to(array, (2, *array.shape))
    elif how == 5:
        array = array.copy()
        array.flags.writeable = False
    elif how == 6 and array.dtype.kind in "fiu":
        raw = np.zeros(array.nbytes + 1, np.uint8)
        raw[1:] = np.frombuffer(array.tobytes(), np.uint8)
        array = raw[1:].view(array.dtype).reshape(array.shape)
    return array


def odd(random):
    return [None, "x", b"x", {}, [], [[1, 2], [3]], (1, "a"), object(), float("nan"), float("inf"),
            -0.0, 10**400, 2**70, True, 1j, Hostile(), Raising(), np.ma.masked_array([1.0], [True]),
            np.datetime64("2020-01-01"), np.zeros(3, [("a", "f8")]), range(3), "\ud800", "\0",
            np.float64(0.1), np.array(0.1), {"mean": 1}, lambda: 0, np.nan,
            ][int(random.integers(0, 28))]


def argument(random):
    pick = random.random()
    if pick < 0.7:
        return laid_out(random, random.uniform(0, 0.3, shape(random)))
    return numeric(random) if pick < 0.85 else odd(random)


def key(random, names):
    """Names that Python lets stand before an equals sign, and text that it lets in by **."""
    return [*names, "wrong", "", "\ud800", "\0"][int(random.integers(0, len(names) + 4))]


def word(random, words):
    return odd(random) if random.random() < 0.3 else words[int(random.integers(0, len(words)))]


@pytest.fixture(scope="module")
def unstarted():
    """The commands check and name what they are given before the program starts, which it does not
    here."""
    from regoplan import _program

    def run(*_):
        raise regoplan.InputError("not started")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(_program, "run", run)
        yield


@pytest.fixture(scope="module")
def targets(soil, wheel, unstarted):
    vehicle = regoplan.Vehicle.preset("lrv")
    lrv = regoplan.VehicleOnSoil(vehicle, soil, 1.62)
    table = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62, method="table", nominal_load_n=290)
    keys = vehicle.to_dict()
    soil_keys = list(soil.model_keys())

    def ground(random):
        name = key(random, ["acceleration_mps2", "slope_forward_rad", "slope_left_rad"])
        return {name: argument(random)} if random.random() < 0.5 else {}

    def three(random):
        return [argument(random) for _ in range(3)]

    def options(random, names):
        return {names[int(random.integers(0, len(names)))]: word(random, [1, 0.5, argument(random)])}

    return [
        lambda r: regoplan.plan("s.yaml", **options(r, [
            "planner", "seed", "time_s", "iterations", "candidates", "improve", "threads", "force"])),
        lambda r: regoplan.evaluate("s.yaml", "p.csv", **options(r, [
            "speed_mps", "deviation_max_m", "follower", "draws", "seed", "threads", "progress"])),
        lambda r: regoplan.drive("s.yaml", "p.csv", **options(r, [
            "follower", "truth", "sensors", "deviation_max_m", "seed", "force"])),
        lambda r: regoplan.diagnose_drives("d.csv", "s.yaml", **options(r, ["seed", "setup", "threads"])),
        lambda r: regoplan.benchmark("suite.yaml", **options(r, ["shard", "processes"])),
        lambda r: wheel.forces(*three(r), threads=word(r, [1, 2, 3, 0])),
        lambda r: table.forces(*three(r)),
        lambda r: table.plane_forces(*three(r)),
        lambda r: wheel.channels(*three(r), **{key(r, ["pass_number", "time_s"]): argument(r)}),
        lambda r: regoplan.cornering_and_drag(*three(r)),
        lambda r: lrv.margins(argument(r), argument(r), **ground(r)),
        lambda r: lrv.supply(argument(r), argument(r), **ground(r)),
        lambda r: lrv.trim(argument(r), argument(r), **ground(r)),
        lambda r: lrv.largest_safe_curvature(argument(r), argument(r), margin_min=argument(r)),
        lambda r: soil.replace(**{key(r, soil_keys): argument(r)}),
        lambda r: vehicle.replace(**{key(r, list(keys)): argument(r)}),
        lambda r: regoplan.Wheel(argument(r), argument(r), word(r, [soil, {}, soil.model_keys()])),
        lambda r: regoplan.Wheel(0.4, 0.2, soil, mechanisms=[{key(r, ["id", "form"]): odd(r)}],
                                 model=word(r, ["ishigami2007", "yoshida2004"])),
        lambda r: regoplan.Wheel.from_file(odd(r)),
        lambda r: regoplan.Soil.preset(odd(r)),
        lambda r: regoplan.VehicleOnSoil(odd(r), soil, argument(r)),
        lambda r: regoplan.TerrainMap(argument(r), argument(r), word(r, [soil, {"a": {}}]),
                                      rocks=word(r, [None, argument(r)])),
    ]


def test_no_argument_crashes(targets):
    random = np.random.default_rng(7)
    until = time.monotonic() + SECONDS
    calls = errors = 0
    while time.monotonic() < until:
        for target in targets:
            calls += 1
            try:
                with np.errstate(all="ignore"):
                    target(random)
            except regoplan.InputError as bad:
                errors += 1
                assert str(bad)
    print(f"{calls} calls, {errors} of them refused")
    assert calls > 10 * len(targets) and 0 < errors < calls
