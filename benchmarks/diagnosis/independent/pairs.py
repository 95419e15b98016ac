#!/usr/bin/env python3
"""Pairs of recordings of one rig and soil, a reference and a test, drawn by chance; the test has an
effect, a difference without a name, an instrument of its own, or nothing.

    pairs.py FOLDER KIND SEED

writes test.csv, reference.csv, setup.yaml and truth.json to FOLDER. Both series share what the base
model lacks: another exponent and another shape of the pressure, a smoother rim, some sinkage with
slip and slip angle, smooth forces without a name, and days that scatter.
"""
import argparse
import csv
import dataclasses
import json
import pathlib

import numpy as np

from recordings import CHANNELS, DEGREE, SOILS, SPREAD, WHEELS
from wheel import Runs
from wheel_of_pair import WheelOfPair

SLIPS = ((0, .1, .3, .5, .7), (-.2, 0, .2, .4, .6), (0, .15, .3, .45), (.1, .3, .5, .7),
         (-.3, -.1, .1, .25, .4, .55, .7))
ANGLES_DEG = ((0,), (0, 10, 20), (0, 8, 16, 24), (0, 15), (0, 5, 10, 20, 30))
LOADS = ((1,), (1,), (.65, 1), (.6, 1, 1.5))
LEAST_RUNS, MOST_RUNS = 12, 60
# A difference whose chi-square is less cannot be told: it is about what 10 nats ask for beside two
# or three numbers that are fitted, and what the reference leaves uncertain takes its part.
WEAK_CHI_SQUARE = 50
# Degrees of freedom in both series together below which replicates hardly tell the noise.
FEW_REPLICATES = 8

EFFECTS = ("grousers", "slip_sinkage", "soil_change", "flank_friction", "side_surcharge",
           "multipass", "sensor_gain", "sensor_bias")
KINDS = ("same", "nameless", "nameless_sinkage", *EFFECTS)
# Names that say the same of a kind.
ACCEPTED = {"slip_sinkage": ["slip_sinkage", "sliding_sinkage"],
            "side_surcharge": ["side_surcharge", "side_pileup"],
            "multipass": ["multi_pass"]}
NEEDS_ANGLES = ("flank_friction", "side_surcharge")
# Weights of the three things that lugs do, by the one that rules.
LUGS = {"block": dict(lug_block=(.6, 1), lug_passive=(0, .25), lug_carry=(0, .4)),
        "passive": dict(lug_block=(0, .25), lug_passive=(.6, 1), lug_carry=(0, .4)),
        "carry": dict(lug_block=(0, .3), lug_passive=(.05, .3), lug_carry=(1, 2.5)),
        "all": dict(lug_block=(.3, .8), lug_passive=(.2, .7), lug_carry=(.5, 1.5))}


class SmoothField:
    """A random function of slip, slip angle and load without a form: waves whose lengths are those
    of a Gaussian process. Its root of the mean square is 1 over the runs it was made for."""

    def __init__(self, chance, runs, signed):
        self.length = chance.uniform(.6, 1.8)
        self.waves = chance.normal(size=(16, 3)) / self.length
        self.phases = chance.uniform(0, 2 * np.pi, 16)
        # A side force has the sign of the slip angle and none straight ahead.
        self.signed, self.mean_load_n, self.scale = signed, runs.load_n.mean(), 1
        self.scale = 1 / np.sqrt(np.mean(self(runs) ** 2))

    def __call__(self, runs):
        at = np.stack((runs.slip_ratio / .35, np.abs(runs.slip_angle_rad) / (10 * DEGREE),
                       (runs.load_n / self.mean_load_n - 1) / .4), 1)
        value = self.scale * np.cos(at @ self.waves.T + self.phases).mean(1)
        return value * np.tanh(runs.slip_angle_rad / (5 * DEGREE)) if self.signed else value


@dataclasses.dataclass
class Pair:
    """What is drawn of one pair."""
    wheel: tuple           # radius and width, m
    tests: dict            # the soil's numbers as tests have them
    soil: dict             # as they are
    other_soil: dict       # as they are in the test
    reference: Runs
    test: Runs
    noise: tuple           # one standard deviation of each channel
    shared: dict           # sizes of effects in both
    shared_fields: list    # of each channel, a field or None; in deviations of noise
    effects: dict          # sizes of effects in the test alone
    fields: list           # as shared_fields, in the test alone
    sinkage_field: object  # of a sinkage without a law; or None
    sinkage_way: str       # "excavated" or "imposed"
    fault: tuple           # of the test's instrument: id, channel, size; () for none
    lugs_rule: str
    conditions: str        # of the test: "same", "fewer" or "shifted" ones
    day_scatter: float     # in deviations of noise


def replicates_of(runs):
    """Degrees of freedom that replicates leave to the scatter of a run."""
    conditions = {(round(slip, 2), round(angle / DEGREE), round(load / runs.load_n.mean(), 1))
                  for slip, angle, load in zip(runs.slip_ratio, runs.slip_angle_rad, runs.load_n)}
    return len(runs.load_n) - len(conditions)


def signed(chance, low, high):
    return chance.choice((-1, 1)) * chance.uniform(low, high)


def draw_grid(chance, kind):
    """Conditions as (share of the load, slip, slip angle in degrees), 12 to 60 at most."""
    while True:
        angles_deg = ANGLES_DEG[chance.integers(len(ANGLES_DEG))]
        slips, loads = SLIPS[chance.integers(len(SLIPS))], LOADS[chance.integers(len(LOADS))]
        grid = [(load, slip, angle) for load in loads for slip in slips for angle in angles_deg]
        if len(grid) <= MOST_RUNS and not (kind in NEEDS_ANGLES and len(angles_deg) < 3):
            return grid


def draw_order(chance, grid, replication):
    """Runs in their order: `replication` is none, some or all."""
    grid = list(grid)
    if replication == "some":
        grid += [grid[at] for at in chance.permutation(len(grid))[:max(3, len(grid) // 3)]]
    if replication == "all":
        grid = grid * (3 if 3 * len(grid) <= MOST_RUNS else 2)
    while len(grid) < LEAST_RUNS:
        grid = grid * 2
    return [grid[at] for at in chance.permutation(len(grid))][:MOST_RUNS]


def runs_of(chance, order, load_n, wheel_pass, both_sides):
    rows, count = np.array(order), len(order)
    sides = chance.choice((-1, 1), count) if both_sides else np.ones(count)
    # Set slips and angles are reached well within what counts as a replicate.
    return Runs(load_n=load_n * rows[:, 0] * (1 + chance.normal(0, .01, count)),
                slip_ratio=rows[:, 1] + chance.normal(0, .001, count),
                slip_angle_rad=sides * rows[:, 2] * DEGREE, speed_mps=np.full(count, .05),
                wheel_pass=np.full(count, wheel_pass), position_m=np.zeros(count),
                time_s=np.arange(1.0, count + 1))


def draw_series(chance, kind, load_n):
    """Runs of reference and test, in a third of the pairs at other conditions; and at which."""
    grid = draw_grid(chance, kind)
    other, conditions = grid, "same"
    if chance.random() < .33:
        kept = chance.permutation(len(grid))[:max(LEAST_RUNS, int(.7 * len(grid)))]
        shift = chance.choice((0, .05))
        conditions = "shifted" if shift else "fewer"
        other = [(load, slip + shift, angle) for load, slip, angle in (grid[at] for at in kept)]
    both_sides = chance.random() < .2
    ways = chance.choice(("none", "some", "all"), 2, p=(.2, .45, .35))
    return (runs_of(chance, draw_order(chance, grid, ways[0]), load_n, 1, both_sides),
            runs_of(chance, draw_order(chance, other, ways[1]), load_n,
                    2 if kind == "multipass" else 1, both_sides), conditions)


def draw_shared(chance):
    """What both series have and the base model lacks, each in six of ten pairs."""
    ranges = dict(other_exponent=(-.2, .25), flat_stress=(-.25, .25), yielding=(.05, .35),
                  smooth_rim=(.05, .35), slip_sinkage=(.2, .8), lateral_digging=(.2, .8),
                  max_stress_angle=(-.5, .5), rear_contact=(.1, .3))
    return {name: chance.uniform(*span) for name, span in ranges.items() if chance.random() < .6}


def draw_soil_change(chance, soil):
    """One to three of strength, stiffness and shear moduli are others."""
    changed = dict(soil)
    kinds = chance.permutation(("strength", "stiffness", "modulus"))[:chance.integers(1, 4)]
    if "strength" in kinds:
        tangent = np.tan(soil["friction_angle_deg"] * DEGREE) * chance.uniform(.78, 1.25)
        changed["friction_angle_deg"] = np.arctan(tangent) / DEGREE
        changed["cohesion_pa"] *= chance.uniform(.3, 2.5)
    factor = {"kc": "stiffness", "kphi": "stiffness", "kx0_m": "modulus", "kx1_m": "modulus",
              "ky0_m": "modulus", "ky1_m": "modulus"}
    sizes = {kind: np.exp(signed(chance, .35, .9)) for kind in ("stiffness", "modulus")}
    for key, of in factor.items():
        if of in kinds:
            changed[key] *= sizes[of]
    return changed


def draw_effects(chance, kind, radius_m):
    """Sizes of what the test alone has, and for lugs what rules of their three parts."""
    if kind == "grousers":
        rule = str(chance.choice(list(LUGS)))
        sizes = {name: chance.uniform(*span) for name, span in LUGS[rule].items()}
        # Lugs are no higher than a sixth of the wheel's radius.
        height_m = min(round(chance.uniform(.005, .015), 4), round(radius_m / 6, 4))
        return dict(sizes, lug_height_m=height_m, lug_count=int(chance.integers(8, 31)),
                    lug_confined=chance.uniform(.1, .5), lug_way=chance.uniform(.3, 1.2)), rule
    if kind == "slip_sinkage":
        digs = chance.random() < .5
        return {"slip_excavation" if digs else "slip_sinkage":
                chance.uniform(*((.06, .25) if digs else (.5, 2)))}, ""
    sizes = dict(flank_friction=("flank_friction", .15, .45),
                 side_surcharge=("side_surcharge_pa", 2e3, 9e3), multipass=("multi_pass", .3, 1.5))
    if kind in sizes:
        name, low, high = sizes[kind]
        return {name: chance.uniform(low, high)}, ""
    return {}, ""


def draw_fields(chance, runs, least, most, counts):
    """Fields in deviations of noise on as many channels as `counts` has, as (field, size)."""
    fields, straight = [None] * len(CHANNELS), not np.any(runs.slip_angle_rad)
    channels = [at for at, name in enumerate(CHANNELS) if not (straight and name == "fy_n")]
    for channel in chance.permutation(channels)[:chance.choice(counts)]:
        fields[channel] = (SmoothField(chance, runs, CHANNELS[channel] == "fy_n"),
                           chance.uniform(least, most))
    return fields


def joined(one, other):
    return Runs(*(np.concatenate((getattr(one, field.name), getattr(other, field.name)))
                  for field in dataclasses.fields(Runs)))


def draw_pair(chance, kind):
    wheel = WHEELS[chance.integers(len(WHEELS))]
    tests = SOILS[chance.integers(len(SOILS))]
    soil = {key: mean * (1 + .8 * SPREAD[key] * np.clip(chance.normal(), -2, 2))
            for key, mean in tests.items()}
    load_n = wheel[0] * wheel[1] * chance.uniform(5e3, 9e3)
    reference, test, conditions = draw_series(chance, kind, load_n)
    noise = (chance.uniform(.012, .04) * load_n, chance.uniform(.01, .03) * load_n,
             chance.uniform(.01, .03) * load_n * wheel[0], chance.uniform(.0004, .0012))
    both = joined(reference, test)
    straight = not np.any(both.slip_angle_rad)
    channels = [at for at, name in enumerate(CHANNELS) if not (straight and name == "fy_n")]
    fault = ()
    if kind == "sensor_gain":
        fault = (kind, int(chance.choice(channels)), signed(chance, .08, .25))
    if kind == "sensor_bias":
        fault = (kind, int(chance.choice(channels)), signed(chance, 2, 6))
    effects, rule = draw_effects(chance, kind, wheel[0])
    pair = Pair(wheel, tests, soil,
                draw_soil_change(chance, soil) if kind == "soil_change" else soil,
                reference, test, noise, draw_shared(chance),
                draw_fields(chance, both, 1, 5, (2, 3, 4)), effects,
                draw_fields(chance, both, 3, 15, (1, 2, 3, 4)) if kind == "nameless"
                else [None] * len(CHANNELS), None, "", fault, rule, conditions,
                chance.uniform(0, .5))
    if kind == "grousers":
        # Two in three wheels have lugs between which soil can slide out sideways.
        pair.effects["lug_side_grip"] = chance.choice((0, 0, 1)) * chance.uniform(.3, 1)
    if kind == "nameless_sinkage":
        pair.sinkage_field = (SmoothField(chance, both, False), chance.uniform(3, 15))
        pair.sinkage_way = str(chance.choice(("excavated", "imposed")))
        if pair.sinkage_way == "excavated":
            # A wheel sinks by about half of the depth that is taken from below it.
            field, size = pair.sinkage_field
            pair.sinkage_field = (field, 2 * size)
    return pair


def of_fields(pair, fields, runs, channel):
    if fields[channel] is None:
        return 0
    field, size = fields[channel]
    return size * pair.noise[channel] * field(runs)


def values_of(pair, runs, soil, effects, with_sinkage_field=False):
    """Channels without noise, without faults and without what has no name in the test alone."""
    sizes = dict(pair.shared)
    for name, size in effects.items():
        sizes[name] = sizes.get(name, 0) + size
    moved_m = 0
    if with_sinkage_field:
        field, size = pair.sinkage_field
        moved_m = size * pair.noise[3] * field(runs)
        if pair.sinkage_way == "excavated":
            sizes["nameless_excavation_m"] = moved_m
    wheel = WheelOfPair(*pair.wheel, soil, runs, sizes)
    if with_sinkage_field and pair.sinkage_way == "imposed":
        wheel.impose(np.maximum(wheel.sinkage_m() + moved_m, .001))
    return [np.array(value) + of_fields(pair, pair.shared_fields, runs, channel)
            for channel, value in enumerate(wheel.channels())]


def test_values(pair, effects=None):
    """What the test's instruments would show without noise."""
    values = values_of(pair, pair.test, pair.other_soil,
                       pair.effects if effects is None else effects,
                       pair.sinkage_field is not None)
    values = [value + of_fields(pair, pair.fields, pair.test, channel)
              for channel, value in enumerate(values)]
    if pair.fault:
        fault, channel, size = pair.fault
        values[channel] = (values[channel] * (1 + size) if fault == "sensor_gain"
                           else values[channel] + size * pair.noise[channel])
    return values


def days_of(count):
    """A series takes three days."""
    return (np.arange(count) * 3) // count


def chi_square_of(pair, values, plain):
    """By channel. The noise is that of the test's run and of one run of the reference, and what
    days are off by: those of the test each by its own, those of the reference in the mean."""
    day = np.eye(3)[days_of(len(values[0]))]
    covariance = (2 * np.eye(len(day))
                  + pair.day_scatter ** 2 * (day @ day.T + np.ones((len(day), len(day))) / 3))
    return [float(off @ np.linalg.solve(covariance, off))
            for off in ((value - other) / noise
                        for value, other, noise in zip(values, plain, pair.noise))]


def is_physical(pair, values, deepest):
    return (all(np.isfinite(value).all() for value in values)
            and values[3].max() < deepest * pair.wheel[0])


def draw(seed, kind):
    """A pair and what it is worth; None where 200 draws give none that a wheel could drive."""
    chance = np.random.default_rng([seed, *map(ord, kind)])
    for _ in range(200):
        pair = draw_pair(chance, kind)
        bare = Pair(**{**vars(pair), "shared_fields": [None] * len(CHANNELS)})
        plain = values_of(pair, pair.test, pair.soil, {})
        values = test_values(pair)
        if not (is_physical(bare, values_of(bare, pair.reference, pair.soil, {}), .45)
                and is_physical(pair, plain, .5) and is_physical(pair, values, .75)):
            continue
        parts = {}
        for part in ("lug_block", "lug_passive", "lug_carry") if kind == "grousers" else ():
            others = {name: size for name, size in pair.effects.items()
                      if name == part or name not in LUGS["all"]}
            parts[part] = sum(chi_square_of(pair, test_values(pair, others), plain))
        return chance, pair, chi_square_of(pair, values, plain), parts
    return None


def noisy(chance, pair, values, heavy):
    """Channels as measured and the day of each run; days of a series are its own."""
    count = len(values[0])
    days = days_of(count)
    measured = []
    for value, noise in zip(values, pair.noise):
        scatter = (chance.standard_t(5, count) / np.sqrt(5 / 3) if heavy
                   else chance.normal(size=count))
        measured.append(value + noise * (scatter + pair.day_scatter * chance.normal(size=3)[days]))
    return measured, days


def write_series(path, runs, measured, extra):
    columns = {"load_n": runs.load_n, "slip_ratio": runs.slip_ratio,
               "slip_angle_deg": runs.slip_angle_rad / DEGREE, **measured, **extra}
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["run_id", *columns])
        for run, row in enumerate(zip(*columns.values())):
            table.writerow([f"{path.stem[0]}{run:03d}", *(f"{value:.7g}" for value in row)])


def write_pair(folder, seed, kind):
    """Whether a pair could be drawn."""
    drawn = draw(seed, kind)
    if drawn is None:
        return False
    chance, pair, chi_square, parts = drawn
    heavy, tells_days = chance.random() < .3, chance.random() < .5
    has_torque = chance.random() < .85 or bool(pair.fault)
    # Half of the pairs with lugs say so; all others say nothing of lugs.
    tells_lugs = kind == "grousers" and seed % 2 == 0
    folder.mkdir(parents=True, exist_ok=True)
    for name, runs, values, first_day in (
            ("reference", pair.reference, values_of(pair, pair.reference, pair.soil, {}), 1),
            ("test", pair.test, test_values(pair), 4)):
        measured, days = noisy(chance, pair, values, heavy)
        extra = {"day": first_day + days} if tells_days else {}
        if kind == "multipass":
            extra["pass"] = runs.wheel_pass
        if tells_lugs:
            is_test = name == "test"
            extra["lug_height_m"] = np.full(len(days), is_test * pair.effects["lug_height_m"])
            extra["lug_count"] = np.full(len(days), is_test * pair.effects["lug_count"])
        shown = {channel: value for channel, value in zip(CHANNELS, measured)
                 if has_torque or channel != "torque_nm"}
        write_series(folder / f"{name}.csv", runs, shown, extra)
    lines = [f"  {key}: {{mean: {mean:.7g}, std: {mean * SPREAD[key]:.6g}}}\n"
             for key, mean in pair.tests.items()]
    # Who has hardly a replicate has in half of the pairs another way to know the scatter of a run.
    replicates = [replicates_of(pair.reference), replicates_of(pair.test)]
    told = ""
    if sum(replicates) < FEW_REPLICATES and chance.random() < .5:
        told = "noise:\n" + "".join(f"  {channel}: {noise * chance.uniform(.85, 1.2):.6g}\n"
                                    for channel, noise in zip(CHANNELS, pair.noise))
    (folder / "setup.yaml").write_text(
        f"model: ishigami2007\nwheel: {{radius_m: {pair.wheel[0]}, width_m: {pair.wheel[1]}}}\n"
        f"gravity_mps2: 9.80665\nsoil:\n{''.join(lines)}{told}", encoding="utf-8")
    shown = [value for channel, value in zip(CHANNELS, chi_square)
             if has_torque or channel != "torque_nm"]
    (folder / "truth.json").write_text(json.dumps({
        "kind": kind, "seed": seed, "accepted": ACCEPTED.get(kind, [kind]),
        "chi_square": sum(shown), "chi_square_by_channel": dict(zip(CHANNELS, chi_square)),
        "too_weak": kind != "same" and sum(shown) < WEAK_CHI_SQUARE,
        "effects": pair.effects, "fault": [str(part) for part in pair.fault],
        "lugs_told": tells_lugs, "lugs_rule": pair.lugs_rule, "lugs_chi_square_alone": parts,
        "conditions": pair.conditions,
        "replicates": replicates,
        "sinkage_way": pair.sinkage_way, "shared": pair.shared,
        "noise": dict(zip(CHANNELS, pair.noise)), "noise_told": bool(told),
        "day_scatter": pair.day_scatter,
        "runs": [len(pair.reference.load_n), len(pair.test.load_n)],
        "changed_soil": {key: pair.other_soil[key] / pair.soil[key] for key in pair.soil
                         if pair.other_soil[key] != pair.soil[key]}}, indent=1), encoding="utf-8")
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("seed", type=int)
    arguments = parser.parse_args()
    if not write_pair(arguments.folder, arguments.seed, arguments.kind):
        parser.exit(1, "none of 200 draws could be driven\n")


if __name__ == "__main__":
    main()
