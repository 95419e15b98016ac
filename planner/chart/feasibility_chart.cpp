#include "planner/chart/feasibility_chart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "planner/problem/rejection.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

/// One vehicle on a plane of one soil.
class Plane {
 public:
  Plane(const ChartSettings& settings, std::size_t soil)
      : settings_(settings),
        model_({.variant = settings.wheel_variant,
                .wheel = settings.vehicle.wheel,
                .soil = settings.soils[soil].soil.mean,
                .gravity_mps2 = settings.gravity_mps2,
                .mechanisms = settings.mechanisms,
                .generic = settings.generic},
               WheelAccuracy::kFast),
        laws_{WheelLaw(model_)},
        dynamics_(
            settings.vehicle, laws_, [](double, double, double) { return GroundPatch{}; },
            settings.gravity_mps2),
        judge_(dynamics_, laws_, strain_limits(settings.limits)) {}
  Plane(const Plane&) = delete;
  Plane& operator=(const Plane&) = delete;

  /// Steady driving; the ground rises to the left, or so far from ahead as `uphill_rad` says.
  StateMargins margins(double speed_mps, double curvature_1pm, double slope_rad,
                       double uphill_rad = std::numbers::pi / 2) const {
    const GroundPatch patch{.known = true,
                            .slope_forward = std::tan(slope_rad) * std::cos(uphill_rad),
                            .slope_left = std::tan(slope_rad) * std::sin(uphill_rad)};
    const VehicleState state = dynamics_.rolling_state(0, 0, 0, speed_mps, curvature_1pm);
    return judge_.margins(state, patch);
  }

  /// What forbids a curvature, to either side; nothing where it is safe.
  std::optional<std::string_view> forbidden(double speed_mps, double curvature_1pm,
                                            double slope_rad) const {
    if (slope_rad > settings_.limits.slope_max_rad) return "slope";
    for (const double side : {1.0, -1.0}) {
      const StateMargins m = margins(speed_mps, side * curvature_1pm, slope_rad);
      const double least = settings_.limits.margin_min;
      if (const auto rejected = m.supply ? std::nullopt : rejected_by(m, least, {})) {
        return name(rejected->reason);
      }
      const double cornering = *m.cornering;
      const double traction = m.traction.value_or(std::numeric_limits<double>::infinity());
      if (std::min({cornering, m.tip_over, traction}) < least || !m.traction) {
        return cornering <= std::min(m.tip_over, traction) ? "cornering"
               : m.tip_over <= traction                    ? "tip_over"
                                                           : "traction";
      }
      if (curvature_1pm == 0 || (slope_rad == 0 && side > 0)) {
        // Level ground is the same to either side, and straight on has no side.
        break;
      }
    }
    return std::nullopt;
  }

 private:
  const ChartSettings& settings_;
  WheelModel model_;
  std::vector<WheelLaw> laws_;
  VehicleDynamics dynamics_;
  MarginJudge judge_;
};

/// Forces depend on velocity ratios only: a slow speed stands for all.
constexpr double kSlow_mps = 0.01;

/// The smallest margin of driving straight on, whatever the heading on the slope. The vehicle is
/// the same to either side, so half of the directions do.
/// \param enough below that, how much smaller it is does not matter
double margin_of_any_heading(const Plane& plane, double slope_rad,
                             double enough = -std::numeric_limits<double>::infinity()) {
  constexpr int kDirections = 6;
  double least = 1;
  for (int i = 0; i <= (slope_rad > 0 ? kDirections : 0) && least >= enough; ++i) {
    const StateMargins margins =
        plane.margins(kSlow_mps, 0, slope_rad, i * std::numbers::pi / kDirections);
    least = std::min(least, margins.stability().value_or(-1));
  }
  return least;
}

double smaller_supply_n(const Plane& plane, const SafeCurvature& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const double side : {1.0, -1.0}) {
    const auto supply = plane.margins(at.speed_mps, side * at.curvature_1pm, at.slope_rad).supply;
    least = std::min(least, supply ? std::min(supply->left_n, -supply->right_n) : 0);
  }
  return least;
}

SafeCurvature largest_safe(const Plane& plane, const ChartSettings& settings, SafeCurvature at) {
  if (const auto reason = plane.forbidden(at.speed_mps, 0, at.slope_rad)) {
    at.limit = *reason;
    return at;
  }
  const double most = settings.vehicle.curvature_max_1pm;
  // Coarse steps upward find the first that is not safe, finer ones where it begins.
  constexpr int kSteps = 10;
  double low = 0, high = most;
  at.limit = "steering";
  for (int i = 1; i <= kSteps; ++i) {
    const double curvature = most * std::pow(static_cast<double>(i) / kSteps, 2);
    const auto reason = plane.forbidden(at.speed_mps, curvature, at.slope_rad);
    if (reason) {
      high = curvature;
      at.limit = *reason;
      break;
    }
    low = curvature;
  }
  if (low < most) {
    constexpr double kPrecision = 0.01;
    while (high - low > kPrecision * high && high > 1e-4 * most) {
      const double middle = (low + high) / 2;
      const auto reason = plane.forbidden(at.speed_mps, middle, at.slope_rad);
      if (reason) at.limit = *reason;
      (reason ? high : low) = middle;
    }
  }
  at.curvature_1pm = low;
  return at;
}

}  // namespace

FeasibilityChart feasibility_chart(const ChartSettings& settings) {
  FeasibilityChart chart;
  for (std::size_t soil = 0; soil < settings.soils.size(); ++soil) {
    for (const double slope : settings.slopes_rad) {
      for (const double speed : settings.speeds_mps) {
        chart.curvatures.push_back(
            {.soil = static_cast<int>(soil), .slope_rad = slope, .speed_mps = speed});
      }
    }
    for (int degree = 0; degree * kDegree <= settings.slope_max_rad * (1 + 1e-9); ++degree) {
      chart.side_slopes.push_back({.soil = static_cast<int>(soil), .slope_rad = degree * kDegree});
    }
  }
  parallel_for(chart.curvatures.size(), settings.threads, [&](std::size_t i) {
    SafeCurvature& at = chart.curvatures[i];
    const Plane plane(settings, static_cast<std::size_t>(at.soil));
    at = largest_safe(plane, settings, at);
    at.supply_n = smaller_supply_n(plane, at);
  });
  parallel_for(chart.side_slopes.size(), settings.threads, [&](std::size_t i) {
    SideSlope& at = chart.side_slopes[i];
    const Plane plane(settings, static_cast<std::size_t>(at.soil));
    const StateMargins margins = plane.margins(kSlow_mps, 0, at.slope_rad);
    at.cornering = margins.counted_cornering();
    at.tip_over = margins.tip_over;
    at.traction = margins.counted_traction();
    at.any_heading = margin_of_any_heading(plane, at.slope_rad);
  });
  return chart;
}

ChartSettings chart_settings(const PlanningProblem& problem) {
  return {.vehicle = problem.vehicle,
          .soils = problem.map.soils(),
          .wheel_variant = problem.wheel_variant,
          .mechanisms = problem.mechanisms,
          .generic = problem.generic,
          .gravity_mps2 = problem.gravity_mps2,
          .limits = problem.limits,
          .speeds_mps = {},
          .slopes_rad = {},
          .slope_max_rad = problem.limits.slope_max_rad,
          .threads = problem.search.threads};
}

double straight_on_margin(const ChartSettings& settings, std::size_t soil, double slope_rad) {
  return margin_of_any_heading(Plane(settings, soil), slope_rad);
}

std::optional<double> straight_on_limit_rad(const ChartSettings& settings, std::size_t soil) {
  const Plane plane(settings, soil);
  const auto holds = [&](int degree) {
    return margin_of_any_heading(plane, degree * kDegree, settings.limits.margin_min) >=
           settings.limits.margin_min;
  };
  if (!holds(0)) return std::nullopt;
  int good = 0, bad = static_cast<int>(settings.slope_max_rad / kDegree * (1 + 1e-9)) + 1;
  while (bad - good > 1) {
    const int middle = (good + bad) / 2;
    (holds(middle) ? good : bad) = middle;
  }
  return good * kDegree;
}

std::vector<double> side_slope_limits_rad(const FeasibilityChart& chart,
                                          const ChartSettings& settings) {
  std::vector<double> limits(settings.soils.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> ended(settings.soils.size());
  for (const SideSlope& at : chart.side_slopes) {
    const auto soil = static_cast<std::size_t>(at.soil);
    constexpr double kRounding = 1e-9;
    const bool safe =
        at.slope_rad <= settings.limits.slope_max_rad * (1 + kRounding) &&
        std::min({at.cornering, at.tip_over, at.traction}) >= settings.limits.margin_min;
    if (!safe) ended[soil] = true;
    if (!ended[soil]) limits[soil] = at.slope_rad;
  }
  return limits;
}

}  // namespace regoplan
