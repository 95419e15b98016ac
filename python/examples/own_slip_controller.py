"""A slip controller of one's own, driven over soil that is weaker than planned.

It steers back to the path within some metres, and turns its rims faster by a share that grows with
the speed that the vehicle lacks.
"""

import numpy as np
import regoplan

SCENARIO = {
    "map": {"terrain": {"width_m": 60, "height_m": 40, "roughness_m": 0.02},
            "soils": {"classes": {1: "mare"},
                      "soils": {"mare": regoplan.Soil.preset("firm_regolith").to_dict()}}},
    "vehicle": "lrv", "gravity_mps2": 1.62,
    "start": {"x_m": 8, "y_m": 20, "heading_deg": 0}, "goal": {"x_m": 50, "y_m": 20, "radius_m": 1},
}
x_m = np.linspace(8, 50, 43)
PATH = {"x_m": x_m, "y_m": 20 + 2 * np.sin((x_m - 8) / 42 * 2 * np.pi),
        "speed_mps": np.where((x_m > 8) & (x_m < 50), 1.2, 0)}
TRUTH = {"soils": {"mare": {"kphi": 2.5e5, "friction_angle_deg": 28}}}


class SlipController:
    """Rim speed for the speed of the path, and curvature back to it within `reach_m`."""

    def __init__(self, gain_per_m=0.5, reach_m=5.0):
        self.gain_per_m, self.reach_m = gain_per_m, reach_m
        self.excess, self.s_m = 0.0, 0.0

    def __call__(self, view):
        way_m, self.s_m = view.s_m - self.s_m, view.s_m
        lacking = view.path_speed_mps - view.forward_mps
        self.excess = float(np.clip(self.excess + self.gain_per_m * way_m * lacking, 0, 0.5))
        turn = (view.path_curvature_1pm - view.offset_m / self.reach_m**2
                - 2 * view.heading_error_rad / self.reach_m)
        return view.path_speed_mps * (1 + self.excess), float(np.clip(turn, -0.3, 0.3))


driven = {name: regoplan.drive(SCENARIO, PATH, follower=follower, truth=TRUTH)
          for name, follower in {"own": SlipController(), "pursuit": "pursuit"}.items()}
for name, drive in driven.items():
    print(f"{name}: {drive.status}, {drive.duration_s:.1f} s, cross-track "
          f"{drive.cross_track_rms_m:.3f} m rms, {drive.cross_track_max_m:.3f} m at most")
assert driven["own"].status == "reached" and driven["own"].cross_track_max_m < 0.5
