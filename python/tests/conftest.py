"""What the tests share: the program beside the package, and folders of the source."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import regoplan

SOURCE = Path(os.environ.get("REGOPLAN_SOURCE_DIR", Path(__file__).parents[2]))


@pytest.fixture(scope="session")
def program():
    """Runs the program; its numbers are what the package must give."""
    file = os.environ["REGOPLAN_PROGRAM"]

    def run(*arguments):
        return subprocess.run([file, *map(str, arguments)], check=False, capture_output=True,
                              text=True, cwd=SOURCE)

    return run


@pytest.fixture(scope="session")
def soil():
    return regoplan.Soil.preset("firm_regolith")


@pytest.fixture(scope="session")
def wheel(soil):
    return regoplan.Wheel(0.41, 0.23, soil, gravity_mps2=1.62)


@pytest.fixture(scope="session")
def scenario(soil):
    y, x = np.mgrid[0:120, 0:120] * 0.5
    return {"map": regoplan.TerrainMap(0.2 * np.sin(x / 6) * np.cos(y / 9), 0.5, soil,
                                       rocks=[[25, 30, 0.8, 0.6]]),
            "vehicle": "lrv", "gravity_mps2": 1.62,
            "start": {"x_m": 10, "y_m": 25, "heading_deg": 0},
            "goal": {"x_m": 40, "y_m": 25, "radius_m": 3}, "speed_mps": {"max": 3},
            "planner": {"name": "Lattice", "iterations": 1000, "candidates": 1, "soil_draws": 10}}
