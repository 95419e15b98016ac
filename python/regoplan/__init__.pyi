import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import pandas as pd

_Array = npt.NDArray[np.float64]
_File = str | os.PathLike[str]
_Numbers = npt.ArrayLike
_Method = Literal["direct", "fast", "table"]
_Model = Literal["ishigami2007", "yoshida2004"]
_Settings = Mapping[str, Any]
_Progress = Callable[[str, float, str], object]
_Table = pd.DataFrame | Mapping[str, npt.ArrayLike]

STATUS: Mapping[str, int]

class InputError(ValueError):
    field: str | None
    value: str | None
    allowed: str | None
    file: str | None
    line: int | None
    def __init__(self, message: str) -> None: ...

class ProgramError(RuntimeError): ...

class Soil:
    cohesion_pa: float
    friction_angle_deg: float
    kc: float
    kphi: float
    n: float
    a0: float
    a1: float
    density_kgpm3: float
    kx0_m: float
    kx1_m: float
    ky0_m: float
    ky1_m: float
    c0_m: float
    @property
    def lambda_(self) -> float: ...
    @property
    def standard_deviations(self) -> dict[str, float]: ...
    def __init__(self, *, lambda_: float | Mapping[str, float] = ..., source: str | None = ...,
                 **keys: float | Mapping[str, float]) -> None: ...
    @classmethod
    def preset(cls, name: str) -> Soil: ...
    @classmethod
    def presets(cls) -> list[str]: ...
    @classmethod
    def from_file(cls, file: _File) -> dict[str, Soil]: ...
    def to_dict(self) -> dict[str, Any]: ...
    def model_keys(self) -> dict[str, float]: ...
    def replace(self, **changes: Any) -> Soil: ...

class _Columns:
    def to_dict(self) -> dict[str, np.ndarray]: ...
    def to_dataframe(self) -> pd.DataFrame: ...

class WheelForces(_Columns):
    fx_n: _Array
    fy_n: _Array
    torque_nm: _Array
    sinkage_m: _Array
    status: npt.NDArray[np.uint8]
    rut_left_m: _Array | None
    rut_right_m: _Array | None
    roll_moment_nm: _Array | None
    @property
    def ok(self) -> npt.NDArray[np.bool_]: ...
    def to_dict(self) -> dict[str, np.ndarray]: ...

class Wheel:
    def __init__(self, radius_m: float, width_m: float, soil: Soil | _Settings, *,
                 gravity_mps2: float = ..., model: _Model = ..., mechanisms: Iterable[_Settings] = ...,
                 method: _Method = ..., nominal_load_n: float | None = ...,
                 soil_name: str | None = ...) -> None: ...
    @classmethod
    def from_file(cls, file: _File, *, method: _Method = ...,
                  nominal_load_n: float | None = ...) -> Wheel: ...
    @classmethod
    def of_paper(cls) -> Wheel: ...
    def to_dict(self) -> dict[str, Any]: ...
    def forces(self, load_n: _Numbers, slip_ratio: _Numbers, slip_angle_rad: _Numbers, *,
               threads: int = ...) -> WheelForces: ...
    def plane_forces(self, load_n: _Numbers, slip_ratio: _Numbers, slip_angle_rad: _Numbers, *,
                     threads: int = ...) -> tuple[_Array, _Array]: ...
    def channels(self, load_n: _Numbers, slip_ratio: _Numbers, slip_angle_rad: _Numbers, *,
                 threads: int = ..., speed_mps: _Numbers = ..., position_m: _Numbers = ...,
                 time_s: _Numbers = ..., heading_rad: _Numbers = ..., wheel_angle_rad: _Numbers = ...,
                 sinkage_offset_m: _Numbers = ..., pass_number: _Numbers = ...) -> WheelForces: ...
    def table_facts(self) -> dict[str, float]: ...

class Vehicle:
    name: str
    source: str
    mass_kg: float
    wheel: dict[str, float]
    wheels: list[dict[str, Any]]
    def __init__(self, **keys: Any) -> None: ...
    def __getattr__(self, key: str) -> Any: ...
    @classmethod
    def preset(cls, name: str) -> Vehicle: ...
    @classmethod
    def presets(cls) -> list[str]: ...
    @classmethod
    def from_file(cls, file: _File) -> Vehicle: ...
    def to_dict(self) -> dict[str, Any]: ...
    def replace(self, **changes: Any) -> Vehicle: ...

class Margins(_Columns):
    demand_n: _Array
    supply_min_n: _Array
    supply_max_n: _Array
    cornering: _Array
    tip_over: _Array
    traction: _Array
    margin: _Array

class SafeCurvature(_Columns):
    curvature_1pm: _Array
    supply_n: _Array
    limit: npt.NDArray[np.str_]

class VehicleOnSoil:
    vehicle: Vehicle
    soil: Soil
    wheel: Wheel
    gravity_mps2: float
    def __init__(self, vehicle: Vehicle | _Settings | str, soil: Soil | _Settings,
                 gravity_mps2: float, *, model: _Model = ..., mechanisms: Iterable[_Settings] = ...,
                 method: _Method = ..., nominal_load_n: float | None = ...) -> None: ...
    def margins(self, speed_mps: _Numbers, curvature_1pm: _Numbers = ..., *, threads: int = ...,
                acceleration_mps2: _Numbers = ..., slope_forward_rad: _Numbers = ...,
                slope_left_rad: _Numbers = ...) -> Margins: ...
    def largest_safe_curvature(self, speed_mps: _Numbers, slope_left_rad: _Numbers = ..., *,
                               margin_min: float = ..., threads: int = ...) -> SafeCurvature: ...
    def supply(self, speed_mps: float, curvature_1pm: float = ..., *, acceleration_mps2: float = ...,
               slope_forward_rad: float = ..., slope_left_rad: float = ...) -> dict[str, Any]: ...
    def trim(self, speed_mps: float, curvature_1pm: float = ..., *, acceleration_mps2: float = ...,
             slope_forward_rad: float = ..., slope_left_rad: float = ...) -> dict[str, Any]: ...

class TerrainMap:
    cell_m: float
    west_m: float
    south_m: float
    @property
    def elevation_m(self) -> npt.NDArray[np.float32]: ...
    def __init__(self, elevation_m: _Numbers, cell_m: float,
                 soils: Soil | Mapping[str, Soil | _Settings], *, west_m: float = ...,
                 south_m: float = ..., soil_class: _Numbers | None = ...,
                 classes: Mapping[int, str] | None = ..., unmapped: str | None = ...,
                 rocks: _Numbers | None = ...) -> None: ...
    def write(self, folder: _File) -> dict[str, Any]: ...
    def info(self) -> dict[str, Any]: ...

class Candidate:
    json: dict[str, Any]
    csv: str
    @property
    def columns(self) -> dict[str, np.ndarray]: ...
    def __getattr__(self, key: str) -> Any: ...
    def to_dataframe(self) -> pd.DataFrame: ...

class _Result:
    json: dict[str, Any]
    notices: list[str]
    @property
    def folder(self) -> Path: ...
    @property
    def report_html(self) -> str: ...
    def __getattr__(self, key: str) -> Any: ...

class Plan(_Result):
    candidates: list[Candidate]
    def to_dataframe(self) -> pd.DataFrame: ...

class Evaluation(_Result):
    def to_dataframe(self) -> pd.DataFrame: ...

class Diagnosis(_Result):
    @property
    def residuals(self) -> dict[str, np.ndarray]: ...
    def corrected_wheel(self, *, method: _Method = ...,
                        nominal_load_n: float | None = ...) -> Wheel: ...
    def to_dataframe(self) -> pd.DataFrame: ...

class Drive(_Result):
    @property
    def recording(self) -> dict[str, np.ndarray]: ...
    def to_dataframe(self) -> pd.DataFrame: ...

class DriveDiagnosis(_Result): ...

class Benchmark(_Result):
    def to_dataframe(self) -> pd.DataFrame: ...

class Comparison(_Result):
    def to_dataframe(self) -> pd.DataFrame: ...

def cornering_and_drag(fx_n: _Numbers, fy_n: _Numbers,
                       slip_angle_rad: _Numbers) -> tuple[_Array, _Array]: ...
def mechanisms() -> list[dict[str, Any]]: ...
def plan(scenario: _Settings | _File, *, model: _Settings | _File | Wheel | None = ...,
         planner: str | None = ..., seed: int | None = ..., time_s: float | None = ...,
         iterations: int | None = ..., candidates: int | None = ..., improve: bool | None = ...,
         threads: int | None = ..., out: _File | None = ..., force: bool = ...,
         progress: _Progress | None = ...) -> Plan: ...
def evaluate(scenario: _Settings | _File,
             paths: _Table | Candidate | _File | Sequence[_Table | Candidate | _File]
             | Mapping[str, _Table | Candidate | _File] = ..., *,
             manoeuvres: Sequence[_Settings] | _File | None = ...,
             model: _Settings | _File | Wheel | None = ..., speed_mps: float | None = ...,
             deviation_max_m: float | None = ..., follower: str | None = ...,
             draws: int | None = ..., seed: int | None = ..., threads: int | None = ...,
             out: _File | None = ..., force: bool = ...,
             progress: _Progress | None = ...) -> Evaluation: ...
def diagnose(recording: _Table | _File, setup: _Settings | _File, *,
             reference: _Table | _File | Sequence[_Table | _File] = ..., seed: int | None = ...,
             threads: int | None = ..., out: _File | None = ..., force: bool = ...,
             progress: _Progress | None = ...) -> Diagnosis: ...
def drive(scenario: _Settings | _File, path: _Table | Candidate | _File, *,
          follower: str | Callable[[SimpleNamespace], Sequence[float] | Mapping[str, float]] | None = ...,
          truth: _Settings | _File | None = ..., sensors: str | _Settings | _File | None = ...,
          model: _Settings | _File | Wheel | None = ..., deviation_max_m: float | None = ...,
          seed: int | None = ..., out: _File | None = ..., force: bool = ...,
          progress: _Progress | None = ...) -> Drive: ...
def compare(a: _Result | _File, b: _Result | _File, *, out: _File | None = ...,
            force: bool = ...) -> Comparison: ...
def diagnose_drives(drives: _Table | _File | Sequence[_Table | _File],
                    scenario: _Settings | _File, *, setup: _Settings | _File | None = ...,
                    columns: _Settings | _File | None = ..., seed: int | None = ...,
                    threads: int | None = ..., out: _File | None = ..., force: bool = ...,
                    progress: _Progress | None = ...) -> DriveDiagnosis: ...
def benchmark(suite: _Settings | _File, *, shard: str | None = ..., processes: int | None = ...,
              out: _File | None = ..., force: bool = ...,
              progress: _Progress | None = ...) -> Benchmark: ...
