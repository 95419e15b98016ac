#pragma once

#include <cstddef>

/// The domain of a force table and its coordinates, for numbers and vectors alike.
namespace regoplan::force_table_axes {

inline constexpr double kSlipMaxDriving = 0.97, kSlipMaxBraking = 0.92;
inline constexpr double kTanMax = 1.8807264653463320;  // tan(62 deg)
inline constexpr std::size_t kPowers = 4;              // of v, in which Fx is a polynomial

/// Close to the slip angle, for coordinates: within a milliradian, 0 at 0, and cheaper than atan2.
template <class Number>
struct NearlyAngle {
  Number rad, by_b, by_c;
};
template <class Number>
[[gnu::always_inline]] inline NearlyAngle<Number> nearly_angle(Number b, Number c) {
  const Number whole = 1.0 / (b + c);
  const Number h = (c - b) * whole;  // tan(angle - 45 deg)
  const Number h2 = h * h;
  constexpr double k1 = 0.995354, k3 = -0.288679, k5 = 0.079331;
  const Number slope = k1 + h2 * (3 * k3 + h2 * (5 * k5));
  return {.rad = (k1 + k3 + k5) + h * (k1 + h2 * (k3 + h2 * k5)),
          .by_b = -slope * 2.0 * c * whole * whole,
          .by_c = slope * 2.0 * b * whole * whole};
}

/// The slip axis is t = sqrt(share): close to slip 0 the forces bend on either side of it, and
/// close to a locked wheel the shear grows within a sliver. Driving, the share is slip over its
/// end; braking, it is (q - 1)/(q + 3) with q = Vx/(r w), over its end.
inline constexpr double kBrakingBend = 3;
inline constexpr double kBrakingEnd =
    kSlipMaxBraking / (1 + kBrakingBend - kBrakingBend * kSlipMaxBraking);

}  // namespace regoplan::force_table_axes
