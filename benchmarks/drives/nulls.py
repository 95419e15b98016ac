#!/usr/bin/env python3
"""Drives whose soils lie off their means, within their spread, and nothing else is otherwise: what a
diagnosis claims of them is false. With --zone a stretch of 30 m has another soil of the map.

    benchmarks/drives/nulls.py PROGRAM FIRST_SEED LAST_SEED [--zone]
"""
import argparse
import json
import math
import random
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NUMBERS = ("cohesion_pa", "friction_angle_deg", "kc", "kphi", "a0", "a1", "lambda", "density_kgpm3",
           "kx0_m", "kx1_m", "ky0_m", "ky1_m")
SCENARIO = f"""map:
  soils: {ROOT}/scenarios/demo/soils.yaml
  terrain: {{width_m: 400, height_m: 120, roughness_m: 0.06}}
vehicle: lrv
gravity_mps2: 1.62
start: {{x_m: 20, y_m: 60, heading_deg: 0}}
goal: {{x_m: 350, y_m: 60, radius_m: 3}}
speed_mps: {{max: 3}}
"""


def wave(chance):
    """A path of 315 m that swings from side to side, from rest."""
    amplitude_m, length_m = chance.uniform(2, 8), chance.uniform(40, 90)
    speed_mps = chance.uniform(0.8, 1.8)
    rows = ["x_m,y_m,speed_mps"]
    x_m = 20.0
    while x_m <= 335:
        y_m = 60 + amplitude_m * math.sin(2 * math.pi * (x_m - 20) / length_m)
        rows.append(f"{x_m},{y_m},{0 if x_m == 20 else speed_mps}")
        x_m += 1.5
    return "\n".join(rows) + "\n"


def truth(chance, with_zone):
    soils = {key: {"std": max(-1.5, min(1.5, chance.gauss(0, 0.7)))} for key in NUMBERS}
    told = {"soils": {"firm_regolith": soils}}
    if with_zone:
        from_m = chance.uniform(80, 250)
        soil = chance.choice(["loose_regolith", "soft_patch"])
        told["zones"] = [{"name": "zone", "like": soil,
                          "corners_m": [[from_m, 0], [from_m + 30, 0], [from_m + 30, 120],
                                        [from_m, 120]]}]
    return told


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda program: Path(program).resolve())
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--zone", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "s.yaml").write_text(SCENARIO)

        def run(*arguments):
            return subprocess.run([options.program, *map(str, arguments), "--force", "--quiet",
                                   "--json"], capture_output=True, text=True, cwd=folder)

        for seed in range(options.first, options.last + 1):
            chance = random.Random(seed)
            (folder / "p.csv").write_text(wave(chance))
            told = truth(chance, options.zone)
            (folder / "t.yaml").write_text(json.dumps(told))
            for grade in "AB":
                driven = run("drive", "s.yaml", "p.csv", "--truth", "t.yaml", "--sensors", grade,
                             "--seed", seed, "--out", "d", "--deviation-max-m", 5)
                said = run("diagnose", "d/drive.csv", "--scenario", "s.yaml", "--out", "q")
                if 1 in (driven.returncode, said.returncode):
                    raise SystemExit(driven.stderr + said.stderr)
                found = json.loads(said.stdout)
                zone = told.get("zones", [{}])[0]
                print(seed, grade, zone.get("like", "null"), zone.get("corners_m", [[None]])[0][0],
                      found["verdict"], [claim["text"] for claim in found["mechanisms"]], flush=True)


if __name__ == "__main__":
    main()
