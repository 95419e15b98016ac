#include "terramech/wheel/mechanism_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "terramech/basics/angles.h"
#include "terramech/basics/graded_nodes.h"
#include "terramech/basics/vector_clones.h"
#include "terramech/basics/vector_math.h"

namespace regoplan::wheel_contact {
namespace {

using vector_math::Vec;

[[gnu::always_inline]] inline Vec root(Vec v) {
  Vec root;
  for (std::size_t lane = 0; lane < vector_math::kLanes; ++lane) root[lane] = std::sqrt(v[lane]);
  return root;
}

[[gnu::always_inline]] inline Vec length(Vec x, Vec y) {
  constexpr double kNothing = 1e-200;  // so that nothing over its length is nothing
  return root(x * x + y * y + kNothing);
}

[[gnu::always_inline]] inline Vec mobilised(Vec j) {
  return 1.0 - vector_math::exp(-j);
}

/// Wong's hump, as a share of the peak that it reaches at j = k.
[[gnu::always_inline]] inline Vec hump(Vec j_over_k, double residual) {
  constexpr double kAtPeak = 1 - 1 / std::numbers::e;
  return (residual + (1 / kAtPeak - residual) * vector_math::exp(1.0 - j_over_k)) *
         mobilised(j_over_k);
}

/// Shear mobilised as in the base model on soil that loses strength beyond some displacement.
[[gnu::always_inline]] inline Vec softened(Vec j_over_k, double residual, double softening) {
  const Vec lost = j_over_k / softening;
  return mobilised(j_over_k) * (residual + (1 - residual) * vector_math::exp(-lost * lost));
}

/// Mobilised shares of the shear limit along x and y (y: opposing the lateral motion).
struct Shares {
  Vec x, y;
};

/// \param jx, jy displacement over shear modulus, \param vx, vy slip velocity over rim speed
[[gnu::always_inline]] inline Shares shares(const StressLaw& law, Vec jx, Vec jy, Vec vx, Vec vy) {
  switch (law.shear) {
    case ShearLaw::kSeparate:
      return {vector_math::with_sign(mobilised(vector_math::abs(jx)), jx), mobilised(jy)};
    case ShearLaw::kHump:
      return {vector_math::with_sign(hump(vector_math::abs(jx), law.residual), jx),
              hump(jy, law.residual)};
    case ShearLaw::kSoftening:
      return {
          vector_math::with_sign(softened(vector_math::abs(jx), law.residual, law.softening), jx),
          softened(jy, law.residual, law.softening)};
    case ShearLaw::kWithinLimit: {
      const Vec ex = vector_math::with_sign(mobilised(vector_math::abs(jx)), jx);
      const Vec ey = mobilised(jy), a = ex * ex, b = ey * ey, least = a < b ? a : b;
      // (a + b)^2 - max(a, b)^2: nothing where one of the shares is
      const Vec cut = root(root(1.0 + law.coupling * (2.0 * a * b + least * least)));
      return {ex / cut, ey / cut};
    }
    case ShearLaw::kAlongDisplacement: {
      const Vec j = length(jx, jy), share = mobilised(j) / j;
      return {share * jx, share * jy};
    }
    case ShearLaw::kAlongSlipVelocity: {
      const Vec share = mobilised(length(jx, jy)) / length(vx, vy);
      return {share * vx, share * vy};
    }
  }
  return {Vec{}, Vec{}};
}

/// Normal stress at Q = 1 where cos(theta) exceeds cos(theta_f) by `rise`, eq. (4), on layers.
[[gnu::always_inline]] inline Vec normal_stress_pa(const Ground& ground, const Layering& layering,
                                                   Vec rise) {
  constexpr double kNone = 1e-300;
  const Vec above = rise < kNone ? Vec{} + kNone : rise;
  const Vec one_layer =
      ground.soil.n == 1
          ? ground.stress_scale_pa * above
          : ground.stress_scale_pa * vector_math::exp(ground.soil.n * vector_math::log(above));
  if (layering.kind == Layering::Kind::kNone) return one_layer;
  const Vec depths = above * (ground.wheel.radius_m / layering.depth_m);
  return layering.kind == Layering::Kind::kHardBelow
             ? one_layer * (1.0 + (layering.ratio - 1) * mobilised(depths * depths))
             : one_layer + layering.crust_pa * depths * vector_math::exp(1.0 - depths);
}

/// A part of the contact, in arcs from the entry; its nodes are graded towards the end of the
/// contact on its side of theta_m.
struct Part {
  double from_rad, to_rad;
  bool front;
};

struct Parts {
  std::array<Part, 4> part;
  std::size_t count = 0;
};

/// Arcs from the entry to where a wheel that brakes has dragged the soil back to where it was,
/// jx = 0, and, where the contact reaches far behind, forward again; the whole arc where it has
/// not.
std::array<double, 2> back_again_rad(const Contact& contact, const Ratios& ratios, double whole) {
  if (!(ratios.axle > ratios.rim && ratios.axle * contact.cos_f < ratios.rim)) {
    return {whole, whole};
  }
  // Newton's method: jx is concave on the way to the bottom and convex behind
  const auto zero = [&](double d, double direction) {
    for (int i = 0; i < 20; ++i) {
      const double theta = contact.theta_f_rad - d;
      const double jx = ratios.rim * d - ratios.axle * (contact.sin_f - std::sin(theta));
      const double slope = ratios.rim - ratios.axle * std::cos(theta);
      if (!(slope * direction > 0)) return whole;
      const double step = jx / slope;
      d -= step;
      if (std::abs(step) < 1e-6) return std::clamp(d, 0.0, whole);
    }
    return whole;
  };
  return {zero(contact.theta_f_rad, -1), zero(whole, 1)};
}

/// Split at theta_m and where the law has a corner: jx = 0, or, for stress along the slip velocity,
/// where that turns over, 1 = q cos(theta).
Parts parts_of(const Contact& contact, const Ratios& ratios, ShearLaw shear) {
  const double middle = contact.theta_f_rad - contact.theta_m_rad;
  const double whole = contact.theta_f_rad - contact.theta_r_rad;
  std::array<double, 5> cuts{0, middle, whole, whole, whole};
  if (shear != ShearLaw::kAlongSlipVelocity) {
    const auto zeros = back_again_rad(contact, ratios, whole);
    cuts[3] = zeros[0];
    cuts[4] = zeros[1];
  } else if (ratios.axle > ratios.rim) {
    const double turns_rad = std::acos(ratios.rim / ratios.axle);
    cuts[3] = std::clamp(contact.theta_f_rad - turns_rad, 0.0, whole);
    cuts[4] = std::clamp(contact.theta_f_rad + turns_rad, 0.0, whole);
  }
  std::sort(cuts.begin(), cuts.end());
  Parts parts;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] > cuts[i]) {
      parts.part[parts.count++] = {cuts[i], cuts[i + 1], cuts[i + 1] <= middle};
    }
  }
  return parts;
}

struct Sums {
  Vec cohesion_x{}, cohesion_y{}, cohesion_z{}, cohesion_t{};
  Vec stress_x{}, stress_y{}, stress_z{}, stress_t{};
};

/// \tparam kNodes of each part
template <std::size_t kNodes>
[[gnu::always_inline]] inline LawIntegrals integrate_parts(const Ground& ground, const Contact& at,
                                                           const Ratios& ratios,
                                                           const StressLaw& law,
                                                           const Parts& parts) {
  const GradedNodes<kNodes, Vec>& nodes = graded_nodes<kNodes, Vec>();
  const double r = ground.wheel.radius_m;
  const double kx = ground.soil.kx0_m + ground.soil.kx1_m * ratios.beta_abs_rad;
  const double ky = ground.soil.ky0_m + ground.soil.ky1_m * ratios.beta_abs_rad;
  const double rim = ratios.rim * r / kx, axle = ratios.axle * r / kx;
  const double lateral = ratios.lateral * r / ky;
  const double front_arc = at.theta_f_rad - at.theta_m_rad;
  const double rear_arc = at.theta_m_rad - at.theta_r_rad;
  const double whole_arc = front_arc + rear_arc;
  Sums sums;
  for (std::size_t p = 0; p < parts.count; ++p) {
    const Part& part = parts.part[p];
    const double width = part.to_rad - part.from_rad;
    for (std::size_t i = 0; i < nodes.kVectors; ++i) {
      const Vec weight = width * nodes.weight[i];
      const Vec d = part.front ? part.from_rad + width * nodes.t3[i]
                               : part.to_rad - width * nodes.t3[i];  // theta_f - theta
      const auto down = vector_math::turn(d);
      const Vec advance = at.sin_f * down.versin + at.cos_f * down.sin;  // sin theta_f - sin theta
      const Vec fall = at.sin_f * down.sin - at.cos_f * down.versin;     // cos theta - cos theta_f
      const Vec sin_theta = at.sin_f - advance, cos_theta = at.cos_f + fall;
      Vec rise = fall;
      if (!part.front) {  // eq. (5): theta* mirrors the rear into the front
        const auto mirrored = vector_math::turn((whole_arc - d) * (front_arc / rear_arc));
        rise = at.sin_f * mirrored.sin - at.cos_f * mirrored.versin;
      }
      const Vec sigma = weight * normal_stress_pa(ground, law.layering, rise);
      const Shares share = shares(law, rim * d - axle * advance, lateral * d,
                                  ratios.rim - ratios.axle * cos_theta, Vec{} + ratios.lateral);
      const Vec cohesive = weight * share.x;
      sums.cohesion_x += cohesive * cos_theta;
      sums.cohesion_z += cohesive * sin_theta;
      sums.cohesion_t += cohesive;
      sums.cohesion_y += weight * share.y;
      const Vec frictional = sigma * (ground.tan_phi * share.x);
      sums.stress_x += frictional * cos_theta - sigma * sin_theta;
      sums.stress_z += frictional * sin_theta + sigma * cos_theta;
      sums.stress_t += frictional;
      sums.stress_y += sigma * (ground.tan_phi * share.y);
    }
  }
  const double area = r * ground.wheel.width_m;
  const double c = ground.soil.cohesion_pa * area;
  using vector_math::sum;
  return {.plane = {.cohesion = {.fx_n = c * sum(sums.cohesion_x),
                                 .fz_n = c * sum(sums.cohesion_z),
                                 .torque_nm = c * r * sum(sums.cohesion_t)},
                    .stress = {.fx_n = area * sum(sums.stress_x),
                               .fz_n = area * sum(sums.stress_z),
                               .torque_nm = area * r * sum(sums.stress_t)}},
          .fu_cohesion_n = c * sum(sums.cohesion_y),
          .fu_stress_n = area * sum(sums.stress_y)};
}

REGOPLAN_VECTOR_CLONES LawIntegrals integrate_parts_16(const Ground& ground, const Contact& contact,
                                                       const Ratios& ratios, const StressLaw& law,
                                                       const Parts& parts) {
  return integrate_parts<16>(ground, contact, ratios, law, parts);
}
REGOPLAN_VECTOR_CLONES LawIntegrals integrate_parts_20(const Ground& ground, const Contact& contact,
                                                       const Ratios& ratios, const StressLaw& law,
                                                       const Parts& parts) {
  return integrate_parts<20>(ground, contact, ratios, law, parts);
}

}  // namespace

LawIntegrals integrate_with_law(const Ground& ground, const Contact& contact, const Ratios& ratios,
                                const StressLaw& law, WheelAccuracy accuracy) {
  const Parts parts = parts_of(contact, ratios, law.shear);
  return accuracy == WheelAccuracy::kFast ? integrate_parts_16(ground, contact, ratios, law, parts)
                                          : integrate_parts_20(ground, contact, ratios, law, parts);
}

std::optional<double> entry_angle_with_law(const Ground& ground, double load_n,
                                           const Ratios& ratios, const StressLaw& law,
                                           WheelAccuracy accuracy, double guess_rad) {
  constexpr double kShallowest = 1e-6;
  const auto fz_n = [&](double theta_f_rad) {
    const Contact contact = contact_at(ground, theta_f_rad, ratios.slip);
    return integrate_with_law(ground, contact, ratios, law, accuracy).plane.at(1).fz_n;
  };
  // secant steps in (ln theta_f, ln Fz), where Fz is nearly a power
  double slope = 2 * ground.soil.n + 1, before = 0, step = 0, theta_f = guess_rad;
  for (int i = 0; i < 12 && theta_f > kShallowest && theta_f < kQuarterTurn; ++i) {
    constexpr double kClose = 1e-9, kRising = 0.1;
    const double fz = fz_n(theta_f);
    if (!(fz > 0)) break;
    const double off = std::log(fz / load_n);
    if (std::abs(off) < kClose) return theta_f;
    if (i > 0) slope = (off - before) / step;
    if (!(slope > kRising)) break;
    before = off;
    step = std::clamp(-off / slope, -1.0, 0.5);
    theta_f *= std::exp(step);
  }
  constexpr double kStep = 1.15;
  double low = guess_rad, high = guess_rad;
  while (fz_n(low) >= load_n) {
    high = low;
    low /= kStep;
    if (low < kShallowest) return std::nullopt;
  }
  while (high == low || fz_n(high) < load_n) {
    low = high;
    high = std::min(high * kStep, kQuarterTurn * (1 - 1e-12));
    if (low == high) return std::nullopt;
  }
  for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
    const double middle = (low + high) / 2;
    (fz_n(middle) < load_n ? low : high) = middle;
  }
  return high;
}

}  // namespace regoplan::wheel_contact
