#!/usr/bin/env python3
"""Draws recordings by a second generator that shares nothing with the program, diagnoses them, and
counts.

    campaign.py PROGRAM FOLDER SEED [--jobs 2] [--share 1]

Truths go to FOLDER/sealed before anything is diagnosed and are opened when all of it has ended.
Results that are there already are kept, so that a campaign goes on where it was killed.
"""
import argparse
import collections
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys

from recordings import draw_recording, write

COUNTS = {"nulls": 60, "one_effect": 40, "two_effects": 20, "instruments": 20, "unlisted": 14,
          "drift": 8}
SURE = 0.9


def wilson(right, of):
    """The interval at 95 %, in per cent."""
    if of == 0:
        return "-"
    z, share = 1.96, right / of
    middle, half = share + z * z / (2 * of), z * math.sqrt(share * (1 - share) / of
                                                            + z * z / (4 * of * of))
    low, high = ((middle + sign * half) / (1 + z * z / of) for sign in (-1, 1))
    return f"{100 * max(0, low):.0f}-{100 * high:.0f}"


def draw(arguments, stratum, index):
    name = f"{stratum}-{index:03d}"
    folder, truth = arguments.folder / name, arguments.folder / "sealed" / f"{name}.json"
    if truth.exists():
        return name
    drawn = draw_recording([arguments.seed, *map(ord, stratum), index], stratum)
    if drawn is None:
        print(f"{name}: no draw of 200 could be used", file=sys.stderr)
        return None
    write(*drawn, stratum, folder, truth)
    return name


def diagnosis_of(program, folder, recording, *options):
    """What the program says of a recording in a folder; kept there, and said again."""
    result = folder / "result" / "diagnosis.json"
    if not result.exists():
        run = subprocess.run(
            [program, "diagnose", folder / recording, *options, "--setup", folder / "setup.yaml",
             "--threads", "1", "--quiet", "--out", folder / "result"],
            capture_output=True, text=True, check=False)
        if run.returncode not in (0, 2):
            return {"verdict": f"failed: {run.stderr.strip()[:200]}", "mechanisms": [],
                    "ranking": []}
    return json.loads(result.read_text(encoding="utf-8"))


def diagnose(arguments, name):
    return name, diagnosis_of(arguments.program, arguments.folder / name, "recording.csv")


def judged(truth, said):
    """Whether a diagnosis is right, and whether by the names alone."""
    classes = [{claim["id"], *claim["equivalent"]} for claim in said["mechanisms"]]
    if truth["stratum"] == "nulls":
        return [said["verdict"] in ("consistent", "parameters")] * 2
    if truth["stratum"] == "unlisted":
        return [said["verdict"] == "unexplained" and not classes] * 2
    accepted = [set(names) for names in truth["accepted"]]
    right = (bool(classes) and all(any(names & one for one in classes) for names in accepted)
             and all(any(names & one for names in accepted) for one in classes))
    return right, right and all(len(one) == 1 for one in classes)


def sure_claims(truth, said):
    """How many claims are surer than 90 %, and how many of those hold a true name."""
    true = {name for names in truth["accepted"] for name in names}
    if truth["stratum"] in ("nulls", "unlisted"):
        true = set()
    sure = [{claim["id"], *claim["equivalent"]} for claim in said["mechanisms"]
            if claim["probability"] > SURE]
    return len(sure), sum(bool(one & true) for one in sure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("seed", type=int)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--share", type=float, default=1, help="of the usual number of cases")
    arguments = parser.parse_args()

    cases = [(stratum, index) for stratum, count in COUNTS.items()
             for index in range(max(1, round(arguments.share * count)))]
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        names = [name for name in pool.map(draw, [arguments] * len(cases), *zip(*cases)) if name]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = dict(pool.map(lambda name: diagnose(arguments, name), names))

    right, exact, of, claims = (collections.Counter() for _ in range(4))
    for name, said in results.items():
        truth = json.loads((arguments.folder / "sealed" / f"{name}.json").read_text("utf-8"))
        stratum = truth["stratum"]
        is_right, is_exact = judged(truth, said)
        of[stratum] += 1
        right[stratum] += is_right
        exact[stratum] += is_exact
        sure, true = sure_claims(truth, said)
        claims["sure"] += sure
        claims["true"] += true
        if not is_right:
            told = [" or ".join([claim["id"], *claim["equivalent"]]) for claim in said["mechanisms"]]
            print(f"{name}: {' and '.join(truth['ids']) or 'nothing'}, {truth['signal']:.1f} sigma: "
                  f"{said['verdict']} {'; '.join(told)}")
    for stratum, count in of.items():
        print(f"{stratum}: right {right[stratum]} of {count} ({wilson(right[stratum], count)} %), "
              f"exact {exact[stratum]}")
    print(f"claims above {SURE:g}: right {claims['true']} of {claims['sure']}")


if __name__ == "__main__":
    main()
