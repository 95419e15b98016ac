#!/usr/bin/env python3
"""Diagnoses a recording, alone or against a reference, and prints what each model leaves of it.

    table.py RECORDING.csv --setup SETUP.yaml [--reference REFERENCE.csv ...] [--program ./regoplan]

Rows: the program's base model at the prior means and calibrated, the names it claims added one by
one, its correction, the noise floor; RMSE on conditions held out of the fit.
"""
import argparse
import json
import subprocess
import sys
import tempfile

SCALES = {"sinkage_m": ("mm", 1000), "rut_left_m": ("mm", 1000), "rut_right_m": ("mm", 1000),
          "fx_n": ("N", 1), "fy_n": ("N", 1), "torque_nm": ("N m", 1)}


def diagnosis(arguments):
    """What diagnosis.json says; the program's own message where it fails."""
    with tempfile.TemporaryDirectory() as folder:
        command = [arguments.program, "diagnose", arguments.recording, "--setup", arguments.setup,
                   "--out", folder, "--json", "--quiet"]
        if arguments.reference:
            command += ["--reference", *arguments.reference]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 2):
        sys.exit(run.stderr.strip())
    return json.loads(run.stdout)


def rows(found):
    """(what, RMSE by channel), from the base model to the noise."""
    fit = found["fit"]
    shared = "calibrated" if not found["references"] else "base with what the reference shares"
    yield "base, prior means", {c: f["baseline_rmse"] for c, f in fit.items()}
    yield shared, {c: f["calibrated_rmse"] for c, f in fit.items()}
    names = ""
    for step in found["names_added"]:
        names += ("+ " if not names else " + ") + step["id"]
        yield names, step["rmse"]
    yield "correction handed out", {c: f["corrected_rmse"] for c, f in fit.items()}
    yield "noise floor", {c: f["noise_floor"] for c, f in fit.items()}


def over_unexplained(claim):
    """What it has over a mismatch without a name; nothing of names after the first."""
    nats = claim["over_unexplained_nats"]
    return "" if nats is None else f", {nats:.0f} over a mismatch without a name"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording")
    parser.add_argument("--setup", required=True)
    parser.add_argument("--reference", nargs="*", default=[])
    parser.add_argument("--program", default="./regoplan")
    found = diagnosis(parser.parse_args())
    channels = list(found["fit"])
    print(f"{found['verdict']}: {found['sentence']}")
    for claim in found["mechanisms"]:
        share = claim["share"]
        alike = f" (or {', '.join(claim['equivalent'])})" if claim["equivalent"] else ""
        print(f"  {claim['id']}{alike}: {100 * share['explained']:.0f} % "
              f"({100 * share['low']:.0f} to {100 * share['high']:.0f} %), "
              f"{claim['evidence_nats']:.0f} nats{over_unexplained(claim)}")
    print(f"nameless worlds reach {found['chance_nats']:.0f} nats over a mismatch without a name; "
          f"held out by {found['held_out_by']}\n")
    print("| model | " + " | ".join(f"{c} ({SCALES[c][0]})" for c in channels) + " |")
    print("|---" * (len(channels) + 1) + "|")
    for what, rmse in rows(found):
        print(f"| {what} | " + " | ".join(f"{rmse[c] * SCALES[c][1]:.2f}" for c in channels) + " |")


if __name__ == "__main__":
    main()
