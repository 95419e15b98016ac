#!/usr/bin/env python3
"""Drives whose soils lie off their means, within their spread, and nothing else is otherwise: what a
diagnosis claims of them is false. With --zone a stretch has another soil of the map, with --drag a
wheel drags, with --steering the front pair is steered 2 deg off.

    benchmarks/drives/nulls.py PROGRAM FIRST_SEED LAST_SEED [--vehicle lrv|tohoku|curiosity]
        [--zone] [--drag] [--steering] [--grades AB] [--jobs N]

A line a drive: seed, sensors, what is otherwise, verdict, what is claimed, and the seconds of wall
and of processor that the diagnosis took.
"""
import argparse
import functools
import json
import math
import random
import resource
import shutil
import subprocess
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NUMBERS = ("cohesion_pa", "friction_angle_deg", "kc", "kphi", "a0", "a1", "lambda", "density_kgpm3",
           "kx0_m", "kx1_m", "ky0_m", "ky1_m")
SCENARIO = """map:
  soils: {root}/scenarios/demo/soils.yaml
  terrain: {{width_m: 400, height_m: 120, roughness_m: 0.06}}
vehicle: {vehicle}
gravity_mps2: {gravity_mps2}
start: {{x_m: 20, y_m: 60, heading_deg: 0}}
goal: {{x_m: {goal_x_m}, y_m: 60, radius_m: 3}}
speed_mps: {{max: {speed_max_mps}}}
"""


@dataclass
class Driven:
    """How a preset vehicle is driven: a slow one a third as far, in windows of a metre."""
    gravity_mps2: float
    weight_radius_nm: float  # weight times radius of the wheels
    end_x_m: float
    speeds_mps: tuple
    speed_max_mps: float
    zone_from_m: tuple
    zone_m: float


VEHICLES = {
    "lrv": Driven(1.62, 700 * 1.62 * 0.409, 335, (0.8, 1.8), 3, (80, 250), 30),
    "tohoku": Driven(9.81, 26.4 * 9.81 * 0.09, 130, (0.04, 0.05), 0.05, (40, 95), 17),
    "curiosity": Driven(3.71, 899 * 3.71 * 0.25, 130, (0.03, 0.04), 0.04, (40, 95), 17),
}


def scenario(vehicle="lrv"):
    driven = VEHICLES[vehicle]
    return SCENARIO.format(root=ROOT, vehicle=vehicle, gravity_mps2=driven.gravity_mps2,
                           goal_x_m=driven.end_x_m + 15, speed_max_mps=driven.speed_max_mps)


def wave(chance, driven=VEHICLES["lrv"]):
    """A path that swings from side to side, from rest."""
    amplitude_m, length_m = chance.uniform(2, 8), chance.uniform(40, 90)
    speed_mps = chance.uniform(*driven.speeds_mps)
    rows = ["x_m,y_m,speed_mps"]
    x_m = 20.0
    while x_m <= driven.end_x_m:
        y_m = 60 + amplitude_m * math.sin(2 * math.pi * (x_m - 20) / length_m)
        rows.append(f"{x_m},{y_m},{0 if x_m == 20 else speed_mps}")
        x_m += 1.5
    return "\n".join(rows) + "\n"


def truth(chance, driven, options):
    """What is otherwise than map and vehicle say, as `drive --truth` reads it."""
    soils = {key: {"std": max(-1.5, min(1.5, chance.gauss(0, 0.7)))} for key in NUMBERS}
    told = {"soils": {"firm_regolith": soils}}
    wheels = {}
    if options.zone:
        from_m = chance.uniform(*driven.zone_from_m)
        to_m = from_m + driven.zone_m
        soil = chance.choice(["loose_regolith", "soft_patch"])
        told["zones"] = [{"name": "zone", "like": soil,
                          "corners_m": [[from_m, 0], [to_m, 0], [to_m, 120], [from_m, 120]]}]
    if options.drag:
        wheel = chance.choice(["front_left", "front_right", "rear_left", "rear_right"])
        wheels[wheel] = {"drag_nm": chance.uniform(0.01, 0.02) * driven.weight_radius_nm}
    if options.steering:
        for wheel in ("front_left", "front_right"):
            wheels.setdefault(wheel, {})["steer_offset_deg"] = 2
    if wheels:
        told["vehicle"] = {"wheels": wheels}
    return told


def named(told):
    """What is otherwise, in short."""
    words = []
    for zone in told.get("zones", []):
        words.append(f"{zone['like']} from x = {zone['corners_m'][0][0]:.1f} m")
    for wheel, faults in told.get("vehicle", {}).get("wheels", {}).items():
        words += [f"{wheel} {fault} {size:.3g}" for fault, size in faults.items()]
    return ", ".join(words) or "null"


def processor_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def diagnosed(options, seed):
    """The lines of one seed's drives."""
    driven = VEHICLES[options.vehicle]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def run(*arguments):
            return subprocess.run([options.program, *map(str, arguments), "--force", "--quiet",
                                   "--json"], capture_output=True, text=True, cwd=folder)

        chance = random.Random(seed)
        (folder / "s.yaml").write_text(scenario(options.vehicle))
        (folder / "p.csv").write_text(wave(chance, driven))
        told = truth(chance, driven, options)
        (folder / "t.yaml").write_text(json.dumps(told))
        lines = []
        for grade in options.grades:
            way = run("drive", "s.yaml", "p.csv", "--truth", "t.yaml", "--sensors", grade,
                      "--seed", seed, "--out", "d", "--deviation-max-m", 5)
            began_s, before_s = time.monotonic(), processor_s()
            said = run("diagnose", "d/drive.csv", "--scenario", "s.yaml", "--out", "q")
            wall_s, took_s = time.monotonic() - began_s, processor_s() - before_s
            if 1 in (way.returncode, said.returncode):
                raise SystemExit(way.stderr + said.stderr)
            if options.keep:
                kept = options.keep / f"{options.vehicle}-{seed}-{grade}"
                kept.mkdir(parents=True, exist_ok=True)
                for file in ("s.yaml", "t.yaml", "d/drive.csv", "d/truth.json"):
                    shutil.copy(folder / file, kept)
            found = json.loads(said.stdout)
            lines.append(f"{seed} {grade} {named(told)}: {found['verdict']} "
                         f"{[claim['text'] for claim in found['mechanisms']]} "
                         f"{wall_s:.1f} s, {took_s:.1f} s")
        return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda program: Path(program).resolve())
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--vehicle", choices=VEHICLES, default="lrv")
    parser.add_argument("--zone", action="store_true")
    parser.add_argument("--drag", action="store_true")
    parser.add_argument("--steering", action="store_true")
    parser.add_argument("--grades", default="AB")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", type=Path, help="folder that drives are kept in")
    options = parser.parse_args()
    with ProcessPoolExecutor(options.jobs) as workers:
        seeds = range(options.first, options.last + 1)
        for lines in workers.map(functools.partial(diagnosed, options), seeds):
            print("\n".join(lines), flush=True)


if __name__ == "__main__":
    main()
