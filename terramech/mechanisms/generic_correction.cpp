#include "terramech/mechanisms/generic_correction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

void require(const std::string& field, double value, bool valid, const std::string& allowed) {
  if (!valid || !std::isfinite(value)) throw ValueError(field, value, allowed);
}

void require_region(const std::string& field, const std::array<double, 2>& region, double unit,
                    bool within, const std::string& allowed) {
  for (const double end : region) require(field, end / unit, within, allowed);
  require(field, region[1] / unit, region[0] < region[1], "above its other end");
}

struct Sloped {
  double value = 1, slope = 0;
};

/// 1 inside, falling to 0 at the sides that have a fade, each `width` wide; slope over x.
Sloped fade(double x, double low, double high, double width, bool fades_low) {
  const auto step = [](double u) { return u * u * (3 - 2 * u); };
  const auto step_slope = [](double u) { return 6 * u * (1 - u); };
  if (width <= 0) return {};
  if (fades_low && x - low < width) {
    const double u = std::max(x - low, 0.0) / width;
    return {step(u), step_slope(u) / width};
  }
  if (high - x < width) {
    const double u = std::max(high - x, 0.0) / width;
    return {step(u), -step_slope(u) / width};
  }
  return {};
}

struct Fades {
  Sloped slip, angle, log_load;
  double value() const { return slip.value * angle.value * log_load.value; }
};

Fades fades_at(const GenericCorrection& c, const CorrectionPoint& at) {
  const auto along = [&c](double x, double low, double high, bool fades_low = true) {
    return fade(x, low, high, c.fade_share * (high - low), fades_low);
  };
  const auto& [slip, angle, load] =
      std::tie(c.slip_ratio_region, c.slip_angle_rad_region, c.load_n_region);
  return {.slip = along(at.slip_ratio, slip[0], slip[1]),
          .angle = along(at.slip_angle_rad, angle[0], angle[1], angle[0] > 0),
          .log_load = along(std::log(at.load_n), std::log(load[0]), std::log(load[1]))};
}

/// Distances from a node in units of the scales, and its two bumps before any fade.
struct Offsets {
  double slip, angle, mirrored_angle, log_load;
  double bump, mirrored;
};

Offsets offsets(const GenericCorrection& c, const GenericCorrection::Node& node,
                const CorrectionPoint& at) {
  Offsets d{.slip = (at.slip_ratio - node.slip_ratio) / c.slip_scale,
            .angle = (at.slip_angle_rad - node.slip_angle_rad) / c.slip_angle_scale_rad,
            .mirrored_angle = (at.slip_angle_rad + node.slip_angle_rad) / c.slip_angle_scale_rad,
            .log_load = std::log(at.load_n / node.load_n) / c.log_load_scale,
            .bump = 0,
            .mirrored = 0};
  const double common = d.slip * d.slip + d.log_load * d.log_load;
  d.bump = std::exp(-(common + d.angle * d.angle) / 2);
  d.mirrored = std::exp(-(common + d.mirrored_angle * d.mirrored_angle) / 2);
  return d;
}

void add(CorrectionValue& sum, const GenericCorrection::Node& node, double even, double side) {
  sum.fx_n += node.fx_n * even;
  sum.fy_n += node.fy_n * side;
  sum.torque_nm += node.torque_nm * even;
  sum.sinkage_m += node.sinkage_m * even;
}

CorrectionValue combined(double a, const CorrectionValue& x, double b, const CorrectionValue& y) {
  return {.fx_n = a * x.fx_n + b * y.fx_n,
          .fy_n = a * x.fy_n + b * y.fy_n,
          .torque_nm = a * x.torque_nm + b * y.torque_nm,
          .sinkage_m = a * x.sinkage_m + b * y.sinkage_m};
}

}  // namespace

void validate(const GenericCorrection& c) {
  require("slip_scale", c.slip_scale, c.slip_scale > 0, "above 0");
  require("slip_angle_scale_deg", c.slip_angle_scale_rad / kDegree, c.slip_angle_scale_rad > 0,
          "above 0");
  require("log_load_scale", c.log_load_scale, c.log_load_scale > 0, "above 0");
  const auto& slip = c.slip_ratio_region;
  const auto& angle = c.slip_angle_rad_region;
  require_region("region.slip_ratio", slip, 1, slip[0] >= -1 && slip[1] <= 1, "-1 to 1");
  constexpr double kRounding = 1 + 1e-12;
  require_region("region.slip_angle_deg", angle, kDegree,
                 angle[0] >= 0 && angle[1] <= std::numbers::pi / 2 * kRounding, "0 to 90");
  require_region("region.load_n", c.load_n_region, 1, c.load_n_region[0] > 0, "above 0");
  require("fade_share", c.fade_share, c.fade_share >= 0 && c.fade_share <= 0.5, "0 to 0.5");
  for (const GenericCorrection::Node& node : c.nodes) {
    require("slip_angle_deg", node.slip_angle_rad / kDegree, node.slip_angle_rad >= 0,
            "at least 0");
    require("load_n", node.load_n, node.load_n > 0, "above 0");
    for (const auto& [field, value] :
         {std::pair{"slip_ratio", node.slip_ratio}, std::pair{"fx_n", node.fx_n},
          std::pair{"fy_n", node.fy_n}, std::pair{"torque_nm", node.torque_nm},
          std::pair{"sinkage_m", node.sinkage_m}}) {
      require(field, value, true, "a finite number");
    }
  }
}

bool is_inside(const GenericCorrection& correction, const CorrectionPoint& point) {
  const auto within = [](double x, const std::array<double, 2>& region) {
    return x >= region[0] && x <= region[1];
  };
  return within(point.slip_ratio, correction.slip_ratio_region) &&
         within(point.slip_angle_rad, correction.slip_angle_rad_region) &&
         within(point.load_n, correction.load_n_region);
}

CorrectionBump bump(const GenericCorrection& correction, const GenericCorrection::Node& node,
                    const CorrectionPoint& point) {
  if (!is_inside(correction, point)) return {};
  const double fade = fades_at(correction, point).value();
  const Offsets d = offsets(correction, node, point);
  return {.even = fade * d.bump, .side = fade * (d.bump - d.mirrored)};
}

SlopedCorrection correction_at(const GenericCorrection& correction, const CorrectionPoint& point) {
  if (!is_inside(correction, point)) return {};
  SlopedCorrection sum;  // before the fade
  for (const GenericCorrection::Node& node : correction.nodes) {
    const Offsets d = offsets(correction, node, point);
    const double side = d.bump - d.mirrored;
    add(sum.value, node, d.bump, side);
    const double by_slip = -d.slip / correction.slip_scale;
    add(sum.by_slip_ratio, node, by_slip * d.bump, by_slip * side);
    const double by_angle = -1 / correction.slip_angle_scale_rad;
    add(sum.by_slip_angle, node, by_angle * d.angle * d.bump,
        by_angle * (d.angle * d.bump - d.mirrored_angle * d.mirrored));
    const double by_log_load = -d.log_load / correction.log_load_scale;
    add(sum.by_log_load, node, by_log_load * d.bump, by_log_load * side);
  }
  const Fades fades = fades_at(correction, point);
  const double all = fades.value();
  return {.value = combined(all, sum.value, 0, {}),
          .by_slip_ratio =
              combined(all, sum.by_slip_ratio,
                       fades.slip.slope * fades.angle.value * fades.log_load.value, sum.value),
          .by_slip_angle =
              combined(all, sum.by_slip_angle,
                       fades.slip.value * fades.angle.slope * fades.log_load.value, sum.value),
          .by_log_load =
              combined(all, sum.by_log_load,
                       fades.slip.value * fades.angle.value * fades.log_load.slope, sum.value)};
}

}  // namespace regoplan
