#!/usr/bin/env python3
"""Adds effects to halves of a recording and diagnoses each half against the other.

    effects_added.py RECORDING.csv --setup SETUP.yaml FIRST LAST [--kinds grousers,nameless]
                     [--program ./regoplan] [--folder FOLDER] [--jobs 2]

Scatter, days and what the base model lacks are those of the recording. One random half stays as it
is; to the other is added what the numpy wheel of `../diagnosis/independent` has with an effect more
than without it, at the setup's soil and wheel. Sizes are drawn there. Needs numpy and PyYAML.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import sys

import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "diagnosis" / "independent"))
from campaign import diagnosis_of  # noqa: E402
from csv_rows import read_rows, write_rows  # noqa: E402
from pairs import (ACCEPTED, EFFECTS, WEAK_CHI_SQUARE, SmoothField, draw_effects,  # noqa: E402
                   draw_shared, draw_soil_change)
from pairs_campaign import outcome, print_table  # noqa: E402
from wheel import Runs  # noqa: E402
from wheel_of_pair import WheelOfPair  # noqa: E402

CHANNELS = ("fx_n", "fy_n", "torque_nm", "sinkage_m")
KINDS = ("same", "nameless", "grousers", "slip_sinkage", "soil_change", "flank_friction",
         "side_surcharge")


# A diagnosis trusts its model within these slip ratios and up to this slip angle; the numpy wheel
# can be driven within the former.
TRUSTED_SLIP = -.9, .95
TRUSTED_ANGLE_DEG = 60


def means_of(setup):
    """Radius, width and the soil's means, as the numpy wheel wants them."""
    soil = {key: float(value["mean"] if isinstance(value, dict) else value)
            for key, value in setup["soil"].items()}
    return ((setup["wheel"]["radius_m"], setup["wheel"]["width_m"]),
            {"kx1_m": 0, "ky1_m": 0, **soil})


def runs_of(rows):
    """Runs at slip ratios that the numpy wheel can be driven at."""
    def column(name):
        return np.array([float(row[name]) for row in rows])
    still = np.zeros(len(rows))
    return Runs(load_n=column("load_n"), slip_ratio=np.clip(column("slip_ratio"), *TRUSTED_SLIP),
                slip_angle_rad=np.deg2rad(column("slip_angle_deg")), speed_mps=still + .01,
                wheel_pass=still + 1, position_m=still, time_s=np.arange(1., len(rows) + 1))


def is_judged(row):
    """Whether a diagnosis judges a run."""
    low, high = TRUSTED_SLIP
    return (low <= float(row["slip_ratio"]) <= high
            and abs(float(row["slip_angle_deg"])) <= TRUSTED_ANGLE_DEG)


def scatter_of(rows, channel):
    """Standard deviation of one run, as replicates tell it beside what their loads do."""
    groups = collections.defaultdict(list)
    for row in rows:
        at = round(float(row["slip_ratio"]), 2), round(float(row["slip_angle_deg"]))
        groups[at].append((float(row[channel]), float(row["load_n"])))
    off, by_load = [], []
    for group in map(np.array, groups.values()):
        value, load_n = group.T
        off.extend(value - value.mean())
        by_load.extend(value.mean() * (load_n / load_n.mean() - 1))
    off, by_load = np.array(off), np.array(by_load)
    square = by_load @ by_load
    left = off - (by_load @ off / square if square else 0) * by_load
    return np.sqrt(left @ left / max(1, len(rows) - len(groups) - 1))


def added(chance, kind, wheel, soil, runs, noise):
    """What an effect adds to each channel, and its sizes."""
    if kind == "same":
        return [0 * runs.load_n for _ in CHANNELS], {}
    if kind == "nameless":
        return [SmoothField(chance, runs, channel == "fy_n")(runs) * chance.uniform(3, 15) * size
                for channel, size in zip(CHANNELS, noise)], {}
    shared = draw_shared(chance)
    effects, _ = draw_effects(chance, kind, wheel[0])
    other = draw_soil_change(chance, soil) if kind == "soil_change" else soil
    without = WheelOfPair(*wheel, soil, runs, shared).channels()
    with_it = WheelOfPair(*wheel, other, runs, {**shared, **effects}).channels()
    return [np.array(b) - np.array(a) for a, b in zip(without, with_it)], effects


def draw_change(chance, kind, setup, rows, test):
    """What is added to each channel of the test, a side force as the recording has its sign, in
    standard deviations of a run too, and the sizes of effects; None where the wheel would stand
    deeper than its axle, or nowhere, or be pushed with more than three of its loads."""
    wheel, soil = means_of(setup)
    runs = runs_of(test)
    noise = [scatter_of(rows, channel) if rows[0].get(channel) else 1 for channel in CHANNELS]
    change, effects = added(chance, kind, wheel, soil, runs, noise)
    told = np.array([[float(row.get(channel) or 0) for row in test] for channel in CHANNELS])
    if told[1].any():
        change[1] = change[1] * np.sign(told[1] @ WheelOfPair(*wheel, soil, runs, {}).channels()[1])
    after = told + change
    if (not np.all(np.isfinite(change)) or np.max(after[3]) > wheel[0]
            or np.max(np.abs(after[:2]) / runs.load_n) > 3):
        return None
    return dict(zip(CHANNELS, change)), dict(zip(CHANNELS, noise)), effects


def draw(arguments, kind, seed):
    """Writes a pair; its name, or None where 20 draws could not be driven."""
    chance = np.random.default_rng([seed, KINDS.index(kind)])
    rows = read_rows(arguments.recording)
    setup = yaml.safe_load(arguments.setup.read_text(encoding="utf-8"))
    first = set(chance.permutation(len(rows))[:len(rows) // 2].tolist())
    reference = [dict(row) for at, row in enumerate(rows) if at in first]
    test = [dict(row) for at, row in enumerate(rows) if at not in first]
    drawn = (draw_change(chance, kind, setup, rows, test) for _ in range(20))
    found = next(filter(None, drawn), None)
    if found is None:
        return None
    change, noise, effects = found
    measured = [channel for channel in CHANNELS if rows[0].get(channel)]
    for channel in measured:
        for row, value in zip(test, change[channel]):
            row[channel] = float(row[channel]) + value
    # Even seeds tell the lugs.
    if kind == "grousers" and seed % 2 == 0:
        for row in reference:
            row.update(lug_height_m=0, lug_count=0)
        for row in test:
            row.update(lug_height_m=effects["lug_height_m"], lug_count=effects["lug_count"])
    judged = np.array([is_judged(row) for row in test])
    chi_square = float(sum(np.sum((change[c][judged] / noise[c]) ** 2) for c in measured))
    folder = arguments.folder / f"{kind}-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    write_rows(folder / "test.csv", test)
    write_rows(folder / "reference.csv", reference)
    (folder / "setup.yaml").write_text(arguments.setup.read_text(encoding="utf-8"),
                                       encoding="utf-8")
    truth = {"kind": kind, "accepted": ACCEPTED.get(kind, [kind] if kind in EFFECTS else []),
             "chi_square": chi_square, "effects": effects,
             "too_weak": kind != "same" and chi_square < WEAK_CHI_SQUARE}
    (folder / "truth.json").write_text(json.dumps(truth, indent=1), encoding="utf-8")
    return folder.name


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", type=pathlib.Path)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--setup", type=pathlib.Path, required=True)
    parser.add_argument("--kinds", type=lambda text: text.split(","), default=list(KINDS))
    parser.add_argument("--program", type=lambda path: pathlib.Path(path).resolve(),
                        default=pathlib.Path("regoplan").resolve())
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("effects-added"))
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    if unknown := set(arguments.kinds) - set(KINDS):
        parser.error(f"no such kind: {', '.join(sorted(unknown))}")

    cases = [(kind, seed) for seed in range(arguments.first, arguments.last + 1)
             for kind in arguments.kinds]
    names = [draw(arguments, kind, seed) for kind, seed in cases]

    def diagnosed(name):
        folder = arguments.folder / name
        return name, diagnosis_of(arguments.program, folder, "test.csv", "--reference",
                                  folder / "reference.csv")

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = dict(pool.map(diagnosed, filter(None, names)))
    counts = collections.defaultdict(collections.Counter)
    verdicts = collections.defaultdict(collections.Counter)
    for name, said in results.items():
        truth = json.loads((arguments.folder / name / "truth.json").read_text(encoding="utf-8"))
        found = outcome(truth, said)
        counts[truth["kind"]][found] += 1
        verdicts[truth["kind"]][said["verdict"]] += 1
        claimed = "; ".join(
            f"{' or '.join([claim['id'], *claim['equivalent']])} {claim['share']['low']:.2f}"
            for claim in said["mechanisms"])
        print(f"{name}: chi-square {truth['chi_square']:.0f}; {found}, {said['verdict']} {claimed}")
    print_table(arguments.kinds, counts, verdicts)
    if undriven := [f"{kind}-{seed}" for name, (kind, seed) in zip(names, cases) if name is None]:
        print(f"the wheel cannot be driven so: {', '.join(undriven)}")


if __name__ == "__main__":
    main()
