"""A rigid wheel on soil, with effects that the base model leaves out, in numpy: midpoint rule and
bisection over whole arrays of runs. Shares neither code nor forms with `terramech` and with the other
generator of this folder; without an effect it is the model `ishigami2007` of the reference.

Forms are this file's own: weaker bearing where the wheel slips, in place of added sinkage; a shear
law with a rational drop behind its peak; a wedge half as strong again; and so on.
"""
import dataclasses

import numpy as np

GRAVITY_MPS2 = 9.80665
STRIPS = 90
DEGREE = np.pi / 180


@dataclasses.dataclass
class Runs:
    """Arrays of one value a run; angles in radians."""
    load_n: np.ndarray
    slip_ratio: np.ndarray
    slip_angle_rad: np.ndarray
    speed_mps: np.ndarray
    wheel_pass: np.ndarray
    position_m: np.ndarray
    time_s: np.ndarray


def velocity_ratio(slip_ratio):
    return np.where(slip_ratio >= 0, 1 - slip_ratio, 1 / (1 + slip_ratio))


def slip_of(ratio):
    return np.where(ratio <= 1, 1 - ratio, 1 / np.maximum(ratio, 1e-9) - 1)


class WheelWithEffects:
    """Forces and sinkage of runs. `effects` maps ids to sizes; a size of 0 is no effect."""

    def __init__(self, radius_m, width_m, soil, runs, effects):
        self.width_m, self.runs, self.effects = width_m, runs, effects
        size = self.size
        slip = runs.slip_ratio
        if size("slip_scale"):
            slip = slip_of(velocity_ratio(slip) / (1 + size("slip_scale")))
        self.slip, self.ratio = slip, velocity_ratio(slip)
        self.angle = np.abs(runs.slip_angle_rad)
        self.lateral = self.ratio * np.tan(self.angle)
        self.load_n = runs.load_n * (1 + size("load_transfer"))
        relative_load = runs.load_n / runs.load_n.mean()
        self.radius_m = radius_m * (1 + size("flexible_wheel") * relative_load)
        self._soil_of(soil)

    def size(self, effect):
        return self.effects.get(effect, 0)

    def _soil_of(self, soil):
        """The soil's numbers, run by run, as effects change them."""
        size, runs, angle = self.size, self.runs, self.angle
        driving, skid = np.maximum(self.slip, 0), np.maximum(-self.slip, 0)
        sideways = np.sin(angle)
        again = np.sqrt(runs.wheel_pass - 1)
        zone = self._share_in_zone()
        in_time = (runs.time_s / runs.time_s.max()) ** .8
        self.bearing = ((soil["kc"] / self.width_m + soil["kphi"])
                        * np.exp(-size("slip_sinkage") * driving ** 1.3
                                 - size("lateral_digging") * sideways ** 1.2
                                 - size("skid_branch") * skid)
                        * (1 + size("multi_pass") * again)
                        * (1 + size("rate_dependence") * np.log1p(runs.speed_mps / .02))
                        * (1 - size("soil_zone") * zone))
        self.cohesion_pa = (soil["cohesion_pa"] * (1 + .4 * size("multi_pass") * again)
                            * (1 - .8 * size("soil_zone") * zone)
                            * np.clip(1 - size("cohesion_drift") * in_time, .02, None))
        self.friction_rad = soil["friction_angle_deg"] * DEGREE
        self.rim_friction = np.tan(self.friction_rad)
        self.exponent, self.density = soil["n"], soil["density_kgpm3"]
        self.rear = soil["lambda"] + size("rear_contact") * driving * (1 - .3 * driving)
        self.peak = np.clip(soil["a0"] + soil["a1"] * self.slip
                            + size("max_stress_angle") * angle ** 1.5, .05, .95)
        stretch = size("shear_modulus_slip_angle") * sideways ** 1.5
        self.kx_m = ((soil["kx0_m"] + soil["kx1_m"] * angle + stretch)
                     * (1 + size("skid_branch") * skid))
        self.ky_m = soil["ky0_m"] + soil["ky1_m"] * angle + .7 * stretch

    def _share_in_zone(self):
        """Of a zone from .8 to 1.8 m whose edges are ramps of .15 m."""
        at_m, ramp_m = self.runs.position_m, .15
        return (np.clip((at_m - .8) / ramp_m + .5, 0, 1)
                * np.clip((1.8 - at_m) / ramp_m + .5, 0, 1))

    def _contact(self, sinkage_m):
        """Angles of strips along the contact and their width, shape (runs, strips)."""
        radius = self.radius_m
        front = np.arccos(np.clip(1 - sinkage_m / radius, -1, 1))[:, None]
        back = -np.arccos(np.clip(1 - self.rear * sinkage_m / radius, -1, 1))[:, None]
        along = (np.arange(STRIPS) + .5) / STRIPS
        return back + (front - back) * along, front, back, (front - back) / STRIPS

    def _normal_stress(self, at, front, back):
        peak = self.peak[:, None] * front
        mirrored = front - (at - back) / np.maximum(peak - back, 1e-9) * (front - peak)
        where = np.where(at >= peak, at, mirrored)
        depth = np.maximum(np.cos(where) - np.cos(front)
                           - self._carried_off_m(where, front) / self.radius_m[:, None], 0)
        stress = (self.radius_m ** self.exponent * self.bearing)[:, None] * depth ** self.exponent
        below_m = np.maximum(self.radius_m[:, None] * depth - .01, 0)
        return stress * (1 + self.size("layered_soil") * below_m / (below_m + .01))

    def _carried_off_m(self, _at, _front):
        """Soil that is gone before the wheel presses it, for wheels that carry some away."""
        return 0

    def _mobilised(self, travel_m, modulus_m):
        share = 1 - np.exp(-np.abs(travel_m) / modulus_m[:, None])
        far = np.abs(travel_m) / (3 * modulus_m[:, None])
        return np.sign(travel_m) * share * (1 - self.size("shear_hump") * far ** 2 / (1 + far ** 2))

    def _shear(self, at, front, stress):
        """Stress along the rim, across it, and the one that turns the wheel by its radius."""
        lugs = self.size("grousers")
        radius, ratio = self.radius_m[:, None], self.ratio[:, None]
        limit = (self.cohesion_pa[:, None] * (1 + 6 * lugs)
                 + stress * self.rim_friction * (1 + 1.2 * lugs))
        along = self._mobilised(
            radius * (front - at - ratio * (np.sin(front) - np.sin(at))) * (1 + 4 * lugs),
            self.kx_m)
        across = self._mobilised(radius * self.lateral[:, None] * (front - at), self.ky_m)
        together = np.hypot(along, across)
        cut = 1 - self.size("coupled_shear") * (1 - 1 / np.maximum(together, 1))
        return limit * along * cut, limit * across * cut, limit * along * cut

    def _lift_n(self, sinkage_m):
        at, front, back, width = self._contact(sinkage_m)
        stress = self._normal_stress(at, front, back)
        along, _, _ = self._shear(at, front, stress)
        return (self.radius_m * self.width_m
                * ((along * np.sin(at) + stress * np.cos(at)) * width).sum(1))

    def sinkage_m(self):
        """The smallest at which the soil carries the load."""
        shares = np.linspace(.001, .95, 120)
        first = np.full(len(self.load_n), shares[-1])
        for share in shares[::-1]:
            first = np.where(self._lift_n(share * self.radius_m) >= self.load_n, share, first)
        high = first * self.radius_m
        low = np.maximum(high - (shares[1] - shares[0]) * self.radius_m, 1e-6)
        for _ in range(40):
            middle = (low + high) / 2
            carries = self._lift_n(middle) >= self.load_n
            high, low = np.where(carries, middle, high), np.where(carries, low, middle)
        return high

    def _bulldozing_n(self, at, front, back, width):
        complement = np.pi / 4 - self.friction_rad / 2
        wall = 1 / np.tan(complement)
        linear = wall + np.tan(complement + self.friction_rad)
        square = wall + wall ** 2 * np.tan(self.friction_rad)
        radius = self.radius_m[:, None]
        depth = np.maximum(radius * (np.cos(at) - np.cos(front)), 0)
        heaped = depth * (1 + self.size("side_pileup") * np.sin(2 * self.angle)[:, None])
        wedge = linear * (self.cohesion_pa[:, None] * heaped
                          + square * self.density * GRAVITY_MPS2 * heaped ** 2 / 2)
        swept = self.radius_m * self.lateral * (front - back)[:, 0]
        return ((1 - np.exp(-swept / self.ky_m))
                * (wedge * (radius - depth * np.cos(at)) * width).sum(1))

    def channels(self):
        """Drawbar pull and side force (opposing), N; torque, N m; sinkage, m."""
        size, load_n = self.size, self.load_n
        sinkage_m = self.sinkage_m()
        at, front, back, width = self._contact(sinkage_m)
        stress = self._normal_stress(at, front, back)
        along, across, turning = self._shear(at, front, stress)
        area = self.radius_m * self.width_m
        fx_n = area * ((along * np.cos(at) - stress * np.sin(at)) * width).sum(1)
        fy_n = (np.sign(self.runs.slip_angle_rad)
                * (area * (across * width).sum(1) + self._bulldozing_n(at, front, back, width)))
        torque_nm = self.radius_m * area * (turning * width).sum(1)

        driving = np.maximum(self.slip, 0)
        passive = np.tan(np.pi / 4 + self.friction_rad / 2) ** 2
        weight = self.density * GRAVITY_MPS2
        fx_n = fx_n - (size("front_bulldozing") * self.width_m * (1 + .5 * driving)
                       * (.8 * weight * sinkage_m ** 2 * passive
                          + 2 * self.cohesion_pa * sinkage_m * np.sqrt(passive)))
        fx_n = fx_n - size("flank_friction") * np.abs(fy_n) * np.cos(self.angle)
        fx_n = fx_n - load_n * np.sin(size("slope_tilt"))
        flank_m2 = self.radius_m ** 2 * (front - np.sin(front) * np.cos(front))[:, 0]
        torque_nm = torque_nm + (size("sidewall_shear") * 2 * self.radius_m * flank_m2
                                 * (self.cohesion_pa + .3 * weight * sinkage_m))
        torque_nm = torque_nm + (size("bearing_drag") * self.radius_m * load_n.mean()
                                 * (.6 + .4 * np.sqrt(load_n / load_n.mean())))
        fx_n = fx_n + size("dip in slip") * (np.abs(self.slip - .35) < .12) * load_n
        fy_n = fy_n + (size("swing with slip") * load_n * np.sin(2 * np.pi * self.slip / .5)
                       * np.sin(self.angle))
        sinkage_m = sinkage_m * (1 + size("ripples") * np.sin(5 * self.angle) * np.sin(6 * self.slip))
        relative_load = load_n / load_n.mean() - 1
        torque_nm = torque_nm + (size("bent in load") * (relative_load ** 2 - .1) * load_n
                                 * self.radius_m)
        sinkage_m = sinkage_m + .5 * size("grousers") * self.radius_m * driving
        return fx_n, fy_n, torque_nm, sinkage_m
