#!/usr/bin/env python3
"""Draws pairs of a reference and a test, diagnoses the test against the reference, and counts.

    pairs_campaign.py PROGRAM FOLDER FIRST LAST [--kinds same,grousers] [--false-lugs] [--jobs 2]

Seeds FIRST to LAST of each kind. The program is given none of the truths. Pairs and results that
are there already are kept, so that a campaign goes on where it was killed. With --false-lugs every
test of another kind than `grousers` tells of lugs that it has not, and its reference of none.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib

from campaign import diagnosis_of, wilson
from csv_rows import read_rows, write_rows
from pairs import EFFECTS, FEW_REPLICATES, KINDS, write_pair

COLUMNS = ("right", "wrong", "silent", "too weak", "too weak, wrong")
FALSE_LUG_HEIGHT_M, FALSE_LUGS = 0.01, 12


def tell_lugs(path, lug_height_m, lug_count):
    rows = read_rows(path)
    for row in rows:
        row.update(lug_height_m=lug_height_m, lug_count=lug_count)
    write_rows(path, rows)


def draw(folder, false_lugs, kind, seed):
    """A name, or None where no pair could be drawn."""
    name = f"{kind}-{seed}"
    if (folder / name / "truth.json").exists():
        return name
    if not write_pair(folder / name, seed, kind):
        return None
    if false_lugs and kind != "grousers":
        tell_lugs(folder / name / "test.csv", FALSE_LUG_HEIGHT_M, FALSE_LUGS)
        tell_lugs(folder / name / "reference.csv", 0, 0)
    return name


def diagnose(arguments, name):
    folder = arguments.folder / name
    return name, diagnosis_of(arguments.program, folder, "test.csv", "--reference",
                              folder / "reference.csv")


def outcome(truth, said):
    """One of COLUMNS. What is claimed beside a right name spoils it. Where nothing has a name,
    right is to claim none; that nothing differs is right of `same` only, and silent else."""
    classes = [{claim["id"], *claim["equivalent"]} for claim in said["mechanisms"]]
    accepted = set(truth["accepted"])
    wrong = (any(not names & accepted for names in classes) if truth["kind"] in EFFECTS
             else bool(classes))
    if said["verdict"].startswith("failed"):
        return "wrong"
    if truth["too_weak"]:
        return "too weak, wrong" if wrong else "too weak"
    if wrong:
        return "wrong"
    expected = {"same": ("consistent", "parameters")}.get(truth["kind"], ("unexplained",))
    right = bool(classes) if truth["kind"] in EFFECTS else said["verdict"] in expected
    return "right" if right else "silent"


def group_of(truth):
    """What a difference can be told by: where the test was driven, and what tells the noise."""
    noise = ("replicates" if sum(truth["replicates"]) >= FEW_REPLICATES
             else "noise told" if truth["noise_told"] else "few replicates")
    return f"{truth['conditions']} conditions, {noise}"


def described(truth, said, ranked=5):
    """What the truth is, what was said and what came near."""
    lines = [f"  truth: chi-square {truth['chi_square']:.0f}, "
             f"{'too weak, ' if truth['too_weak'] else ''}runs {truth['runs']}, {group_of(truth)}"]
    if truth["kind"] == "grousers":
        alone = ", ".join(f"{part} {value:.0f}"
                          for part, value in truth["lugs_chi_square_alone"].items())
        lines[0] += (f", lugs {'' if truth['lugs_told'] else 'not '}told, ruled by "
                     f"{truth['lugs_rule']}; chi-square of each part alone: {alone}")
    for claim in said["mechanisms"]:
        over = claim.get("over_unexplained_nats")
        lines.append(f"  said: {' or '.join([claim['id'], *claim['equivalent']])} "
                     f"({claim.get('form', '')}; {', '.join(claim['channels'])}) at "
                     f"{claim['probability']:.2f}, {claim.get('evidence_nats') or 0:.1f} nats, "
                     f"over a mismatch without a name {'-' if over is None else f'{over:.1f}'}")
    top = ", ".join(f"{entry['id']} {entry['probability']:.2f} "
                    f"({entry.get('evidence_nats') or 0:.1f})"
                    for entry in said["ranking"][:ranked])
    return lines + [f"  ranking (nats): {top}"]


def print_table(kinds, counts, verdicts):
    """Outcomes and verdicts by kind."""
    print(f"\n| kind | {' | '.join(COLUMNS)} | right, 95 % | wrong, 95 % | verdicts |")
    print(f"|{'---|' * (len(COLUMNS) + 4)}")
    for kind in kinds:
        of = sum(counts[kind][column] for column in COLUMNS[:3])
        said = ", ".join(f"{verdict} {count}" for verdict, count in verdicts[kind].most_common())
        print(f"| {kind} | {' | '.join(str(counts[kind][column]) for column in COLUMNS)} | "
              f"{wilson(counts[kind]['right'], of)} | {wilson(counts[kind]['wrong'], of)} | "
              f"{said} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--kinds", type=lambda text: text.split(","), default=list(KINDS))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--false-lugs", action="store_true",
                        help="let tests tell of lugs that they have not")
    parser.add_argument("--silent", action="store_true", help="tell of the silent ones as well")
    arguments = parser.parse_args()
    if unknown := set(arguments.kinds) - set(KINDS):
        parser.error(f"no such kind: {', '.join(sorted(unknown))}")

    # A few seeds of every kind come before many of one.
    cases = [(kind, seed) for seed in range(arguments.first, arguments.last + 1)
             for kind in arguments.kinds]
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        drawn = list(pool.map(draw, [arguments.folder] * len(cases),
                              [arguments.false_lugs] * len(cases), *zip(*cases)))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = dict(pool.map(lambda name: diagnose(arguments, name), filter(None, drawn)))

    counts = collections.defaultdict(collections.Counter)
    verdicts = collections.defaultdict(collections.Counter)
    groups = collections.defaultdict(collections.Counter)
    for name, said in results.items():
        truth = json.loads((arguments.folder / name / "truth.json").read_text(encoding="utf-8"))
        kind, found = truth["kind"], outcome(truth, said)
        counts[kind][found] += 1
        verdicts[kind][said["verdict"]] += 1
        if kind != "same":
            groups[group_of(truth)][found] += 1
        if "wrong" in found or (arguments.silent and found == "silent"):
            print(f"{name}: {found}, {said['verdict']}", *described(truth, said), sep="\n")

    print_table(arguments.kinds, counts, verdicts)
    print(f"\n| all that differ | {' | '.join(COLUMNS)} |\n|{'---|' * (len(COLUMNS) + 1)}")
    for group, found in sorted(groups.items()):
        print(f"| {group} | {' | '.join(str(found[column]) for column in COLUMNS)} |")
    if missing := [f"{kind}-{seed}" for name, (kind, seed) in zip(drawn, cases) if name is None]:
        print(f"none of 200 draws could be driven: {', '.join(missing)}")


if __name__ == "__main__":
    main()
