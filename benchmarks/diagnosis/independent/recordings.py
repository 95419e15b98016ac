"""Recordings of a single wheel with something concealed, drawn by chance: rig, soil, conditions,
effect, noise. The size of what is concealed is told in deviations of the runs' noise that are left
when the soil's numbers are fitted within their tests.
"""
import csv
import dataclasses
import json

import numpy as np

from wheel import Runs, WheelWithEffects

DEGREE = np.pi / 180
CHANNELS = ("fx_n", "fy_n", "torque_nm", "sinkage_m")
SOILS = (
    dict(cohesion_pa=800, friction_angle_deg=37, kc=1370, kphi=8.1e5, n=1.0, a0=.4, a1=.15,
         density_kgpm3=1600, kx0_m=.036, kx1_m=.043, ky0_m=.013, ky1_m=.02, **{"lambda": .9}),
    dict(cohesion_pa=150, friction_angle_deg=31, kc=900, kphi=1.2e6, n=1.1, a0=.38, a1=.2,
         density_kgpm3=1550, kx0_m=.015, kx1_m=.02, ky0_m=.012, ky1_m=.012, **{"lambda": .4}),
    dict(cohesion_pa=400, friction_angle_deg=34, kc=2000, kphi=6e5, n=.9, a0=.42, a1=.1,
         density_kgpm3=1450, kx0_m=.025, kx1_m=.02, ky0_m=.02, ky1_m=.02, **{"lambda": .6}),
)
# One standard deviation of a soil test, as a share of its mean.
SPREAD = dict(cohesion_pa=.22, friction_angle_deg=.045, kc=.25, kphi=.15, n=.04, a0=.06, a1=.2,
              density_kgpm3=.02, kx0_m=.2, kx1_m=.2, ky0_m=.2, ky1_m=.2, **{"lambda": .12})
WHEELS = ((.09, .1), (.15, .12), (.07, .09), (.2, .16))
SLIPS = ((-.3, 0, .15, .3, .5, .7), (-.5, -.2, .05, .2, .4, .6, .8), (0, .1, .2, .35, .55),
         (-.2, 0, .1, .25, .45, .65))
ANGLES_DEG = ((0, 8, 16, 24), (0, 5, 10, 20, 30), (0, 12, 24), (0, 6, 14))
LOADS = ((1,), (.7, 1.2), (.6, 1, 1.4))
SIZES = dict(slip_sinkage=(.5, 2), lateral_digging=(.4, 2), multi_pass=(.2, 1),
             rate_dependence=(.05, .5), soil_zone=(.2, .5), cohesion_drift=(.3, .9),
             rear_contact=(.2, .6), max_stress_angle=(.3, 1.2),
             shear_modulus_slip_angle=(.02, .08), skid_branch=(.4, 2), flexible_wheel=(.05, .3),
             load_transfer=(.05, .15), grousers=(.03, .12), layered_soil=(.5, 3),
             shear_hump=(.2, .6), coupled_shear=(.6, 1), side_pileup=(.3, 1.5),
             front_bulldozing=(.2, .8), sidewall_shear=(.3, 1.5), bearing_drag=(.02, .1),
             flank_friction=(.1, .4), slope_tilt=(.01, .05))
EITHER_SIGN = ("slope_tilt", "load_transfer", "max_stress_angle")
UNLISTED = ("dip in slip", "swing with slip", "ripples", "bent in load")
INSTRUMENTS = ("sensor_bias", "sensor_gain", "sensor_crosstalk", "slip_scale", "load_transfer")
# Names that say the same of these effects.
ACCEPTED = dict(slip_sinkage=["slip_sinkage", "sliding_sinkage"],
                lateral_digging=["lateral_digging", "sliding_sinkage"],
                side_pileup=["side_pileup", "side_surcharge"])


@dataclasses.dataclass
class Case:
    """What is drawn of one recording."""
    chance: np.random.Generator
    wheel: tuple
    tests: dict    # the soil's numbers as tests have them
    soil: dict     # as they are
    runs: Runs
    noise: tuple   # of each channel
    effects: dict  # of the wheel
    fault: tuple   # of an instrument: id, channel, size; () for none


def signed(chance, low, high):
    return chance.choice((-1, 1)) * chance.uniform(low, high)


def draw_runs(chance, wheel, effects, replicates):
    """Conditions three times each in orders of their own; speed and pass of each run may vary, and
    then hardly a condition is repeated."""
    load_n = wheel[0] * wheel[1] * chance.uniform(6e3, 1.1e4)
    grid = [(load_n * share, slip, angle * DEGREE)
            for share in LOADS[chance.integers(len(LOADS))]
            for slip in SLIPS[chance.integers(len(SLIPS))]
            for angle in ANGLES_DEG[chance.integers(len(ANGLES_DEG))]]
    chance.shuffle(grid)
    grid = grid[:chance.integers(28, 44)]
    rows = np.array([row for _ in range(3) for row in chance.permutation(grid)])
    count = len(rows)
    varied = 0 if replicates else .3
    speeds, passes = np.full(count, .05), np.ones(count, int)
    if "rate_dependence" in effects or chance.random() < varied:
        speeds = chance.choice((.02, .05, .1, .2), count)
    if "multi_pass" in effects or chance.random() < varied:
        passes = chance.integers(1, 4, count)
    return Runs(load_n=rows[:, 0] * (1 + chance.normal(0, .01, count)), slip_ratio=rows[:, 1],
                slip_angle_rad=rows[:, 2], speed_mps=speeds, wheel_pass=passes,
                position_m=chance.uniform(0, 3, count),
                time_s=np.cumsum(chance.uniform(200, 900, count)))


def draw_effects(chance, stratum):
    """Effects of the wheel, and a fault of an instrument."""
    if stratum in ("one_effect", "two_effects", "drift"):
        count = 2 if stratum == "two_effects" else 1
        ids = ["cohesion_drift"] if stratum == "drift" else chance.choice(list(SIZES), count, False)
        sizes = {str(one): chance.uniform(*SIZES[one]) for one in ids}
        return {one: size * (chance.choice((-1, 1)) if one in EITHER_SIGN else 1)
                for one, size in sizes.items()}, ()
    if stratum == "unlisted":
        return {str(chance.choice(UNLISTED)): chance.uniform(.05, .2)}, ()
    if stratum != "instruments":
        return {}, ()
    fault = str(chance.choice(INSTRUMENTS))
    if fault == "slip_scale":
        return {fault: signed(chance, .03, .08)}, ()
    if fault == "load_transfer":
        return {fault: signed(chance, .08, .2)}, ()
    size = {"sensor_bias": (1, 3), "sensor_gain": (.06, .2), "sensor_crosstalk": (.05, .15)}[fault]
    return {}, (fault, int(chance.integers(0, 3)), signed(chance, *size))


def draw_case(chance, stratum):
    effects, fault = draw_effects(chance, stratum)
    wheel = WHEELS[chance.integers(len(WHEELS))]
    tests = SOILS[chance.integers(len(SOILS))]
    soil = {key: mean * (1 + .8 * SPREAD[key] * np.clip(chance.normal(), -2, 2))
            for key, mean in tests.items()}
    runs = draw_runs(chance, wheel, effects, replicates=stratum == "drift")
    load_n = runs.load_n.mean()
    noise = (chance.uniform(.01, .025) * load_n, chance.uniform(.008, .02) * load_n,
             chance.uniform(.008, .02) * load_n * wheel[0], chance.uniform(.0004, .001))
    return Case(chance, wheel, tests, soil, runs, noise, effects, fault)


def values_of(case, effects=None, soil=None):
    """Channels without noise and without faults of instruments."""
    wheel = WheelWithEffects(*case.wheel, soil or case.soil, case.runs,
                             case.effects if effects is None else effects)
    return [np.array(channel) for channel in wheel.channels()]


def with_fault(case, values):
    if case.fault:
        fault, channel, size = case.fault
        other = 1 - channel if channel < 2 else 0
        add = {"sensor_bias": size * case.noise[channel],
               "sensor_gain": size * values[channel],
               "sensor_crosstalk": size * values[other] * (case.wheel[0] if channel == 2 else 1)}
        values[channel] = values[channel] + add[fault]
    return values


class Calibration:
    """The soil's numbers fitted within their tests, to first order."""

    def __init__(self, case):
        self.noise = case.noise
        self.base = self.white(values_of(case, {}))
        columns = []
        for key, spread in SPREAD.items():
            step = .3
            other = dict(case.soil, **{key: case.soil[key] * (1 + step * spread)})
            columns.append((self.white(values_of(case, {}, other)) - self.base) / step)
        self.columns = np.array(columns).T
        self.normal = self.columns.T @ self.columns + np.eye(len(columns))

    def white(self, values):
        return np.concatenate([value / noise for value, noise in zip(values, self.noise)])

    def left(self, difference):
        """Deviations of noise that no soil takes up."""
        fitted = np.linalg.solve(self.normal, self.columns.T @ difference)
        rest = difference - self.columns @ fitted
        return float(np.sqrt(rest @ rest + fitted @ fitted))


def is_physical(case, values, sinkage_share):
    return all(np.isfinite(value).all() for value in values) and (
        values[3].max() < sinkage_share * case.wheel[0])


def signal_of(case):
    """Deviations of all that is concealed, and of each effect beside the others; None where the
    wheel sinks in."""
    values, base = values_of(case), values_of(case, {})
    if not is_physical(case, base, .5) or not is_physical(case, values, .7):
        return None
    fit = Calibration(case)
    measured = fit.white(with_fault(case, values))
    parts = []
    for effect in case.effects if len(case.effects) > 1 else ():
        others = {one: size for one, size in case.effects.items() if one != effect}
        parts.append(fit.left(measured - fit.white(values_of(case, others))))
    return fit.left(measured - fit.base), parts


def is_worth_hiding(stratum, signal, parts):
    if stratum == "nulls":
        return True
    least = 6 if stratum in ("one_effect", "instruments") else 8
    return least < signal < 30 and all(8 < part < 40 for part in parts)


def draw_recording(seed, stratum):
    """A case whose concealed effect can be seen, with its sizes; None where 200 draws give none."""
    chance = np.random.default_rng(seed)
    for _ in range(200):
        case = draw_case(chance, stratum)
        signal = signal_of(case)
        if signal and is_worth_hiding(stratum, *signal):
            return case, signal
    return None


def noisy(case):
    """Channels as they are measured, and the day of each run."""
    chance, count = case.chance, len(case.runs.load_n)
    has_days = chance.random() < .5
    days = (np.arange(count) * 4) // count if has_days else np.zeros(count, int)
    heavy = chance.random() < .4
    measured = []
    for value, noise in zip(with_fault(case, values_of(case)), case.noise):
        scatter = (chance.standard_t(4, count) / np.sqrt(2) if heavy else chance.normal(size=count))
        measured.append(value + noise * (scatter + .3 * chance.normal(size=4)[days]))
    return measured, days


def write(case, signal, stratum, folder, truth_file):
    runs, chance = case.runs, case.chance
    measured, days = noisy(case)
    columns = {"load_n": runs.load_n, "slip_ratio": runs.slip_ratio,
               "slip_angle_deg": runs.slip_angle_rad / DEGREE, **dict(zip(CHANNELS, measured))}
    shows_torque = {"bearing_drag", "sidewall_shear"} & set(case.effects) or case.fault
    if chance.random() < .15 and not shows_torque:
        del columns["torque_nm"]
    for name, values, needed in (("day", days + 1, False), ("speed_mps", runs.speed_mps, False),
                                 ("pass", runs.wheel_pass, False),
                                 ("position_m", runs.position_m, "soil_zone" in case.effects),
                                 ("time_s", runs.time_s, "cohesion_drift" in case.effects)):
        told = np.ptp(values) > 0 if name in ("day", "speed_mps", "pass") else chance.random() < .4
        if told or needed:
            columns[name] = values
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "recording.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["run_id", *columns])
        for run, row in enumerate(zip(*columns.values())):
            table.writerow([f"r{run:03d}", *(f"{value:.7g}" for value in row)])
    soil = "".join(f"  {key}: {{mean: {mean:.7g}, std: {mean * SPREAD[key]:.6g}}}\n"
                   for key, mean in case.tests.items())
    (folder / "setup.yaml").write_text(
        f"model: ishigami2007\nwheel: {{radius_m: {case.wheel[0]}, width_m: {case.wheel[1]}}}\n"
        f"gravity_mps2: 9.80665\nsoil:\n{soil}", encoding="utf-8")
    ids = [case.fault[0]] if case.fault else list(case.effects)
    truth_file.parent.mkdir(parents=True, exist_ok=True)
    truth_file.write_text(json.dumps({
        "stratum": stratum, "ids": ids, "accepted": [ACCEPTED.get(one, [one]) for one in ids],
        "sizes": {one: float(size) for one, size in case.effects.items()},
        "fault": [str(part) for part in case.fault], "signal": signal[0], "parts": signal[1]},
        indent=1), encoding="utf-8")
