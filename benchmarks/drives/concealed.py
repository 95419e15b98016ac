#!/usr/bin/env python3
"""Effects concealed in the independent simulator, and what the diagnosis calls them.

Draws truths by seed, seals them (their digests are noted, nobody may read or write them), drives
300 m with each, diagnoses every recording, and only then opens the truths and scores. Folder and
command may be given again: what is there already is not made anew.

    benchmarks/drives/concealed.py build/release FOLDER FIRST_SEED LAST_SEED [--effects zone,cg]
        [--grades AB] [--roughness-m 0.01]
"""
import argparse
import hashlib
import json
import math
import random
import subprocess
from pathlib import Path

from concealed_scores import score, table
from nulls import NUMBERS, ROOT, scenario, wave

SOIL = "firm_regolith"


def either_sign(chance, low, high):
    return chance.choice([-1, 1]) * chance.uniform(low, high)


def zone(chance):
    from_m = chance.uniform(80, 250)
    return {"zones": [{"name": "zone", "like": chance.choice(["loose_regolith", "soft_patch"]),
                       "corners_m": [[from_m, 0], [from_m + 30, 0], [from_m + 30, 120],
                                     [from_m, 120]]}]}


def of_wheels(wheels, fault):
    return {"vehicle": {"wheels": {wheel: fault for wheel in wheels}}}


WHEELS = ("front_left", "front_right", "rear_left", "rear_right")


def centre(chance):
    way = chance.choice(["forward", "left", "up"])
    off_m = chance.uniform(0.2, 0.3) if way == "up" else either_sign(chance, 0.1, 0.15)
    return {"vehicle": {f"cg_{way}_m": off_m}}


def map_shift(chance):
    towards = chance.uniform(0, 2 * math.pi)
    return {"map": {"east_m": 2 * math.cos(towards), "north_m": 2 * math.sin(towards)}}


# Sizes are those of one wheel, of the front pair, ...: as small as the diagnosis promises to see.
EFFECTS = {
    "none": lambda chance: {},
    "soil_zone": zone,
    "wheel_drag": lambda chance: of_wheels([chance.choice(WHEELS)],
                                           {"drag_nm": chance.uniform(5, 8)}),
    "steering_offset": lambda chance: of_wheels(WHEELS[:2],
                                                {"steer_offset_deg": either_sign(chance, 1, 1.5)}),
    "cg_offset": centre,
    "map_offset": map_shift,
    "motor_constant": lambda chance: of_wheels(
        WHEELS, {"motor_constant_factor": 1 + either_sign(chance, 0.1, 0.15)}),
    "payload": lambda chance: {"vehicle": {"payload_kg": chance.uniform(70, 105)}},
}


def cratered(chance):
    """The scenario on ground of worn craters, with slopes of about 7 deg: on level ground neither a
    map's offset nor a payload shows."""
    craters = [{"x_m": chance.uniform(0, 400), "y_m": chance.uniform(20, 100),
                "diameter_m": diameter_m, "depth_m": 0.03 * diameter_m,
                "rim_height_m": 0.005 * diameter_m}
               for diameter_m in (chance.uniform(20, 60) for _ in range(16))]
    level = "roughness_m: 0.06"
    assert level in scenario()
    return scenario().replace(level, f"{level}, craters: {json.dumps(craters)}")


def at_speed(path):
    """The path from full speed: the simulator's wheels roll."""
    rows = path.splitlines()
    place, speed = rows[1].rsplit(",", 1)[0], rows[2].rsplit(",", 1)[1]
    return "\n".join([rows[0], f"{place},{speed}", *rows[2:]]) + "\n"


class Drive:
    """A recording of one truth at one grade, in its folder."""

    def __init__(self, folder, effect, seed, grade):
        self.effect, self.seed, self.grade = effect, seed, grade
        self.folder = folder / f"{effect}-{seed}-{grade}"
        self.truth = folder / "truths" / f"{effect}-{seed}.json"
        self.diagnosis = self.folder / "diagnosis" / "diagnosis.json"

    def conceal(self):
        chance = random.Random(f"{self.effect} {self.seed}")
        self.folder.mkdir(parents=True, exist_ok=True)
        self.truth.parent.mkdir(exist_ok=True)
        (self.folder / "path.csv").write_text(at_speed(wave(chance)))
        (self.folder / "scenario.yaml").write_text(cratered(chance))
        soil = {key: {"std": max(-1.5, min(1.5, chance.gauss(0, 0.7)))} for key in NUMBERS}
        told = {"soils": {SOIL: soil}, **EFFECTS[self.effect](chance)}
        if not self.truth.exists():
            self.truth.write_text(json.dumps(told, indent=1))
            self.truth.chmod(0o400)
        return hashlib.sha256(self.truth.read_bytes()).hexdigest()

    def drive(self, build, roughness_m):
        if (self.folder / "drive.csv").exists():
            return
        done = subprocess.run(
            [build / "benchmarks/drives/independent_drive", "scenario.yaml", "path.csv",
             "--truth", self.truth, "--sensors",
             ROOT / f"scenarios/drive/sensors_{self.grade.lower()}.yaml",
             "--seed", str(self.seed), "--roughness-m", str(roughness_m), "--out", "drive.csv"],
            cwd=self.folder, capture_output=True, text=True, check=False)
        if done.returncode == 1:
            raise SystemExit(done.stderr)
        if done.returncode == 2:
            print(f"{self.folder.name}: {done.stdout.strip()}", flush=True)

    def diagnose(self, build):
        if self.diagnosis.exists():
            return
        said = subprocess.run(
            [build / "regoplan", "diagnose", "drive.csv", "--scenario", "scenario.yaml", "--out",
             "diagnosis", "--quiet", "--force"],
            cwd=self.folder, capture_output=True, text=True, check=False)
        if not self.diagnosis.exists():
            raise SystemExit(f"{self.folder.name}: {said.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda text: Path(text).resolve())
    parser.add_argument("folder", type=lambda text: Path(text).resolve())
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--effects", default=",".join(EFFECTS))
    parser.add_argument("--grades", default="AB")
    parser.add_argument("--roughness-m", type=float, default=0.01)
    options = parser.parse_args()
    drives = [Drive(options.folder, effect, seed, grade)
              for seed in range(options.first, options.last + 1)
              for effect in options.effects.split(",") for grade in options.grades]
    sealed = [drive.conceal() for drive in drives]
    for drive in drives:
        drive.drive(options.build, options.roughness_m)
    for drive in drives:
        drive.diagnose(options.build)
    for drive, digest in zip(drives, sealed):
        if hashlib.sha256(drive.truth.read_bytes()).hexdigest() != digest:
            raise SystemExit(f"{drive.truth}: not as it was sealed")
    scored = [(drive, score(drive)) for drive in drives]
    for drive, result in scored:
        if not result["right"] and drive.effect != "none" or result["wrong"]:
            print(drive.folder.name, json.loads(drive.truth.read_text()) | {"soils": 0},
                  [f"{c['id']} of {c['equivalent']}: {c['text']}" for c in result["claims"]])
    table(scored)


if __name__ == "__main__":
    main()
