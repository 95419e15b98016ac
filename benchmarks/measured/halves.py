#!/usr/bin/env python3
"""Compares random halves of a recording with each other: the two do not differ, so a diagnosis of
one against the other must be silent (`consistent`).

    halves.py RECORDING.csv --setup SETUP.yaml [--splits 20] [--seed 1] [--program ./regoplan]

Prints a line a split and, last, how many were silent, with Wilson's interval at 95 %. Exit 1 where
fewer than 39 in 40 were.
"""
import argparse
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile


def halves(rows, draw):
    """The rows in two halves, each in the order of the recording."""
    first = set(draw.sample(range(len(rows)), len(rows) // 2))
    return ([row for i, row in enumerate(rows) if i in first],
            [row for i, row in enumerate(rows) if i not in first])


def write(path, header, rows):
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([header, *rows])


def diagnosis(arguments, folder):
    """What diagnosis.json says of the halves in a folder; the program's own message on failure."""
    run = subprocess.run([arguments.program, "diagnose", folder / "test.csv", "--reference",
                          folder / "reference.csv", "--setup", arguments.setup, "--out",
                          folder / "out", "--json", "--quiet"],
                         capture_output=True, text=True, check=False)
    if run.returncode not in (0, 2):
        sys.exit(run.stderr.strip())
    return json.loads(run.stdout)


def wilson(hits, n, z=1.96):
    """Wilson's interval at 95 % of a share."""
    middle = (hits / n + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(hits / n * (1 - hits / n) / n + z * z / (4 * n * n))
    return max(0, middle - half), min(1, middle + half)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording")
    parser.add_argument("--setup", required=True)
    parser.add_argument("--splits", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--program", default="./regoplan")
    arguments = parser.parse_args()
    with open(arguments.recording, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    draw = random.Random(arguments.seed)
    silent = 0
    for split in range(1, arguments.splits + 1):
        test, reference = halves(rows, draw)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write(folder / "test.csv", header, test)
            write(folder / "reference.csv", header, reference)
            found = diagnosis(arguments, folder)
        silent += found["verdict"] == "consistent"
        claimed = ", ".join(claim["id"] for claim in found["mechanisms"]) or "no name"
        lack = found["lack_of_fit"]["before"]
        print(f"{split:3d} {found['verdict']:12s} {claimed}; F {lack['f']:.2f}, "
              f"critical {lack['critical']:.2f}", flush=True)
    low, high = wilson(silent, arguments.splits)
    print(f"silent in {silent} of {arguments.splits} "
          f"({100 * silent / arguments.splits:.0f} %, {100 * low:.0f} to {100 * high:.0f} %)")
    return 0 if silent >= 39 / 40 * arguments.splits else 1


if __name__ == "__main__":
    sys.exit(main())
