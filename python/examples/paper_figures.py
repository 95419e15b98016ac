"""The curves of Figs. 6 and 7 of Yoshida & Ishigami (2004): side force over slip, and side force
against drawbar pull, at slip angles of 4 to 16 degrees."""

import numpy as np
import regoplan

LOAD_N = 64.7

wheel = regoplan.Wheel.of_paper()
slip = np.linspace(0, 1, 101)
angle_deg = np.array([4, 8, 12, 16])
forces = wheel.forces(LOAD_N, slip, np.radians(angle_deg)[:, None])

print("slip angle   largest Fy at slip   largest Fx at slip   Fx at slip 1 over the largest")
for i, angle in enumerate(angle_deg):
    side, pull = forces.fy_n[i], forces.fx_n[i]
    print(f"{angle:7d} deg {side.max():10.1f} N {slip[side.argmax()]:5.2f}"
          f" {pull.max():12.1f} N {slip[pull.argmax()]:5.2f} {pull[-1] / pull.max():15.2f}")

# What the paper says of its figures.
assert np.all(np.diff(forces.fy_n[:, 1:-1], axis=0) > 0)  # Fy rises with the slip angle
assert np.all((slip[forces.fy_n.argmax(axis=1)] > 0.2) & (slip[forces.fy_n.argmax(axis=1)] < 0.35))
np.testing.assert_allclose(forces.fy_n[:, -1], 0, atol=1e-9)  # no side force at full slip
assert np.all(forces.fx_n[:, -1] > 0)

try:
    import matplotlib
except ImportError:
    print("no matplotlib: no picture")
else:
    matplotlib.use("svg")
    from matplotlib import pyplot

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4))
    for i, angle in enumerate(angle_deg):
        left.plot(slip, forces.fy_n[i], label=f"{angle} deg")
        right.plot(forces.fx_n[i], forces.fy_n[i], label=f"{angle} deg")
    left.set(xlabel="slip ratio", ylabel="Fy, N", title="Fig. 6")
    right.set(xlabel="Fx, N", ylabel="Fy, N", title="Fig. 7")
    left.legend()
    figure.savefig("paper_figures.svg")
    print("paper_figures.svg")
