#include "python/physics/vehicle_on_soil.h"

#include <cmath>

#include "app/settings/vehicle_settings.h"
#include "planner/problem/planning_problem.h"
#include "python/shared/settings_text.h"

namespace regoplan::python {
namespace {

WheelLaw law_of(const WheelSource& wheel) {
  return wheel.table ? WheelLaw(*wheel.table) : WheelLaw(*wheel.direct);
}

}  // namespace

VehicleOnSoil::VehicleOnSoil(Vehicle vehicle, WheelSource wheel, double gravity_mps2)
    : vehicle_(std::move(vehicle)),
      wheel_(std::move(wheel)),
      laws_{law_of(wheel_)},
      laws_of_wheels_(vehicle_.wheels.size(), law_of(wheel_)),
      dynamics_(
          vehicle_, laws_, [](double, double, double) { return GroundPatch{.known = true}; },
          gravity_mps2),
      judge_(dynamics_, laws_, strain_limits(default_limits(vehicle_))) {}

GroundPatch VehicleOnSoil::patch_of(const Moment& moment) const {
  return {.known = true,
          .slope_forward = std::tan(moment.slope_forward_rad),
          .slope_left = std::tan(moment.slope_left_rad)};
}

VehicleState VehicleOnSoil::state_of(const Moment& moment) const {
  VehicleState state = dynamics_.rolling_state(0, 0, 0, moment.speed_mps, moment.curvature_1pm);
  state.rim_acceleration_mps2 = moment.acceleration_mps2;
  return state;
}

StateMargins VehicleOnSoil::margins(const Moment& moment) const {
  return judge_.margins(state_of(moment), patch_of(moment));
}

SupplyResult VehicleOnSoil::supply(const Moment& moment) const {
  const GroundPatch patch = patch_of(moment);
  return judge_.supply(question_of(dynamics_, state_of(moment), patch));
}

TrimAnswer VehicleOnSoil::trim(const Moment& moment) const {
  const GroundPatch patch = patch_of(moment);
  const SupplyQuestion question = question_of(dynamics_, state_of(moment), patch);
  const SteadyManoeuvre manoeuvre =
      manoeuvre_of(vehicle_, dynamics_.sharing(), laws_of_wheels_, question);
  const double normal_n = question.normal_n;
  const ForceLine across{
      .from = {.forward_n = question.force.forward_n, .left_n = 0},
      .per_unit = {.forward_n = 0, .left_n = std::copysign(normal_n, question.force.left_n)}};
  const auto start = manoeuvre.solve_from_rolling(across);
  if (!start) return {.trim = {}, .limit = "traction"};
  const LimitUse use = limit_use(manoeuvre.trim(*start, across), judge_.limits());
  if (use.used >= 1) {
    return {.trim = {}, .limit = std::string(name(use.limit)), .wheel = use.wheel};
  }
  const BranchEnd end = follow_branch(manoeuvre, *start, across,
                                      std::abs(question.force.left_n) / normal_n, judge_.limits());
  if (!end.reached_target) {
    return {.trim = {}, .limit = std::string(name(end.limit)), .wheel = end.wheel};
  }
  return {.trim = manoeuvre.trim(end.point, across), .limit = {}};
}

SafeCurvature VehicleOnSoil::largest_safe_curvature(double speed_mps, double slope_left_rad,
                                                    double margin_min) const {
  const WheelModelSpec& spec = wheel_.direct->spec();
  Limits limits = default_limits(vehicle_);
  limits.margin_min = margin_min;
  constexpr double kNoSideSlopes = -1;
  const FeasibilityChart chart =
      feasibility_chart({.vehicle = vehicle_,
                         .soils = {{.name = {}, .source = {}, .soil = {.mean = spec.soil}}},
                         .wheel_variant = spec.variant,
                         .mechanisms = spec.mechanisms,
                         .generic = spec.generic,
                         .gravity_mps2 = spec.gravity_mps2,
                         .limits = limits,
                         .speeds_mps = {speed_mps},
                         .slopes_rad = {slope_left_rad},
                         .slope_max_rad = kNoSideSlopes,
                         .threads = 1});
  return chart.curvatures.front();
}

Vehicle vehicle_from(const std::string& settings) {
  return read_vehicle(settings_of(settings, "vehicle"));
}

Vehicle vehicle_from_file(const std::string& file) {
  return read_vehicle(read_settings(file));
}

std::string vehicle_settings(const Vehicle& vehicle) {
  return json_of(settings_of(vehicle_text(vehicle), "vehicle"));
}

}  // namespace regoplan::python
