"""Motion-planning feasibility of wheeled vehicles on loose soil: arrays in, arrays out.

Names, units and frames are those of regoplan's files and documents: SI, angles in degrees where a
key of a file says so, in radians in functions over arrays (``slip_angle_rad``). Wheel frame: x along
the heading, y left, z up along the soil's normal. Nothing is global: objects are immutable, and the
same input gives the same bits, whatever the number of threads.
"""

from ._errors import InputError
from ._soil import Soil
from ._vehicle import Margins, SafeCurvature, Vehicle, VehicleOnSoil
from ._wheel import STATUS, Wheel, WheelForces, cornering_and_drag, mechanisms

# What needs the program's commands is loaded with their first use.
_LATER = {"plan": "_commands", "evaluate": "_commands", "drive": "_commands",
          "diagnose": "_commands", "diagnose_drives": "_commands", "benchmark": "_commands",
          "compare": "_commands", "Comparison": "_results",
          "TerrainMap": "_maps", "Plan": "_results", "Candidate": "_results",
          "Evaluation": "_results", "Drive": "_results", "Diagnosis": "_results",
          "DriveDiagnosis": "_results", "Benchmark": "_results", "ProgramError": "_program"}

__all__ = ["InputError", "Margins", "STATUS", "SafeCurvature", "Soil", "Vehicle", "VehicleOnSoil",
           "Wheel", "WheelForces", "cornering_and_drag", "mechanisms", *_LATER]


def __getattr__(name):
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(f".{_LATER[name]}", __name__), name)


def __dir__():
    return __all__
