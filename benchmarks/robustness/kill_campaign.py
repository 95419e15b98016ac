#!/usr/bin/env python3
"""Kills every command at random moments (SIGKILL, the whole process group) and looks at what is left:
each file that can be seen is whole, the next run takes over without --force, and when one has come
to its end no hidden folder is left, nor a half-written table in the cache. Every other kill comes
while files are written: after the hidden folder is there, within the time that this stage takes.

    benchmarks/robustness/kill_campaign.py [--program FILE] [--kills N] [--seed N] [COMMAND...]
"""
import argparse
import json
import math
import os
import pathlib
import random
import re
import shutil
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
    lines = (ROOT / "scenarios/diagnosis/recording.csv").read_text().splitlines(True)
    (folder / "r.csv").write_text("".join(lines[:40]))
    (folder / "d.csv").write_text("time_s,x_m,y_m,yaw_deg,pitch_deg\n" + "".join(
        f"{i / 10},{20 + 8 * math.cos(i / 100)},{20 + 8 * math.sin(i / 100)},"
        f"{math.degrees(i / 100) + 90},{i % 3 / 10}\n" for i in range(3000)))


def commands(folder):
    out = folder / "out"
    setup = ROOT / "scenarios/diagnosis/setup.yaml"
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
        "merge": ["benchmark", "merge", folder / "part-1", folder / "part-2", "--out", out],
        "diagnose": ["diagnose", folder / "r.csv", "--setup", setup, "--out", out],
        "reference": ["diagnose", folder / "r.csv", "--reference", folder / "r.csv", "--setup", setup,
                      "--out", out],
        "drive": ["diagnose", folder / "d.csv", "--scenario", folder / "s.yaml", "--out", out],
        "demo": ["demo", "--iterations", "200", "--out", out],
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


def staging(out):
    """When the hidden folder was made that files are written to first; 0 where there is none."""
    try:
        return max((entry.stat().st_ctime for entry in os.scandir(out)
                    if entry.name.startswith(".regoplan-") and entry.is_dir()), default=0)
    except FileNotFoundError:
        return 0


def start(program, arguments, folder):
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}
    return subprocess.Popen([program, *map(str, arguments), "--quiet"], stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, start_new_session=True, env=environment)


def watch(process, out):
    """Waits for the process to write files. \returns whether it does before it ends"""
    before = staging(out)
    while process.poll() is None:
        if staging(out) > before:
            return True
        time.sleep(0.0005)
    return False


def run(program, arguments, folder, kill_after_s=None, while_writing=False):
    process = start(program, arguments, folder)
    try:
        if while_writing:
            watch(process, folder / "out")
        _, errors = process.communicate(timeout=kill_after_s)
        return process.returncode, errors.decode()
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""


def whole_run(program, arguments, folder):
    """\returns status, errors, how long it took and how long of that files were written"""
    begun = time.monotonic()
    process = start(program, arguments, folder)
    writing = time.monotonic() if watch(process, folder / "out") else None
    _, errors = process.communicate()
    ended = time.monotonic()
    return process.returncode, errors.decode(), ended - begun, ended - (writing or ended)


def left_in(folder):
    left = [path.name for path in (folder / "out").glob(".*") if path.name != ".regoplan-files"]
    return left + [path.name for path in (folder / "cache").glob("*/*.force-table.*")]


def campaign(program, name, folder, kills, chance):
    arguments = commands(folder)[name]
    out = folder / "out"
    if name == "wheel":
        out.mkdir()
    if name == "merge":
        for part in ("1", "2"):
            run(program, ["benchmark", folder / "suite.yaml", "--shard", f"{part}/2", "--out",
                          folder / f"part-{part}"], folder)
    status, errors, whole_s, writing_s = whole_run(program, arguments, folder)
    findings = [] if status in (0, 2) else [f"the first run ends with {status}: {errors}"]
    killed = written = 0
    while killed < kills and not findings:
        if name == "benchmark":  # else nothing would be left to run
            shutil.rmtree(out, ignore_errors=True)
        if chance.random() < 0.3:  # tables are written anew
            shutil.rmtree(folder / "cache", ignore_errors=True)
        while_writing = killed % 2 == 1
        status, errors = run(program, arguments, folder,
                             chance.uniform(0, writing_s if while_writing else whole_s),
                             while_writing)
        if status is None:
            killed += 1
            written += while_writing
        elif status not in (0, 2):
            findings.append(f"after {killed} kills: status {status}: {errors}")
        findings += [f"{file} is not whole" for file in unwhole_files(out)]
    for table in (folder / "cache").glob("*/*.force-table"):
        table.unlink()  # so that the last run writes one
    status, errors = run(program, arguments, folder)
    if status not in (0, 2):
        findings.append(f"the last run ends with {status}: {errors}")
    findings += [f"{left} is left" for left in left_in(folder)]
    findings += [f"{file} is not whole" for file in unwhole_files(out)]
    for file in out.glob("*.json"):
        json.loads(file.read_text())
    print(f"| {name} | {whole_s:.1f} s | {1000 * writing_s:.0f} ms | {killed} | {written} |"
          f" {len(findings)} |", flush=True)
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
    print("| command | a run | of that writing | kills | of these while writing | findings |\n"
          "|---|---|---|---|---|---|", flush=True)
    for name in commands(pathlib.Path()):
        if options.command and name not in options.command:
            continue
        with tempfile.TemporaryDirectory(prefix="regoplan-kills-") as folder:
            write_inputs(pathlib.Path(folder))
            findings += campaign(options.program, name, pathlib.Path(folder), options.kills, chance)
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
