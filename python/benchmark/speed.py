"""What the package costs beside C++ and numpy; prints the ratios. Usage:

    PYTHONPATH=build/release/python python3 python/benchmark/speed.py --batch PROGRAM [--rows N]

PROGRAM is regoplan_python_batch of the same build. Runs alternate, the processor's time counts, and of
the ratios the median.
"""

import argparse
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

TARGET_RATIO, TARGET_IMPORT_MS = 1.15, 150


def rows_of(count):
    random = np.random.default_rng(1)
    return (290 * np.exp(random.uniform(np.log(0.1), np.log(2.5), count)),
            random.uniform(-0.9, 0.95, count), random.uniform(-np.pi / 3, np.pi / 3, count))


def seconds(work):
    """Of the processor: others on the machine shall not count."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def import_ms(what, runs=9):
    """The least of the clock, and of the processor."""
    code = (f"import time; t = time.perf_counter(), time.process_time(); import {what}; "
            "print(time.perf_counter() - t[0], time.process_time() - t[1])")
    found = [subprocess.run([sys.executable, "-c", code], check=True, capture_output=True,
                            text=True).stdout.split() for _ in range(runs)]
    return [1000 * min(float(pair[i]) for pair in found) for i in range(2)]


def model_text(soil):
    keys = "\n".join(f"  {key}: {value!r}" for key, value in soil.model_keys().items())
    return ("model: ishigami2007\nwheel: {radius_m: 0.41, width_m: 0.23}\ngravity_mps2: 1.62\n"
            f"soil:\n{keys}\n")


def main():
    import regoplan
    from wheel_port import Port

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--batch", required=True)
    parser.add_argument("--rows", type=int, default=1_000_000)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--memory-rows", type=int, default=10_000_000)
    options = parser.parse_args()
    for what in ("numpy", "regoplan"):
        clock, processor = import_ms(what)
        print(f"import {what}: {clock:.0f} ms, {processor:.0f} ms of the processor "
              f"(target of regoplan, numpy included: {TARGET_IMPORT_MS})")

    soil = regoplan.Soil.preset("firm_regolith")
    rows = rows_of(options.rows)
    with tempfile.TemporaryDirectory() as folder:
        file, model = Path(folder, "rows"), Path(folder, "model.yaml")
        file.write_bytes(b"".join(column.tobytes() for column in rows))
        model.write_text(model_text(soil), encoding="utf-8")
        direct = None
        for method in ("direct", "fast", "table", "table, plane"):
            kind = method.split(",")[0]
            wheel = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62, method=kind,
                                   nominal_load_n=290 if kind == "table" else None)
            call = wheel.plane_forces if "plane" in method else wheel.forces
            command = [options.batch, model, file, str(options.rows),
                       "batch" if "plane" in method else kind, "290"]
            ratios, ours = [], []
            for _ in range(options.runs):
                cpp = float(subprocess.run(command, check=True, capture_output=True).stdout)
                ours.append(seconds(lambda: call(*rows)))
                ratios.append(ours[-1] / cpp)
            ratio = statistics.median(ratios)
            print(f"{method}: {1e9 * min(ours) / options.rows:.0f} ns a row, "
                  f"{ratio:.3f} times the C++ batch (target {TARGET_RATIO}; "
                  f"{min(ratios):.3f} to {max(ratios):.3f})")
            direct = direct or min(ours) / options.rows
    few = [column[:20000] for column in rows]
    port = Port(0.41, 0.23, 1.62, soil.model_keys())
    port_s = min(seconds(lambda: port.forces(*few)) for _ in range(2)) / len(few[0])
    print(f"numpy port: {1e9 * port_s:.0f} ns a row; the module is {port_s / direct:.0f} times as fast")

    rows = rows_of(options.memory_rows)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    wheel.forces(*rows)
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024
    outputs = options.memory_rows * (4 * 8 + 1)
    print(f"memory of {options.memory_rows} rows: {grown / 1e6:.0f} MB beyond the inputs; "
          f"the outputs are {outputs / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
