#!/usr/bin/env python3
"""Interrupts every command at random moments (SIGINT and SIGTERM in turn) and measures how long it
takes to end. It must end with 130 or 143 and the word "interrupted", and leave all of its files,
marked interrupted, or none.

    benchmarks/robustness/latency_campaign.py [--program FILE] [--times N] [--seed N] [COMMAND...]

`drives` needs the logs of benchmarks/drives/README.md in $REGOPLAN_DATA/cuadriga_drives.
"""
import json
import os
import pathlib
import signal
import statistics
import subprocess
import time

from campaign import ROOT, run_campaigns

SLOWEST_S = 1.0


def drives(folder):
    data = pathlib.Path(os.environ.get("REGOPLAN_DATA", "none")) / "cuadriga_drives"
    logs = sorted(data.glob("20*.csv"))
    setup = ROOT / "benchmarks/drives"
    if not logs:
        return None
    (folder / "scenario.yaml").write_text((setup / "cuadriga_scenario.yaml").read_text())
    (folder / "uma_rescue_area_1m.tif").write_bytes((data / "uma_rescue_area_1m.tif").read_bytes())
    return ["diagnose", *logs, "--scenario", folder / "scenario.yaml", "--setup",
            setup / "cuadriga_setup.yaml", "--columns", setup / "cuadriga_columns.yaml"]


def commands(folder):
    """Each with the file that says whether it was interrupted."""
    if folder.name:
        suite = folder / "suite.yaml"
        suite.write_text(suite.read_text().replace("iterations: 200", "iterations: 20000"))
    recording = ROOT / "scenarios/diagnosis"
    bed = ROOT / "benchmarks/measured/granular_bed"
    return {
        "diagnose": (["diagnose", recording / "recording.csv", "--setup", recording / "setup.yaml"],
                     "diagnosis.json"),
        "reference": (["diagnose", bed / "grousered.csv", "--reference", bed / "smooth.csv",
                       "--setup", bed / "setup.yaml"], "diagnosis.json"),
        "drives": (drives(folder) if folder.name else None, "diagnosis.json"),
        "benchmark": (["benchmark", folder / "suite.yaml"], "benchmark.json"),
        "plan": (["plan", folder / "s.yaml", "--time", "15"], "plan.json"),
        "evaluate": (["evaluate", folder / "s.yaml", folder / "p.csv", "--draws", "20000"],
                     "evaluation.json"),
        "drive": (["drive", folder / "s.yaml", folder / "p.csv", "--follower", "compensated"],
                  "drive.json"),
        "demo": (["demo"], "plan.json"),
    }


def start(program, arguments, out):
    return subprocess.Popen([program, *map(str, arguments), "--quiet", "--out", str(out)],
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def heeds_signals(process):
    """Whether the program has begun: before that a signal ends it without a word."""
    try:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    except OSError:
        return False
    caught = int(status.partition("SigCgt:")[2].split()[0], 16)
    return bool(caught >> (signal.SIGTERM - 1) & 1)


def interrupted(process, after_s, number):
    """How long it took to end; None where it had ended before."""
    try:
        process.communicate(timeout=after_s)
        return None, ""
    except subprocess.TimeoutExpired:
        pass
    while not heeds_signals(process):
        if process.poll() is not None:
            return None, process.communicate()[1]
        time.sleep(0.001)
    begun = time.monotonic()
    process.send_signal(number)
    _, errors = process.communicate()
    return time.monotonic() - begun, errors


def wrong_in(out, says):
    wrong = [f"{left.name} is left" for at in (out, out.parent) for left in at.glob(".regoplan-*")
             if left.name != ".regoplan-files"]
    if not out.exists():
        return wrong
    if not (out / says).exists():
        return wrong + [f"{file.name} without {says}" for file in out.glob("[!.]*")
                        if file.name != "runs.jsonl"]
    if json.loads((out / says).read_text()).get("interrupted") is not True:
        wrong.append(f"{says} is not marked interrupted")
    return wrong


def campaign(program, command, folder, times, chance):
    arguments, says = command
    if arguments is None:
        return "no logs in REGOPLAN_DATA | 0 | |", []
    begun = time.monotonic()
    process = start(program, arguments, folder / "whole")
    _, errors = process.communicate()
    whole_s = time.monotonic() - begun
    findings = [] if process.returncode in (0, 2) else [f"{process.returncode}: {errors}"]
    taken_s = []
    for i in range(times):
        out = folder / str(i)
        number, status = ((signal.SIGINT, 130), (signal.SIGTERM, 143))[i % 2]
        after_s = chance.uniform(0, whole_s)
        process = start(program, arguments, out)
        took_s, errors = interrupted(process, after_s, number)
        if took_s is None or process.returncode in (0, 2):
            continue  # it had come to its end
        taken_s.append(took_s)
        if process.returncode != status or not errors.endswith("regoplan: interrupted\n"):
            findings.append(f"at {after_s:.2f} s: {process.returncode}: {errors}")
        if took_s > SLOWEST_S:
            findings.append(f"at {after_s:.2f} s: took {took_s:.2f} s")
        findings += [f"at {after_s:.2f} s: {what}" for what in wrong_in(out, says)]
    worst_s, middle_s = (max(taken_s), statistics.median(taken_s)) if taken_s else (0, 0)
    return f"{whole_s:.1f} s | {len(taken_s)} | {middle_s:.2f} s | {worst_s:.2f} s", findings


if __name__ == "__main__":
    run_campaigns(__doc__, "--times", 20, "a run | interrupted | median | longest", commands,
                  campaign)
