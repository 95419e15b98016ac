"""What the campaigns of kills and interrupts share: small input for every command, and their rows."""
import argparse
import math
import pathlib
import random
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

SCENARIO = """map:
  terrain: {width_m: 40, height_m: 40, cell_m: 1}
  soils: {soils: {mare: {source: assumed, cohesion_pa: 170, friction_angle_deg: 35, kc: 1400, kphi: 820000,
    n: 1, a0: 0.4, a1: 0.15, lambda: 0.9, density_kgpm3: 1500, kx0_m: 0.018, ky0_m: 0.013}}, classes: {1: mare}}
vehicle: lrv
gravity_mps2: 1.62
start: {x_m: 10, y_m: 20, heading_deg: 0}
goal: {x_m: 30, y_m: 20, radius_m: 3}
planner: {name: RRT, iterations: 300, candidates: 1, improve: false}
"""


def write_inputs(folder):
    (folder / "s.yaml").write_text(SCENARIO)
    (folder / "p.csv").write_text("x_m,y_m\n10,20\n20,20\n28,21\n")
    (folder / "suite.yaml").write_text(
        "name: kills\nscenarios: [s.yaml]\nplanners: [RRT]\nseeds: 3\niterations: 200\ntime_s: 5\nsoil_draws: 5\n")
    rows = "".join(f"{60 + i % 7},{i % 10 / 12},{i % 17}\n" for i in range(3000))
    (folder / "c.csv").write_text("load_n,slip_ratio,slip_angle_deg\n" + rows)
    # As in tests: a planar grid that says where it lies.
    heights = "\n".join(" ".join("1" for _ in range(60)) for _ in range(60))
    (folder / "dem.asc").write_text(
        "ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + heights + "\n")
    (folder / "soils.yaml").write_text(
        re.search(r"soils: (\{soils.*\}\}, classes: \{1: mare\}\})", SCENARIO, re.S).group(1) + "\n")
    model = (ROOT / "scenarios/diagnosis/setup.yaml").read_text()
    (folder / "m.yaml").write_text(model)
    lines = (ROOT / "scenarios/diagnosis/recording.csv").read_text().splitlines(True)
    (folder / "r.csv").write_text("".join(lines[:40]))
    (folder / "d.csv").write_text("time_s,x_m,y_m,yaw_deg,pitch_deg\n" + "".join(
        f"{i / 10},{20 + 8 * math.cos(i / 100)},{20 + 8 * math.sin(i / 100)},"
        f"{math.degrees(i / 100) + 90},{i % 3 / 10}\n" for i in range(3000)))


def run_campaigns(description, times_option, times, heading, commands, campaign):
    """Runs each command that is asked for in a folder of its own and prints a row for it.

    commands: makes what is run by name, from the folder of the input
    campaign: (program, what is run, folder, times, chance) to the row's cells and its findings
    """
    parser = argparse.ArgumentParser(description=description.split("\n\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/release/regoplan"))
    parser.add_argument(times_option, dest="times", type=int, default=times, help="of each command")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("command", nargs="*", help="default: all")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    found = 0
    print(f"| command | {heading} | findings |\n|" + "---|" * (heading.count("|") + 3), flush=True)
    for name in commands(pathlib.Path()):
        if options.command and name not in options.command:
            continue
        with tempfile.TemporaryDirectory(prefix="regoplan-campaign-") as scratch:
            folder = pathlib.Path(scratch)
            write_inputs(folder)
            cells, findings = campaign(options.program, commands(folder)[name], folder, options.times,
                                       chance)
        print(f"| {name} | {cells} | {len(findings)} |", flush=True)
        for finding in findings:
            print(f"  {name}: {finding}", flush=True)
        found += len(findings)
    sys.exit(1 if found else 0)
