#!/usr/bin/env python3
"""What a corrected model changes for the planner: verdicts on the demo's map that flip.

    benchmarks/diagnosis/flipped_verdicts.py corrected-model.yaml [--out DIR] [--time-s 20]

Plans across the demo's map with the base model and with the corrected one, judges every path of
either plan and a grid of manoeuvres on the map's soils under both, and prints what flips. Exit
status 0: nothing flips, 2: something does.
"""

import argparse
import itertools
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SOILS = ["firm_regolith", "loose_regolith", "soft_patch"]
MANOEUVRES = (
    [{"kind": "steady_turn", "name": f"turn of {radius} m", "radius_m": radius, "angle_deg": 90,
      "speed_mps": [1.5, 2, 2.5, 3], "soil": SOILS} for radius in (8, 10, 12, 14, 16)]
    + [{"kind": "slope_traverse", "slope_deg": [5, 10, 15, 20], "speed_mps": 1, "soil": SOILS}]
    + [{"kind": "lane_change", "name": f"lane change in {length} m", "offset_m": 2,
        "length_m": length, "speed_mps": [2, 3], "soil": SOILS} for length in (8, 12)])


def regoplan(*words):
    """Runs the program: 0 and 2 are answers."""
    run = subprocess.run([ROOT / "regoplan", *map(str, words), "--quiet"], cwd=ROOT)
    if run.returncode not in (0, 2):
        sys.exit(f"regoplan {words[0]} ended with exit status {run.returncode}")


def judged(folder, scenario, paths, manoeuvres, model):
    """name -> what the evaluation says of the path or manoeuvre"""
    regoplan("evaluate", scenario, *paths, "--manoeuvres", manoeuvres, "--draws", 2, "--out", folder,
             *model)
    result = json.loads((folder / "evaluation.json").read_text())
    return {path.get("file") or path["manoeuvre"]: path for path in result["paths"]}


def said(path):
    verdict = "feasible" if path["feasible"] else f"refused ({path['reason']})"
    margin = path["margin_min"]
    return verdict if margin is None else f"{verdict}, {margin:.3f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("model", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("flipped-verdicts"))
    parser.add_argument("--time-s", type=float, default=20, help="of each of the two searches")
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    model = ["--model", options.model.resolve()]

    regoplan("map", "make", "--seed", 1, "--out", out / "map")
    scenario = out / "map" / "scenario.yaml"
    for folder, with_model in (("plan-base", []), ("plan-corrected", model)):
        regoplan("plan", scenario, "--time", options.time_s, "--out", out / folder, *with_model)
    paths = sorted(itertools.chain(*(out.glob(f"{plan}/candidate-*.csv")
                                     for plan in ("plan-base", "plan-corrected"))))
    manoeuvres = out / "manoeuvres.yaml"
    manoeuvres.write_text(json.dumps(MANOEUVRES))
    base = judged(out / "base", scenario, paths, manoeuvres, [])
    corrected = judged(out / "corrected", scenario, paths, manoeuvres, model)

    flipped = [name for name in base if base[name]["feasible"] != corrected[name]["feasible"]]
    margins = [corrected[name]["margin_min"] - base[name]["margin_min"] for name in base
               if base[name]["margin_min"] is not None and corrected[name]["margin_min"] is not None]
    print(f"{len(paths)} paths and {len(base) - len(paths)} manoeuvres: {len(flipped)} verdicts flip; "
          f"smallest margins change by {min(margins):+.3f} to {max(margins):+.3f}")
    if flipped:
        print("\n| path or manoeuvre | base model | corrected model |\n|---|---|---|")
    for name in flipped:
        title = name.removeprefix(f"{out}/")
        print(f"| {title} | {said(base[name])} | {said(corrected[name])} |")
    sys.exit(2 if flipped else 0)


if __name__ == "__main__":
    main()
