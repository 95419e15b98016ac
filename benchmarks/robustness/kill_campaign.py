#!/usr/bin/env python3
"""Kills every command at random moments (SIGKILL, the whole process group) and looks at what is left:
each file that can be seen is whole, the next run takes over without --force, and when one has come
to its end no hidden folder is left, nor a half-written table in the cache. Every other kill comes
while files are written: after the hidden folder is there, within the time that this stage takes.

    benchmarks/robustness/kill_campaign.py [--program FILE] [--kills N] [--seed N] [COMMAND...]
"""
import json
import os
import shutil
import signal
import subprocess
import time

from campaign import ROOT, run_campaigns

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
        "diagnose drives": ["diagnose", folder / "d.csv", "--scenario", folder / "s.yaml", "--out", out],
        "drive": ["drive", folder / "s.yaml", folder / "p.csv", "--sensors", "B", "--out", out],
        "demo": ["demo", "--no-drive", "--iterations", "200", "--out", out],
        "export": ["export", folder / "planned", "--nav2", out],
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
    """When the hidden folder was made that files are written to first: in `out`, or beside it where
    that is still to be made; 0 where there is none."""
    try:
        return max((entry.stat().st_ctime for entry in os.scandir(out if out.exists() else out.parent)
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
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:  # it came to its end by itself meanwhile
            _, errors = process.communicate()
            return process.returncode, errors.decode()
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
    left = [path.name for at in (folder, folder / "out") for path in at.glob(".regoplan-*")
            if path.name != ".regoplan-files"]
    return left + [path.name for path in (folder / "cache").glob("*/*.force-table.*")]


def prepare(program, arguments, folder):
    """Makes what a command needs beside the input."""
    if arguments[0] == "wheel" and "--figures" not in arguments:
        (folder / "out").mkdir()
    if arguments[1] == "merge":
        for part in ("1", "2"):
            run(program, ["benchmark", folder / "suite.yaml", "--shard", f"{part}/2", "--out",
                          folder / f"part-{part}"], folder)
    if arguments[0] == "export":
        run(program, ["plan", folder / "s.yaml", "--out", folder / "planned"], folder)


def clear_finished_benchmark(out):
    """A benchmark that came to its end has nothing left to run or to merge; one that did not goes on."""
    if (out / "runs.jsonl").exists() and (out / "benchmark.json").exists():
        shutil.rmtree(out)


def campaign(program, arguments, folder, kills, chance):
    prepare(program, arguments, folder)
    out = folder / "out"
    status, errors, whole_s, writing_s = whole_run(program, arguments, folder)
    findings = [] if status in (0, 2) else [f"the first run ends with {status}: {errors}"]
    killed = written = 0
    while killed < kills and not findings:
        clear_finished_benchmark(out)
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
    clear_finished_benchmark(out)
    status, errors = run(program, arguments, folder)
    if status not in (0, 2):
        findings.append(f"the last run ends with {status}: {errors}")
    findings += [f"{left} is left" for left in left_in(folder)]
    findings += [f"{file} is not whole" for file in unwhole_files(out)]
    for file in out.glob("*.json"):
        json.loads(file.read_text())
    return f"{whole_s:.1f} s | {1000 * writing_s:.0f} ms | {killed} | {written}", findings


if __name__ == "__main__":
    run_campaigns(__doc__, "--kills", 200,
                  "a run | of that writing | kills | of these while writing", commands, campaign)
