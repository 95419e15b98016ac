#!/usr/bin/env python3
"""Adds what lugs do on one bed to halves of a recording on another, and diagnoses each half.

    lugs_carried_over.py RECORDING.csv --setup SETUP.yaml FIRST LAST --radius-m R
                         [--lug-height-m H] [--program ./regoplan] [--folder FOLDER] [--jobs 2]

One random half of the recording stays as it is; to the other is added the difference between both
drums on the bed of grains (`granular_bed/`), as a smooth function of slip and slip angle: forces as
shares of the load, the sinkage as a share of the radius. So neither the recording nor what is added
to it is made by a wheel model. Only runs at slips and slip angles where the drums were driven count
(0 to .98, to 50 deg; the drums to .7 and 45 deg). With a lug height the columns of the test tell it.
Needs numpy.
"""
import argparse
import concurrent.futures
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "diagnosis" / "independent"))
from campaign import diagnosis_of  # noqa: E402
from csv_rows import read_rows, write_rows  # noqa: E402

CHANNELS = ("fx_n", "fy_n", "sinkage_m")
DRUM_RADIUS_M = 0.09
SLIP_SCALE, ANGLE_SCALE_DEG = 0.3, 25.0
NUGGET = 0.01  # of the smooth function's variance
SLIPS, ANGLE_MAX_DEG = (-0.03, 0.98), 50.0
LUGS = 15


def means(rows):
    """Of runs on ground that no wheel has driven on, by slip, slip angle and load."""
    groups = {}
    for row in rows:
        if row.get("pass", "1") != "1":
            continue
        at = (round(float(row["slip_ratio"]), 2), round(float(row["slip_angle_deg"])),
              round(float(row["load_n"])))
        groups.setdefault(at, []).append([float(row[channel]) for channel in CHANNELS])
    return {at: np.mean(values, axis=0) for at, values in groups.items()}


class LugsOfTheDrum:
    """What lugs add to each channel: shares of the load, and of the radius."""

    def __init__(self):
        smooth = means(read_rows(HERE / "granular_bed" / "smooth.csv"))
        lugged = means(read_rows(HERE / "granular_bed" / "grousered.csv"))
        both = sorted(smooth.keys() & lugged.keys())
        self.at = np.array([self.place(slip, angle) for slip, angle, _ in both])
        added = np.array([(lugged[at] - smooth[at]) / (at[2], at[2], DRUM_RADIUS_M)
                          for at in both])
        self.mean = added.mean(axis=0)
        kernel = self.kernel(self.at, self.at) + NUGGET * np.eye(len(both))
        self.weights = np.linalg.solve(kernel, added - self.mean)

    @staticmethod
    def place(slip, angle_deg):
        return slip / SLIP_SCALE, abs(angle_deg) / ANGLE_SCALE_DEG

    @staticmethod
    def kernel(a, b):
        return np.exp(-0.5 * ((a[:, None, :] - b[None]) ** 2).sum(-1))

    def __call__(self, slip, angle_deg):
        place = np.array([self.place(slip, angle_deg)])
        return self.mean + (self.kernel(place, self.at) @ self.weights)[0]


def is_driven_by_drums(row):
    return (SLIPS[0] <= float(row["slip_ratio"]) <= SLIPS[1]
            and abs(float(row["slip_angle_deg"])) <= ANGLE_MAX_DEG)


def with_lugs(row, lugs, radius_m, lug_height_m):
    fx, fy, depth = lugs(float(row["slip_ratio"]), float(row["slip_angle_deg"]))
    load_n, side = float(row["load_n"]), np.sign(float(row["fy_n"]))
    row = dict(row, fx_n=float(row["fx_n"]) + fx * load_n,
               fy_n=float(row["fy_n"]) + side * fy * load_n,
               sinkage_m=float(row["sinkage_m"]) + depth * radius_m)
    return dict(row, lug_height_m=lug_height_m, lug_count=LUGS) if lug_height_m else row


def draw(arguments, lugs, seed):
    rows = [row for row in read_rows(arguments.recording) if is_driven_by_drums(row)]
    order = np.random.default_rng(seed).permutation(len(rows))
    half = len(rows) // 2
    folder = arguments.folder / str(seed)
    folder.mkdir(parents=True, exist_ok=True)
    write_rows(folder / "test.csv",
               [with_lugs(rows[i], lugs, arguments.radius_m, arguments.lug_height_m)
                for i in sorted(order[:half])])
    write_rows(folder / "reference.csv", [rows[i] for i in sorted(order[half:])])
    (folder / "setup.yaml").write_text(arguments.setup.read_text(encoding="utf-8"),
                                       encoding="utf-8")
    return folder


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", type=pathlib.Path)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--setup", type=pathlib.Path, required=True)
    parser.add_argument("--radius-m", type=float, required=True)
    parser.add_argument("--lug-height-m", type=float)
    parser.add_argument("--program", type=lambda path: pathlib.Path(path).resolve(),
                        default=pathlib.Path("regoplan").resolve())
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("lugs-carried-over"))
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()

    lugs = LugsOfTheDrum()
    seeds = range(arguments.first, arguments.last + 1)
    folders = [draw(arguments, lugs, seed) for seed in seeds]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = list(pool.map(
            lambda folder: diagnosis_of(arguments.program, folder, "test.csv", "--reference",
                                        folder / "reference.csv"), folders))
    right = wrong = 0
    for seed, said in zip(seeds, results):
        classes = [{claim["id"], *claim["equivalent"]} for claim in said["mechanisms"]]
        wrong += any("grousers" not in names for names in classes)
        right += bool(classes) and all("grousers" in names for names in classes)
        claims = "; ".join(f"{' or '.join([claim['id'], *claim['equivalent']])} "
                           f"{claim['share']['low']:.2f} to {claim['share']['high']:.2f}"
                           for claim in said["mechanisms"])
        print(f"{seed}: {said['verdict']} {claims}")
    print(f"grousers {right} of {len(folders)}, wrong {wrong}")


if __name__ == "__main__":
    main()
