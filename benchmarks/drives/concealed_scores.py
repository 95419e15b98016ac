"""How a diagnosis of a concealed effect is scored, and the table of many."""
import csv
import json
import math
import statistics

WINDOW_S = 5  # of a diagnosis with a vehicle


def way_of(recording):
    """Place along the path's axis by time: fresh positions."""
    with open(recording, encoding="utf-8") as file:
        return [(float(row["time_s"]), float(row["x_m"])) for row in csv.DictReader(file)
                if row["x_m"]]


def place_at(way, time_s):
    for (t0, x0), (t1, x1) in zip(way, way[1:]):
        if t1 >= time_s:
            return x0 + (x1 - x0) * (time_s - t0) / (t1 - t0)
    return way[-1][1]


def score(drive):
    """Whether the truth is named, what else is claimed, and how a zone lies."""
    truth = json.loads(drive.truth.read_text())
    said = json.loads(drive.diagnosis.read_text())
    claims = said["mechanisms"]
    right = [claim for claim in claims if drive.effect in claim["equivalent"]]
    result = {"named": any(claim["id"] == drive.effect for claim in claims),
              "right": bool(right), "wrong": [c for c in claims if c not in right], "claims": claims}
    if drive.effect == "soil_zone" and right:
        way = way_of(drive.folder / "drive.csv")
        from_m = truth["zones"][0]["corners_m"][0][0]
        found = [at["region"]["time_s"] for at in said["where"] if at["channel"] == "soil"]
        best = (-1.0, 0.0)
        for begins_s, ends_s in found:
            begins, ends = place_at(way, begins_s), place_at(way, ends_s)
            both = max(0, min(ends, from_m + 30) - max(begins, from_m))
            overlap = both / (30 + ends - begins - both)
            apart_m = max(abs(begins - from_m), abs(ends - from_m - 30))
            best = max(best, (overlap, apart_m))
        speed_mps = (way[-1][1] - way[0][1]) / (way[-1][0] - way[0][0])
        result["overlap"], result["apart_m"] = best
        result["apart_windows"] = best[1] / (WINDOW_S * speed_mps)
        result["right"] = best[0] > 0
    return result


def wilson(count, of):
    """Bounds of 95 % of a share."""
    z, share = 1.96, count / of
    middle = (share + z * z / (2 * of)) / (1 + z * z / of)
    half = z / (1 + z * z / of) * math.sqrt(share * (1 - share) / of + z * z / (4 * of * of))
    return f"{count}/{of} ({abs(100 * (middle - half)):.0f} to {100 * (middle + half):.0f} %)"


def table(scored):
    print("| effect | grade | right name or its class | by its own name | drives with other claims |")
    print("|---|---|---|---|---|")
    for effect, grade in dict.fromkeys((d.effect, d.grade) for d, _ in scored):
        rows = [s for d, s in scored if (d.effect, d.grade) == (effect, grade)]
        right = wilson(sum(s["right"] for s in rows), len(rows)) if effect != "none" else "-"
        named = wilson(sum(s["named"] for s in rows), len(rows)) if effect != "none" else "-"
        other = wilson(sum(bool(s["wrong"]) for s in rows), len(rows))
        print(f"| {effect} | {grade} | {right} | {named} | {other} |")
    for grade in dict.fromkeys(d.grade for d, _ in scored):
        zones = [s for d, s in scored if d.grade == grade and "overlap" in s]
        if zones:
            within = sum(s["apart_windows"] <= 1 for s in zones)
            print(f"zones {grade}: median intersection over union "
                  f"{statistics.median(s['overlap'] for s in zones):.2f}, both borders within one "
                  f"window {wilson(within, len(zones))}")
