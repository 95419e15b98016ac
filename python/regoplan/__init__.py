"""Motion-planning feasibility of wheeled vehicles on loose soil: arrays in, arrays out.

Names, units and frames are those of regoplan's files and documents: SI, angles in degrees where a
key of a file says so, in radians in functions over arrays (``slip_angle_rad``). Wheel frame: x along
the heading, y left, z up along the soil's normal. Nothing is global: objects are immutable, and the
same input gives the same bits, whatever the number of threads.
"""

from ._errors import InputError
from ._soil import Soil
from ._vehicle import Margins, Vehicle, VehicleOnSoil
from ._wheel import STATUS, Wheel, WheelForces, cornering_and_drag, mechanisms

__all__ = ["InputError", "Margins", "STATUS", "Soil", "Vehicle", "VehicleOnSoil", "Wheel",
           "WheelForces", "cornering_and_drag", "mechanisms"]
