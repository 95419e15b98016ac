#!/usr/bin/env python3
"""Verified candidates of the feasible scenarios, driven in closed loop.

    benchmarks/drives/candidates.py PROGRAM [--time S] [--draws N] [--seed N]

With the planned soils every candidate should reach the goal with no limit broken that its verdict
called held, and `evaluate` should call it feasible. With soils drawn from their spread, the share of drives within all
limits is held against the plan's `probability_feasible`.
"""
import argparse
import json
import random
import subprocess
import tempfile
from pathlib import Path

SCENARIOS = Path(__file__).resolve().parents[1] / "scenarios"


class Refused(Exception):
    """What the program says of its input."""


def run(program, *arguments):
    """The JSON that is printed."""
    done = subprocess.run([program, *map(str, arguments), "--json", "--quiet", "--force"],
                          capture_output=True, text=True)
    if done.returncode not in (0, 2):
        raise Refused(done.stderr.strip())
    return json.loads(done.stdout)


def uncertain(scenario):
    """Mean and standard deviation of the numbers of each soil that have a spread."""
    import yaml
    settings = yaml.safe_load(scenario.read_text())
    soils = settings["map"]["soils"]
    if isinstance(soils, str):
        soils = yaml.safe_load((scenario.parent / soils).read_text())
    return {name: {key: (float(value["mean"]), float(value["std"])) for key, value in soil.items()
                   if isinstance(value, dict) and float(value.get("std", 0)) > 0}
            for name, soil in soils["soils"].items()}


def drive(program, scenario, path, folder, follower, truth=None):
    options = ["--truth", truth] if truth else []
    return run(program, "drive", scenario, path, "--out", folder / "drive", "--follower", follower,
               *options)


def deviations(mean, std, chance):
    """Of a normal distribution that stops at 0, as the plan draws."""
    while True:
        k = chance.gauss(0, 1)
        if mean + k * std > 0:
            return k


def drawn_truth(numbers, chance, file):
    soils = {name: {key: {"std": deviations(*spread, chance)} for key, spread in keys.items()}
             for name, keys in numbers.items() if keys}
    file.write_text(json.dumps({"soils": soils}))
    return file


def driven_candidate(options, scenario, entry, folder, numbers, chance):
    """The cells of a candidate's row."""
    path = folder / "plan" / entry["file"]
    told = []
    for follower in ("pursuit", "compensated"):
        driven = drive(options.program, scenario, path, folder, follower)
        why = driven["status"] if driven["status"] == "reached" else driven["reason"]
        told.append(f"{why} {driven['cross_track_max_m']:.3f} m")
    judged = run(options.program, "evaluate", scenario, path, "--out", folder / "evaluated",
                 "--draws", 10)
    told.append(judged["status"])
    likely = "not drawn"
    if entry["probability_feasible"] is not None:
        low, high = entry["probability_feasible_ci95"]
        likely = f"{entry['probability_feasible']:.2f} [{low:.2f}, {high:.2f}]"
    held = ""
    if options.draws and any(numbers.values()) and entry["probability_feasible"] is not None:
        reached = sum(drive(options.program, scenario, path, folder, "compensated",
                            drawn_truth(numbers, chance, folder / "truth.yaml"))["status"] == "reached"
                      for _ in range(options.draws))
        held = f"{reached} of {options.draws}"
    return f"{likely:>24} {told[0]:>26} {told[1]:>26} {told[2]:>10} {held:>18}"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--time", type=float, default=15)
    parser.add_argument("--draws", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", help="names of scenarios; without: all feasible ones")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    print(f"{'scenario':>16} {'rank':>4} {'probability, 95 %':>24} "
          f"{'pursuit':>26} {'compensated':>26} {'evaluate':>10} {'held, drawn soils':>18}")
    for scenario in sorted(SCENARIOS.glob("*.yaml")):
        if scenario.name.startswith("infeasible") or scenario.stem not in (options.only or [scenario.stem]):
            continue
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            plan = run(options.program, "plan", scenario, "--out", folder / "plan",
                       "--time", options.time)
            numbers = uncertain(scenario)
            for entry in plan["candidates"]:
                try:
                    row = driven_candidate(options, scenario, entry, folder, numbers, chance)
                except Refused as why:
                    row = f"refused: {why}"
                print(f"{scenario.stem:>16} {entry['rank']:>4} {row}", flush=True)


if __name__ == "__main__":
    main()
