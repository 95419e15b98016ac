"""A map of safe speed: how fast an LRV may take a turn of 15 m radius across each slope of a terrain.

The margins depend on the ground's slope alone, so they are solved on a grid of slopes and speeds
and looked up for every cell.
"""

import numpy as np
import regoplan

CELL_M, RADIUS_M, MARGIN_MIN = 1.0, 15.0, 0.05

y, x = np.mgrid[0:100, 0:100] * CELL_M
height_m = 1.2 * np.sin(x / 9) * np.cos(y / 13) + 4 * np.exp(-((x - 60) ** 2 + (y - 40) ** 2) / 200)
down_m, east_m = np.gradient(height_m, CELL_M)
slope_rad = np.arctan(np.hypot(down_m, east_m))

lrv = regoplan.VehicleOnSoil("lrv", regoplan.Soil.preset("loose_regolith"), 1.62, method="fast")
slopes = np.radians(np.arange(0, 31, 1.0))
speeds = np.linspace(0.25, 5, 20)
# A turn uphill and one downhill: both must be safe, at that speed and all lower ones.
worst = np.minimum(*(np.nan_to_num(lrv.margins(speeds[:, None], side / RADIUS_M,
                                               slope_left_rad=slopes).margin, nan=-1)
                     for side in (1, -1)))
safe = np.logical_and.accumulate(worst >= MARGIN_MIN)
fastest_mps = np.where(safe, speeds[:, None], 0).max(axis=0)
speed_map_mps = np.interp(slope_rad, slopes, fastest_mps)

print(f"slopes up to {np.degrees(slope_rad.max()):.0f} deg; safe speed in a turn of {RADIUS_M} m: "
      f"{speed_map_mps.min():.1f} to {speed_map_mps.max():.1f} m/s, median "
      f"{np.median(speed_map_mps):.1f} m/s")
assert 1 < fastest_mps[0] < 4 and fastest_mps[0] > fastest_mps[20]
assert np.all(np.isfinite(speed_map_mps))
