#!/usr/bin/env python3
"""Kills every command at random moments (SIGKILL, the whole process group) and looks at what is left:
each file that can be seen is whole, the next run takes over without --force, and when one has come
to its end no hidden folder is left.

    benchmarks/robustness/kill_campaign.py [--program FILE] [--kills N] [--seed N] [COMMAND...]
"""
import argparse
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

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


def commands(folder):
    out = folder / "out"
    recording = ROOT / "scenarios/diagnosis/recording.csv"
    return {
        "map make": ["map", "make", "--width-m", "100", "--height-m", "100", "--out", out],
        "map import": ["map", "import", "--elevation", folder / "dem.asc", "--soils",
                       folder / "soils.yaml", "--gravity-mps2", "1.62", "--out", out],
        "wheel": ["wheel", folder / "c.csv", "--model", folder / "m.yaml", "--out", out / "o.csv"],
        "wheel figures": ["wheel", "--figures", out],
        "evaluate": ["evaluate", folder / "s.yaml", folder / "p.csv", "--draws", "20", "--out", out],
        "chart": ["evaluate", folder / "s.yaml", "--chart", out, "--chart-slopes-deg", "0"],
        "plan": ["plan", folder / "s.yaml", "--out", out],
        "benchmark": ["benchmark", folder / "suite.yaml", "--out", out],
        "diagnose": ["diagnose", recording, "--setup", ROOT / "scenarios/diagnosis/setup.yaml",
                     "--out", out],
    }


def digest(content):
    value = 14695981039346656037
    for byte in content:
        value = ((value ^ byte) * 1099511628211) & 0xFFFFFFFFFFFFFFFF
    return f"{value:016x}"


def unwhole_files(out):
    """Names of the visible files that are not as the manifest knows them."""
    if not out.is_dir():
        return []
    manifest = out / ".regoplan-files"
    known = set()
    if manifest.exists():
        known = {tuple(line.split("  ", 1)) for line in manifest.read_text().splitlines()}
    wrong = []
    for file in out.iterdir():
        # The journal of a benchmark grows by whole lines while it runs.
        if file.name.startswith(".") or file.is_dir() or file.name == "runs.jsonl":
            continue
        if (digest(file.read_bytes()), file.name) not in known:
            wrong.append(file.name)
    return wrong


def run(program, arguments, kill_after_s=None):
    process = subprocess.Popen([program, *map(str, arguments), "--quiet"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, start_new_session=True)
    try:
        _, errors = process.communicate(timeout=kill_after_s)
        return process.returncode, errors.decode()
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def campaign(program, name, folder, kills, chance):
    arguments = commands(folder)[name]
    out = folder / "out"
    if name == "wheel":
        out.mkdir()
    begun = time.monotonic()
    status, errors = run(program, arguments)
    whole_s = time.monotonic() - begun
    findings = [] if status in (0, 2) else [f"the first run ends with {status}: {errors}"]
    killed = 0
    while killed < kills and not findings:
        if name == "benchmark":  # else nothing would be left to run
            subprocess.run(["rm", "-rf", out], check=True)
        status, errors = run(program, arguments, chance.uniform(0, whole_s))
        if status is None:
            killed += 1
        elif status not in (0, 2):
            findings.append(f"after {killed} kills: status {status}: {errors}")
        findings += [f"{file} is not whole" for file in unwhole_files(out)]
    status, errors = run(program, arguments)
    if status not in (0, 2):
        findings.append(f"the last run ends with {status}: {errors}")
    findings += [f"{left.name} is left" for left in out.glob(".*") if left.name != ".regoplan-files"]
    findings += [f"{file} is not whole" for file in unwhole_files(out)]
    for file in out.glob("*.json"):
        json.loads(file.read_text())
    print(f"{name:14} {killed:4} kills, a run takes {whole_s:.1f} s, {len(findings)} findings", flush=True)
    for finding in findings:
        print(f"{name:14} {finding}", flush=True)
    return len(findings)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/release/regoplan"))
    parser.add_argument("--kills", type=int, default=200, help="of each command")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("command", nargs="*", help="default: all")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    findings = 0
    for name in commands(pathlib.Path()):
        if options.command and name not in options.command:
            continue
        with tempfile.TemporaryDirectory(prefix="regoplan-kills-") as folder:
            write_inputs(pathlib.Path(folder))
            findings += campaign(options.program, name, pathlib.Path(folder), options.kills, chance)
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
