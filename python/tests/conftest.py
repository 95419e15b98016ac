"""What the tests share: the program beside the package, and folders of the source."""

import os
import subprocess
from pathlib import Path

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
