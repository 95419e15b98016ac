#!/usr/bin/env python3
"""Draws how the step's error falls with the step, beside the slope of second order.

    vehicle_benchmark --benchmark_filter=slalom_of_a_minute --benchmark_format=json \
        | benchmarks/order_of_the_step.py > benchmarks/order_of_the_step.svg
"""
import argparse
import json
import math
import sys

LEFT, TOP, WIDTH, HEIGHT = 70, 30, 420, 320
STEPS = (1 / 64, 1)  # s
ERRORS = (1e-5, 1e3)  # mm per metre
COLOURS = ("#0072b2", "#c2570c", "#00795a", "#8a3fa0")


def place(step_s, error):
    along = math.log(step_s / STEPS[0]) / math.log(STEPS[1] / STEPS[0])
    up = math.log(error / ERRORS[0]) / math.log(ERRORS[1] / ERRORS[0])
    return LEFT + along * WIDTH, TOP + (1 - min(max(up, 0), 1)) * HEIGHT


def text(x, y, words, anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{words}</text>'


def line(places, colour, dashes="none", width=2):
    points = " ".join("%.1f,%.1f" % place(*one) for one in places)
    return (f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="{width}" '
            f'stroke-dasharray="{dashes}"/>')


def curves_of(benchmarks):
    """By speed: steps and errors."""
    curves = {}
    for run in benchmarks:
        speed = run["name"].split("/")[1].removeprefix("at_").removesuffix("_mps").replace("p", ".")
        curves.setdefault(speed, []).append((run["step_s"], run["error_mm_per_m"]))
    return curves


def picture(curves):
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 110} '
           f'{TOP + HEIGHT + 60}" font-family="sans-serif" font-size="12">',
           '<rect width="100%" height="100%" fill="white"/>']
    for k in range(7):
        x, y = place(2.0**-k, ERRORS[0])
        svg.append(f'<line x1="{x:.1f}" y1="{TOP}" x2="{x:.1f}" y2="{y:.1f}" stroke="#ddd"/>')
        svg.append(text(x, y + 18, "1" if k == 0 else f"1/{2**k}"))
    for k in range(-5, 4):
        x, y = place(STEPS[0], 10.0**k)
        svg.append(f'<line x1="{LEFT}" y1="{y:.1f}" x2="{LEFT + WIDTH}" y2="{y:.1f}" stroke="#ddd"/>')
        svg.append(text(x - 6, y + 4, f"{10.0**k:g}", "end"))
    svg.append(f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" '
               'stroke="#333"/>')
    second_order = [(step, 3.0 * step**2) for step in STEPS]
    svg.append(line(second_order, "#666", "4 4", 1.5))
    svg.append(text(*place(1 / 4, 0.02), "second order", "start", 'fill="#666"'))
    svg.append(line([(STEPS[0], 0.5), (STEPS[1], 0.5)], "#666", "1 3", 1.5))
    svg.append(text(LEFT + 6, place(1, 0.5)[1] - 5, "asked: 0.5 mm per metre", "start", 'fill="#666"'))
    for (speed, runs), colour in zip(curves.items(), COLOURS):
        svg.append(line(sorted(runs), colour))
        x, y = place(*max(runs))
        svg.append(text(x + 8, y + 4, f"{speed} m/s", "start", f'fill="{colour}"'))
    svg.append(text(LEFT + WIDTH / 2, TOP + HEIGHT + 40, "step [s]"))
    svg.append(text(0, 0, "error of the end [mm per metre driven]", "middle",
                    f'transform="translate(16,{TOP + HEIGHT / 2}) rotate(-90)"'))
    svg.append(text(LEFT, TOP - 10, "A slalom of a minute", "start", 'font-weight="bold"'))
    svg.append("</svg>")
    return "\n".join(svg)


def main():
    argparse.ArgumentParser(description=__doc__,
                            formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    print(picture(curves_of(json.load(sys.stdin)["benchmarks"])))


if __name__ == "__main__":
    main()
