"""The wheel of `wheel.py` with what two series of one rig share and the base model lacks, and with
lugs made of soil mechanics instead of factors.

Lugs do three things here, each with a weight of its own, 0 to leave it out:

- `lug_block`: a share of the soil between lugs is carried round as part of the wheel and shears on
  soil along the circle of the tips (Bekker 1960; Wong, Theory of Ground Vehicles). Lugs across the
  rim hold it round, not sideways: only `lug_side_grip` of it, as where the cells are closed at the
  sides, is held there as well; the rest slides out along the rim.
- `lug_passive`: each lug in the soil pushes a wedge before it. Its factors are those of a vertical
  blade by equilibrium of the wedge, the failure plane being the one that resists least (McKyes
  1985); after `lug_way` heights of a lug two thirds of it resist.
- `lug_carry`: soil that lugs carry backwards is gone before the rim presses it, so that the wheel
  stands deeper with the same pressure.
"""
import numpy as np

from wheel import GRAVITY_MPS2, WheelWithEffects

# A change of the exponent leaves the pressure at this depth as it was.
TYPICAL_DEPTH_M = .012


def wedge_factors(friction_rad):
    """Factors of weight, cohesion and surcharge of a vertical blade, and the cotangent of the plane
    on which the soil before it fails; of the force, the part along the blade's way. The blade's own
    friction is two thirds of the soil's."""
    plane = np.linspace(.15, 1.2, 400)
    wall = 2 / 3 * friction_rad
    # A vertical blade: its rake is a right angle.
    below = -np.sin(wall) + np.cos(wall) / np.tan(plane + friction_rad)
    below = np.where(below > 1e-3, below, np.inf)
    resists = np.where(np.isfinite(below), 1 / np.tan(plane) / below, np.inf)
    least = int(np.argmin(resists))
    cohesion = ((1 + 1 / np.tan(plane[least]) / np.tan(plane[least] + friction_rad))
                / below[least])
    along = np.cos(wall)
    return (along * resists[least] / 2, along * cohesion, along * resists[least],
            1 / np.tan(plane[least]))


class WheelOfPair(WheelWithEffects):
    """`effects` as before, with the ids of this file."""

    def __init__(self, *arguments):
        self.stress_scale = 1
        self.imposed_m = None
        super().__init__(*arguments)

    def _soil_of(self, soil):
        super()._soil_of(soil)
        size = self.size
        self.exponent = soil["n"] + size("other_exponent")
        self.bearing = self.bearing * TYPICAL_DEPTH_M ** -size("other_exponent")
        self.rim_friction = (1 - size("smooth_rim")) * self.rim_friction
        driving = np.clip(self.slip, 0, .95)
        # What is carried backwards grows with the way that slips on each metre driven, and less
        # where the rut is deep enough for soil to flow back.
        slipped = driving / (1 - driving)
        self.carried_off_m = (size("lug_carry") * size("lug_height_m") * slipped / (1 + slipped / 2)
                              + size("slip_excavation") * self.radius_m * driving ** 1.5
                              + np.asarray(size("nameless_excavation_m")))
        # It fills the rut behind.
        self.rear = self.rear + size("lug_carry") * size("lug_height_m") / self.radius_m * driving

    def _carried_off_m(self, at, front):
        # Nothing is gone where the wheel enters, all of it at the lowest point.
        return self.carried_off_m[:, None] * np.clip(1 - at / front, 0, 1)

    def _normal_stress(self, at, front, back):
        stress = super()._normal_stress(at, front, back)
        stress = stress * (1 + self.size("flat_stress")
                           * np.cos(2 * np.pi * (at - back) / (front - back)))
        pressure = self.load_n[:, None] / (self.radius_m[:, None] * self.width_m)
        stress = stress * (1 - self.size("yielding") * stress / (stress + pressure))
        return stress * self.stress_scale

    def _shear(self, at, front, stress):
        along, across, turning = super()._shear(at, front, stress)
        height_m, block = self.size("lug_height_m"), self.size("lug_block")
        if not height_m:
            return along, across, turning
        radius_m = self.radius_m[:, None]
        larger = 1 + height_m / radius_m
        travel_m = radius_m * (larger * (front - at)
                               - self.ratio[:, None] * (np.sin(front) - np.sin(at)))
        strength = larger * (self.cohesion_pa[:, None] + stress * np.tan(self.friction_rad))
        # The soil between two lugs can give way as a block, below and on both sides.
        whole = strength * (1 + 2 * height_m / self.width_m)
        of_block = whole * self._mobilised(travel_m, self.kx_m)
        sideways = strength * self._mobilised(
            radius_m * self.lateral[:, None] * (front - at), self.ky_m)
        wedges = self._wedges_pa(travel_m, stress)
        # Soil before a lug never resists more than the block that it is a part of.
        wedges = np.clip(along + wedges, -whole, whole) - along
        loose, held = 1 - block, block * self.size("lug_side_grip")
        return (loose * (along + wedges) + block * of_block,
                (1 - held) * across + held * sideways,
                loose * (turning + wedges * (1 + height_m / (2 * radius_m)))
                + block * of_block * larger)

    def _wedges_pa(self, travel_m, stress):
        """Passive pressure on the lugs, spread over the rim. Where lugs stand closer than the wedge
        is long, each has only the soil up to the next one."""
        height_m = self.size("lug_height_m")
        weight, cohesion, surcharge, length = wedge_factors(self.friction_rad)
        spacing_m = 2 * np.pi * self.radius_m[:, None] / self.size("lug_count")
        room = np.minimum(1, spacing_m / (height_m * length))
        lug_npm = room * height_m * (weight * self.density * GRAVITY_MPS2 * height_m
                                     + cohesion * self.cohesion_pa[:, None]
                                     + surcharge * self.size("lug_confined") * stress)
        mobilised = np.sign(travel_m) * (
            1 - np.exp(-np.abs(travel_m) / (self.size("lug_way") * height_m)))
        return self.size("lug_passive") * mobilised * lug_npm / spacing_m

    def impose(self, sinkage_m):
        """Stands at this sinkage; pressure is scaled so that it carries the load."""
        self.stress_scale = 0
        of_cohesion_n = self._lift_n(sinkage_m)
        self.stress_scale = 1
        scale = (self.load_n - of_cohesion_n) / (self._lift_n(sinkage_m) - of_cohesion_n)
        self.stress_scale, self.imposed_m = scale[:, None], sinkage_m

    def sinkage_m(self):
        return super().sinkage_m() if self.imposed_m is None else self.imposed_m

    def channels(self):
        fx_n, fy_n, torque_nm, sinkage_m = super().channels()
        # A heap beside the wheel leans on the buried part of its flank.
        share = np.clip(1 - sinkage_m / self.radius_m, -1, 1)
        flank_m2 = self.radius_m ** 2 * (np.arccos(share) - share * np.sqrt(1 - share ** 2))
        leaning = np.tan(self.angle) / (.3 + np.tan(self.angle))
        fy_n = fy_n + (np.sign(self.runs.slip_angle_rad) * self.size("side_surcharge_pa")
                       * leaning * flank_m2)
        return fx_n, fy_n, torque_nm, sinkage_m
