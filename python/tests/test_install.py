"""The package as an installation or a wheel holds it: module, scripts, soils and the program."""

import os
import subprocess
import sys
from pathlib import Path

BUILD = os.environ["REGOPLAN_BUILD_DIR"]


def test_an_installed_package_brings_its_program(program, tmp_path):
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", tmp_path],
                   check=True, capture_output=True)
    code = ("import regoplan; from regoplan import _program; print(regoplan.__file__); "
            "print(_program.program_file()); print(regoplan.Soil.presets()[0]); "
            "print(regoplan.TerrainMap([[0, 0], [0, 1]], 5, regoplan.Soil.preset("
            "'firm_regolith')).info()['columns'])")
    clean = {key: value for key, value in os.environ.items() if not key.startswith("REGOPLAN_")}
    ran = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True,
                         env={**clean, "PYTHONPATH": str(tmp_path)}, cwd=tmp_path)
    package, program_file, soil, columns = ran.stdout.splitlines()
    assert Path(package).parent == tmp_path / "regoplan"
    assert Path(program_file) == tmp_path / "regoplan" / "bin" / "regoplan"
    assert (soil, columns) == ("firm_regolith", "2")


def test_the_program_finds_what_it_reads_of_its_own_beside_it(program, tmp_path):
    subprocess.run(["cmake", "--install", BUILD, "--component", "python", "--prefix", tmp_path],
                   check=True, capture_output=True)
    shared = tmp_path / "regoplan" / "share" / "regoplan"
    listed = (Path(os.environ["REGOPLAN_SOURCE_DIR"]) / "cmake" / "shared_files.cmake").read_text()
    for name in [word.strip(")") for word in listed.split() if word.strip(")").endswith(".yaml")]:
        assert (shared / name).is_file(), name
    ran = subprocess.run([tmp_path / "regoplan" / "bin" / "regoplan", "scenario"],
                         capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    (shared / "examples" / "scenario.yaml").unlink()  # it looks nowhere else
    ran = subprocess.run([tmp_path / "regoplan" / "bin" / "regoplan", "scenario"],
                         capture_output=True, text=True)
    assert ran.returncode == 1 and str(shared / "examples") in ran.stderr
