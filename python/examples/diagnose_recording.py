"""A recording of a single-wheel test, made here with a wheel whose sinkage grows with slip, and
diagnosed with the base model: what physics was left out?"""

import numpy as np
import regoplan

soil = regoplan.Soil.preset("simulant_2004").replace(
    kc=1370, kphi=8.14e5, lambda_=0.9, kx0_m=0.036, kx1_m=0.043, ky0_m=0.013, ky1_m=0.020, c0_m=0)
truth = regoplan.Wheel(0.09, 0.10, soil, mechanisms=[{"id": "slip_sinkage"}])

# Six slips, three slip angles, three replicates, noise of one per cent of the load.
slip, angle_deg, _ = (grid.ravel() for grid in np.meshgrid(
    np.linspace(-0.2, 0.8, 6), [0.0, 8.0, 16.0], range(3), indexing="ij"))
random = np.random.default_rng(1)
forces = truth.forces(60, slip, np.radians(angle_deg))
recording = {"run_id": np.arange(len(slip)), "load_n": np.full(len(slip), 60.0),
             "slip_ratio": slip, "slip_angle_deg": angle_deg}
for channel, noise in {"fx_n": 0.6, "fy_n": 0.6, "torque_nm": 0.06, "sinkage_m": 3e-4}.items():
    recording[channel] = getattr(forces, channel) + random.normal(0, noise, len(slip))

prior = {**soil.model_keys(), "cohesion_pa": {"mean": 800, "std": 120},
         "friction_angle_deg": {"mean": 37.2, "std": 1.0}, "kphi": {"mean": 8.14e5, "std": 8e4}}
found = regoplan.diagnose(recording, {
    "model": "ishigami2007", "wheel": {"radius_m": 0.09, "width_m": 0.10},
    "gravity_mps2": 9.80665, "soil": prior})

print(found)
print(found.sentence)
for entry in found.ranking[:3]:
    print(f"  {entry['id']}: {entry['probability']:.3f}")
corrected = found.corrected_wheel()
print(f"sinkage at slip 0.8: measured {recording['sinkage_m'][slip == 0.8].mean():.4f} m, corrected "
      f"model {corrected.forces(60, 0.8, 0).sinkage_m:.4f} m")
assert found.verdict != "consistent"
