#!/usr/bin/env python3
"""Closes the loop in concealed worlds: plan, drive, diagnose, plan over what the drive told, drive.

Of each five worlds three hide a weak patch of 30 m on the middle third of the best path, one a fault
of the vehicle, one nothing; soils lie off their means in all. Both drives are made by `regoplan
drive` in the same true world with sensors A. Counted are limits that a drive broke and goals that it
did not reach. Folder and command may be given again: what is there already is not made anew.

    benchmarks/drives/planned_again.py PROGRAM FOLDER FIRST_SEED LAST_SEED [--time 8] [--jobs 2]
"""
import argparse
import concurrent.futures
import csv
import json
import math
import random
import subprocess
from pathlib import Path

from concealed import EFFECTS, SOIL, cratered
from nulls import NUMBERS

FAULTS = ("wheel_drag", "steering_offset", "cg_offset", "payload")
TERRAIN, GOAL = "{width_m: 400, height_m: 120, ", "{x_m: 350, y_m: 60, "


def kind_of(seed):
    return ("patch", "patch", "patch", "vehicle", "nothing")[seed % 5]


def shorter(scenario):
    """With its goal 180 m from the start."""
    assert TERRAIN in scenario and GOAL in scenario
    return scenario.replace(TERRAIN, "{width_m: 240, height_m: 120, ").replace(
        GOAL, "{x_m: 200, y_m: 60, ")


def patch(chance, path):
    with path.open() as file:
        rows = list(csv.DictReader(file))
    middle = rows[int(len(rows) * chance.uniform(1 / 3, 2 / 3))]
    x_m, y_m = float(middle["x_m"]), float(middle["y_m"])
    corners = [[round(x_m + 15 * math.cos(k * math.pi / 8), 2),
                round(y_m + 15 * math.sin(k * math.pi / 8), 2)] for k in range(16)]
    soil = {"friction_angle_deg": chance.uniform(20, 26), "cohesion_pa": chance.uniform(50, 150),
            "kc": 100, "kphi": math.exp(chance.uniform(math.log(1e4), math.log(4e4)))}
    return {"zones": [{"name": "patch", "like": "soft_patch", "soil": soil, "corners_m": corners}]}


class Loop:
    """One world: its plans, drives and diagnosis."""

    def __init__(self, program, folder, seed, time_s):
        self.program, self.folder, self.seed = program, folder / str(seed), seed
        self.time_s, self.kind = time_s, kind_of(seed)
        self.scenario = self.folder / "scenario.yaml"

    def run(self, result, *arguments):
        """Runs a command unless its result is there; exit status 2 is a result as well."""
        if (self.folder / result).exists():
            return
        done = subprocess.run([self.program, *map(str, arguments), "--force", "--quiet"],
                              capture_output=True, text=True, cwd=self.folder, check=False)
        if done.returncode not in (0, 2):
            raise RuntimeError(f"world {self.seed}, {arguments[0]}: {done.stderr}")

    def plan(self, scenario, folder):
        self.run(f"{folder}/plan.json", "plan", scenario, "--time", self.time_s, "--seed", self.seed,
                 "--threads", 1, "--out", folder)
        path = self.folder / folder / "candidate-1.csv"
        return path if path.exists() else None

    def drive(self, path, folder):
        # The truth is told from the known map: the follower of both drives knows that one.
        self.run(f"{folder}/drive.json", "drive", self.scenario, path, "--truth", "truth.json",
                 "--sensors", "A", "--seed", self.seed, "--out", folder)
        said = json.loads((self.folder / folder / "drive.json").read_text())
        unreached = said["status"] == "not_reached"
        return {"violations": len(said["limits_broken"]) + unreached, "status": said["status"],
                "reason": said["reason"]}

    def result(self):
        chance = random.Random(f"again {self.seed}")
        self.folder.mkdir(parents=True, exist_ok=True)
        self.scenario.write_text(shorter(cratered(chance)))
        first = self.plan("scenario.yaml", "first")
        if first is None:
            return None
        told = {"soils": {SOIL: {key: {"std": max(-1.5, min(1.5, chance.gauss(0, 0.5)))}
                                 for key in NUMBERS}}}
        if self.kind == "patch":
            told |= patch(chance, first)
        if self.kind == "vehicle":
            told |= EFFECTS[chance.choice(FAULTS)](chance)
        (self.folder / "truth.json").write_text(json.dumps(told, indent=1))
        before = self.drive(first, "driven")
        self.run("said/diagnosis.json", "diagnose", "driven/drive.csv", "--scenario",
                 "scenario.yaml", "--threads", 1, "--out", "said")
        said = json.loads((self.folder / "said/diagnosis.json").read_text())
        named = [claim["id"] for claim in said["mechanisms"]]
        corrected = self.folder / "said/corrected-map/scenario.yaml"
        if not corrected.exists():
            return before, before, named, "no corrected map"
        second = self.plan(corrected, "second")
        if second is None:
            return before, None, named, "no second path"
        return before, self.drive(second, "driven_again"), named, ""


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda text: Path(text).resolve())
    parser.add_argument("folder", type=lambda text: Path(text).resolve())
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--time", type=float, default=8)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    loops = [Loop(options.program, options.folder, seed, options.time)
             for seed in range(options.first, options.last + 1)]
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for loop, result in zip(loops, pool.map(Loop.result, loops)):
            if result is None:
                print(loop.seed, loop.kind, "no first path", flush=True)
                continue
            before, after, named, why = result
            print(loop.seed, loop.kind, named, before, "->", after, why, flush=True)
            rows.append((loop.kind, before, after))
    print("\n| concealed | worlds | drives not within limits, before -> after | violations | "
          "not planned again | safe made unsafe |\n|---|---|---|---|---|---|")
    for kind in ("patch", "vehicle", "nothing", "all"):
        of = [row for row in rows if kind in (row[0], "all")]
        unsafe = [sum(r[i] is not None and r[i]["violations"] > 0 for r in of) for i in (1, 2)]
        count = [sum(r[i]["violations"] for r in of if r[i]) for i in (1, 2)]
        worse = sum(r[1]["violations"] == 0 and r[2] is not None and r[2]["violations"] > 0
                    for r in of)
        print(f"| {kind} | {len(of)} | {unsafe[0]} -> {unsafe[1]} | {count[0]} -> {count[1]} | "
              f"{sum(r[2] is None for r in of)} | {worse} |")


if __name__ == "__main__":
    main()
