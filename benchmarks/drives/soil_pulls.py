#!/usr/bin/env python3
"""How surely a diagnosis tells the soils of a map that a drive went over, against those that lie there.

Paths of 315 m over bands of three soils, each number off its mean by as much as the map says that it
may be, on ground whose heights err from the map's (independent simulator); in every other world (odd
seeds) a stretch of 30 m hides a far weaker soil. A pull is what is told less the truth, in deviations
that are told: of honest ones the root mean square is 1 and 95 % lie within 1.96. Of the soils that
are handed back some are further from the truth than the map's, by luck: how many of honest ones, is
drawn. Folder and command may be given again: what is there already is not made anew.

    benchmarks/drives/soil_pulls.py build/release FOLDER FIRST_SEED LAST_SEED [--grades AB]
        [--program PROGRAM] [--told said] [--threads 1]
"""
import argparse
import json
import math
import random
import statistics
import subprocess
from pathlib import Path

from concealed import at_speed, cratered
from nulls import NUMBERS, ROOT, wave

SOILS = ("firm_regolith", "loose_regolith", "soft_patch")
BANDS = ", ".join(f"{{code: {code}, west_m: {west}, east_m: {east}, south_m: 0, north_m: 120}}"
                  for code, west, east in ((2, 130, 230), (3, 230, 400)))
WITHIN_95 = 1.96


def banded(scenario):
    level = "roughness_m: 0.06"
    assert level in scenario
    return scenario.replace(level, f"{level}, zones: [{BANDS}]")


def hidden(chance):
    from_m = chance.uniform(60, 280)
    soil = {"friction_angle_deg": chance.uniform(20, 26), "cohesion_pa": chance.uniform(50, 150),
            "kc": 100, "kphi": math.exp(chance.uniform(math.log(2e4), math.log(8e4)))}
    return [{"name": "hidden", "like": "soft_patch", "soil": soil,
             "corners_m": [[from_m, 0], [from_m + 30, 0], [from_m + 30, 120], [from_m, 120]]}]


class Drive:
    """A world, what is driven in it, and what is told of its soils."""

    def __init__(self, folder, seed, grade):
        self.folder, self.seed, self.grade = folder / f"{seed}-{grade}", seed, grade

    def conceal(self):
        chance = random.Random(f"soils {self.seed}")
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "path.csv").write_text(at_speed(wave(chance)))
        (self.folder / "scenario.yaml").write_text(banded(cratered(chance)))
        told = {"soils": {soil: {key: {"std": max(-2.5, min(2.5, chance.gauss(0, 1)))}
                                 for key in NUMBERS} for soil in SOILS}}
        if self.seed % 2:
            told["zones"] = hidden(chance)
        (self.folder / "truth.json").write_text(json.dumps(told, indent=1))

    def run(self, result, *command):
        if (self.folder / result).exists():
            return
        done = subprocess.run([*map(str, command)], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        if not (self.folder / result).exists():
            print(f"{self.folder.name}: {done.stdout.strip()} {done.stderr.strip()}", flush=True)

    def make(self, build, program, said, threads):
        self.conceal()
        self.run("drive.csv", build / "benchmarks/drives/independent_drive", "scenario.yaml",
                 "path.csv", "--truth", "truth.json", "--sensors",
                 ROOT / f"scenarios/drive/sensors_{self.grade.lower()}.yaml", "--seed", self.seed,
                 "--roughness-m", 0.01, "--out", "drive.csv")
        self.run(f"{said}/diagnosis.json", program, "diagnose", "drive.csv", "--scenario",
                 "scenario.yaml", "--threads", threads, "--out", said, "--quiet", "--force")

    def pulls(self, said):
        """(soil, number, pull, pull of the map's number, deviation left of 1, whether it is handed
        back) of each soil that is told."""
        truth = json.loads((self.folder / "truth.json").read_text())["soils"]
        file = self.folder / said / "diagnosis.json"
        if not file.exists():
            return
        for soil, numbers in json.loads(file.read_text()).get("soils", {}).items():
            handed_back = "withheld" not in numbers
            for key, off in truth[soil].items():
                known, told = numbers["map"][key], numbers["drives"][key]
                there = known["mean"] + off["std"] * known["std"]
                yield (soil, key, (told["mean"] - there) / told["std"], -off["std"],
                       told["std"] / known["std"], handed_back)


def row(name, pulls):
    if not pulls:
        return
    values = [pull[2] for pull in pulls]
    known = [pull[3] for pull in pulls]
    rms = math.sqrt(statistics.fmean(p * p for p in values))
    within = statistics.fmean(abs(p) <= WITHIN_95 for p in values)
    # Nats by which what is told makes the truth likelier than the map's own numbers do.
    nats = statistics.fmean((q * q - p * p) / 2 - math.log(left)
                            for p, q, left in zip(values, known, (pull[4] for pull in pulls)))
    off = math.sqrt(statistics.fmean((p * left) ** 2 for p, left in
                                     zip(values, (pull[4] for pull in pulls))))
    prior = math.sqrt(statistics.fmean(q * q for q in known))
    left = statistics.median(pull[4] for pull in pulls)
    print(f"| {name} | {len(values)} | {statistics.fmean(values):+.2f} | {rms:.2f} | {within:.2f} | "
          f"{max(map(abs, values)):.1f} | {left:.2f} | {off:.2f} ({prior:.2f}) | {nats:+.2f} |")


def further_by_luck(left, chance):
    """Whether a soil told as honestly as it is said to be comes out further off than the map's."""
    told = known = 0
    for std in (min(1, std) for std in left):
        there = chance.gauss(0, 1)
        mean = (1 - std * std) * there + std * math.sqrt(1 - std * std) * chance.gauss(0, 1)
        told += (mean - there) ** 2
        known += there ** 2
    return told > known


def soils_row(drives, said):
    """How many soils are told further from the truth than the map's, and what becomes of them."""
    draws, chance = 200, random.Random("luck")
    told, further, by_luck, withheld, withheld_further = 0, 0, 0.0, 0, 0
    for drive in drives:
        pulls = list(drive.pulls(said))
        for soil in SOILS:
            of = [pull for pull in pulls if pull[0] == soil]
            if not of:
                continue
            told += 1
            is_further = sum((p * left) ** 2 - q * q for _, _, p, q, left, _ in of) > 0
            further += is_further
            by_luck += statistics.fmean(further_by_luck([pull[4] for pull in of], chance)
                                        for _ in range(draws))
            if not of[0][5]:
                withheld += 1
                withheld_further += is_further
    print(f"soils told {told}, further from the truth than the map's {further} (of honest ones "
          f"{by_luck:.1f}); withheld {withheld}, of these further {withheld_further}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda text: Path(text).resolve())
    parser.add_argument("folder", type=lambda text: Path(text).resolve())
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--grades", default="A")
    parser.add_argument("--program", type=lambda text: Path(text).resolve())
    parser.add_argument("--told", default="said")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    drives = [Drive(options.folder, seed, grade)
              for seed in range(options.first, options.last + 1) for grade in options.grades]
    for drive in drives:
        drive.make(options.build, options.program or options.build / "regoplan", options.told,
                   options.threads)
    told = [pull for drive in drives for pull in drive.pulls(options.told)]
    print("| number | told | mean pull | rms | within 1.96 | most | deviation left | off, in the map's "
          "deviations (as mapped) | nats over the map |\n|---|---|---|---|---|---|---|---|---|")
    for key in NUMBERS:
        row(key, [pull for pull in told if pull[1] == key])
    for soil in SOILS:
        row(soil, [pull for pull in told if pull[0] == soil])
    for name, of in (("without a zone", 0), ("with a zone", 1)):
        row(name, [pull for drive in drives if drive.seed % 2 == of
                   for pull in drive.pulls(options.told)])
    row("all", told)
    soils_row(drives, options.told)


if __name__ == "__main__":
    main()
