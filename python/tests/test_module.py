"""The module as a guest of the interpreter: locks, signals, imports."""

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest


def test_import_loads_neither_pandas_nor_a_planner():
    code = ("import sys, regoplan; assert 'pandas' not in sys.modules; "
            "maps = open('/proc/self/maps').read(); "
            "assert 'libompl' not in maps and 'libgdal' not in maps")
    subprocess.run([sys.executable, "-c", code], check=True)


def test_other_threads_run_while_forces_are_computed(wheel):
    ended, counted = threading.Event(), 0

    def compute():
        wheel.forces(np.full(300_000, 290.0), 0.2, 0.1)
        ended.set()

    thread = threading.Thread(target=compute)
    thread.start()
    while not ended.is_set():
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 20


def test_many_threads_get_the_same_bits(wheel):
    slip = np.linspace(-0.8, 0.9, 5000)
    expected = wheel.forces(290, slip, 0.1).fx_n
    found = [None] * 4

    def compute(i):
        found[i] = wheel.forces(290, slip, 0.1).fx_n

    threads = [threading.Thread(target=compute, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(expected, each) for each in found)


def test_ctrl_c_ends_a_long_computation(wheel):
    rows = np.broadcast_to(290.0, 20_000_000)  # half a minute
    begun = time.monotonic()
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        wheel.forces(rows, 0.2, 0.1)
    assert time.monotonic() - begun < 5


def test_nothing_is_copied_beyond_the_outputs(wheel):
    # A child's own peak: what the parent once had would hide it.
    code = """
import resource, numpy, regoplan
soil = regoplan.Soil.preset("firm_regolith")
table = regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62, method="table", nominal_load_n=290)
table.forces(290.0, 0.1, 0.1)
slip = numpy.linspace(-0.8, 0.8, 2_000_000)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
table.forces(290.0, slip[::-1], 0.1)
print(1024 * (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before))
"""
    grown = int(subprocess.run([sys.executable, "-c", code], check=True, capture_output=True,
                               text=True).stdout)
    outputs = 2_000_000 * (4 * 8 + 1)
    assert grown < outputs + 8_000_000  # a column of doubles would be 16 MB


