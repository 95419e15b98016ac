#!/usr/bin/env python3
"""The program's own speeds, as ratios to their baselines within one run.

    benchmarks/speed.py                  build, run every google-benchmark program, print the ratios
    benchmarks/speed.py --check          and fail where a ratio lost more than 20 % against the history
    benchmarks/speed.py --record         and add the ratios to the history under this commit

A ratio is the CPU time of a baseline over that of a benchmark, both of the same run: 10 means ten
times as fast. What is measured against which baseline stands in speed_baselines.json; the history, a
line for each commit and ratio, in speed_history.csv.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "release"
HISTORY = ROOT / "benchmarks" / "speed_history.csv"
LOSS_ALLOWED = 0.20
REPETITIONS = 5


def build_and_run(program):
    """CPU time of every benchmark of a program, ns: the least of several repetitions."""
    subprocess.run(["ninja", "-C", str(BUILD), program], check=True, stdout=subprocess.DEVNULL)
    run = subprocess.run(
        [str(BUILD / program), "--benchmark_format=json", "--benchmark_min_time=0.1",
         f"--benchmark_repetitions={REPETITIONS}"],
        check=True, capture_output=True, text=True)
    units = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}
    times = {}
    for row in json.loads(run.stdout)["benchmarks"]:
        if row.get("run_type") == "aggregate" or "error_occurred" in row:
            continue
        time = row["cpu_time"] * units[row["time_unit"]]
        name = row["run_name"]
        times[name] = min(time, times.get(name, time))
    return times


def ratios_of(program, times):
    """(program, benchmark, baseline, ratio) of every benchmark that has a baseline."""
    rows = []
    for name, time in sorted(times.items()):
        baseline = baseline_of(program, name, times)
        if baseline and baseline != name:
            rows.append((program, name, baseline, times[baseline] / time))
    return rows


def baseline_of(program, name, times):
    """The first that fits; `{case}` in it is what follows the first slash of the name."""
    case = name.partition("/")[2]
    for prefix, baseline in BASELINES[program]:
        if name.startswith(prefix) and baseline.format(case=case) in times:
            return baseline.format(case=case)
    return None


# program: [(what begins so, its baseline), ...]
BASELINES = json.loads((ROOT / "benchmarks" / "speed_baselines.json").read_text())


def last_of_history():
    """The newest ratio of each (program, benchmark, baseline)."""
    last = {}
    if HISTORY.exists():
        for row in csv.DictReader(HISTORY.open()):
            last[row["program"], row["benchmark"], row["baseline"]] = (
                row["commit"], float(row["ratio"]))
    return last


def commit():
    return subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"], check=True,
                          capture_output=True, text=True).stdout.strip()


def losses(rows, last):
    """Ratios that fell by more than is allowed, as (row, commit, ratio before)."""
    found = []
    for row in rows:
        before = last.get(row[:3])
        if before and row[3] < (1 - LOSS_ALLOWED) * before[1]:
            found.append((row, *before))
    return found


def record(rows):
    new = not HISTORY.exists()
    with HISTORY.open("a", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        if new:
            writer.writerow(["commit", "program", "benchmark", "baseline", "ratio"])
        here = commit()
        for program, name, baseline, ratio in rows:
            writer.writerow([here, program, name, baseline, f"{ratio:.4g}"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="fail on a loss of more than 20 %%")
    parser.add_argument("--record", action="store_true", help="add this commit to the history")
    parser.add_argument("programs", nargs="*", help="default: all")
    options = parser.parse_args()
    if not (BUILD / "build.ninja").exists():
        subprocess.run(["cmake", "--preset", "release"], cwd=ROOT, check=True,
                       stdout=subprocess.DEVNULL)
    rows = []
    for program in options.programs or sorted(BASELINES):
        rows += ratios_of(program, build_and_run(program))
    print(f"{'ratio':>9}  benchmark against baseline")
    for program, name, baseline, ratio in rows:
        print(f"{ratio:>9.3g}  {program}: {name} against {baseline}")
    lost = losses(rows, last_of_history()) if options.check else []
    for row, before, ratio in lost:
        print(f"LOST: {row[0]}: {row[1]} against {row[2]}: {row[3]:.3g}, was {ratio:.3g} at {before}",
              file=sys.stderr)
    if options.record:
        record(rows)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
