#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "terramech/wheel/wheel_model.h"

/// The domain of a force table and its coordinates, each in [0, 1].
///
///   load     ln(load)
///   slip     sqrt(|1 - q|/(q + bend)) over its end, q = Vx/(r w): braking and driving apart,
///            because the forces have a corner at slip 0, finest on either side of it, and fine
///            next to a locked wheel and to spin on the spot, where the shear along x or y
///            mobilises within a sliver.
///   lateral  ln(1 + g tan|beta|)/ln(1 + g tan 62 deg) with g = 1 + kx1/kx0 + q/K: even in the
///            logarithm over all the slip angles at which something happens, from that at which
///            the shear along y mobilises (tan|beta| = K/q) to that at which kx has grown.
namespace regoplan::force_table {

inline constexpr double kSlipMaxDriving = 0.97, kSlipMaxBraking = 0.92;
inline constexpr double kTanMax = 1.8807264653463320;  // tan(62 deg)
inline constexpr double kDrivingBend = 0.5, kBrakingBend = 3;

/// The slip coordinate without its root, driving or braking.
constexpr double slip_share(double axle, double bend, double end) {
  return (1 - axle) / ((axle + bend) * end);
}
inline constexpr double kDrivingEnd = slip_share(1 - kSlipMaxDriving, kDrivingBend, 1.0);
inline constexpr double kBrakingEnd = slip_share(1 / (1 - kSlipMaxBraking), kBrakingBend, 1.0);

/// By `driving`.
inline constexpr std::array<double, 2> kBend{kBrakingBend, kDrivingBend};
inline constexpr std::array<double, 2> kEnd{kBrakingEnd, kDrivingEnd};
/// Where the wheel model is trusted (WheelStatus), but for the rounding of floats.
constexpr float rounded_up(double value) {
  return static_cast<float>(value * (1 + 2e-7));
}
inline constexpr std::array<float, 2> kTrusted{
    rounded_up(slip_share(10.0, kBrakingBend, kBrakingEnd)),
    rounded_up(slip_share(0.05, kDrivingBend, kDrivingEnd))};
inline constexpr float kTrustedTangent = rounded_up(1.7320508075688772);

struct Axes {
  double load_min_n = 0, load_max_n = 0;
  double lateral_bend = 1;           ///< 1 + kx1/kx0
  double lateral_bend_per_axle = 0;  ///< 1/K
};

/// Velocity ratio Vx/(r w) at a slip coordinate.
inline double axle_at(double t, bool driving) {
  const double ahead = kEnd[driving] * t * t;
  return (1 - ahead * kBend[driving]) / (1 + ahead);
}

/// tan|beta| at a lateral coordinate.
inline double tangent_at(const Axes& axes, double axle, double lateral) {
  const double bend = axes.lateral_bend + axes.lateral_bend_per_axle * axle;
  return std::expm1(lateral * std::log1p(bend * kTanMax)) / bend;
}

inline double load_at(const Axes& axes, double coordinate) {
  return axes.load_min_n * std::pow(axes.load_max_n / axes.load_min_n, coordinate);
}

/// The wheel rolls forward; the faster of rim and axle is 1 m/s.
inline WheelMotion rolling(double axle, double tangent) {
  const double vx = axle < 1 ? axle : 1;
  return {.vx_mps = vx, .vy_mps = vx * tangent, .rim_speed_mps = axle < 1 ? 1 : 1 / axle};
}

}  // namespace regoplan::force_table
