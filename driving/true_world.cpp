#include "driving/true_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terramech/basics/input_error.h"

namespace regoplan {

Vehicle true_vehicle(Vehicle vehicle, const DriveTruth& truth) {
  const double mass_kg = vehicle.mass_kg + truth.payload_kg;
  vehicle.yaw_inertia_kgm2 *= mass_kg / vehicle.mass_kg;
  vehicle.mass_kg = mass_kg;
  vehicle = with_centre_moved(vehicle, truth.cg_forward_m, truth.cg_left_m, truth.cg_up_m);
  // Whether it can steer so far was asked of the known vehicle: a moved centre of gravity does not
  // change its steering, only from where it is told.
  Vehicle checked = vehicle;
  checked.curvature_max_1pm /= 2;
  validate(checked);
  return vehicle;
}

namespace {

/// How many wheels have come by where one rolls straight on, this one included.
int pass_of(const Vehicle& vehicle, std::size_t wheel) {
  const WheelMount& mount = vehicle.wheels[wheel];
  const auto ahead = std::ranges::count_if(vehicle.wheels, [&](const WheelMount& other) {
    return other.x_m > mount.x_m && std::abs(other.y_m - mount.y_m) < vehicle.wheel.width_m;
  });
  return 1 + static_cast<int>(ahead);
}

std::vector<Mechanism> mechanisms_of(const PlanningProblem& planned, const DriveTruth& truth,
                                     const std::string& wheel) {
  std::vector<Mechanism> mechanisms = planned.mechanisms;
  for (const TrueMechanism& one : truth.mechanisms) {
    if (one.wheels.empty() || std::ranges::find(one.wheels, wheel) != one.wheels.end()) {
      mechanisms.push_back(one.mechanism);
    }
  }
  if (truth.rut_stiffness) {
    mechanisms.push_back(
        {.id = "multi_pass", .form = "stiffening", .parameters = {{"a", *truth.rut_stiffness}}});
  }
  return mechanisms;
}

std::vector<Soil> soils_of(const PlanningProblem& planned, const DriveTruth& truth) {
  std::vector<Soil> soils = truth.soils;
  if (soils.empty()) {
    for (const MapSoil& soil : planned.map.soils()) soils.push_back(soil.soil.mean);
  }
  for (const SoilZone& zone : truth.zones) soils.push_back(zone.soil);
  if (truth.zone_raster) {
    for (const auto& [code, soil] : truth.zone_raster->soils) soils.push_back(soil);
  }
  return soils;
}

std::vector<TrueWheel> wheels_of(const PlanningProblem& planned, const DriveTruth& truth) {
  const Vehicle& vehicle = planned.vehicle;
  std::vector<TrueWheel> wheels;
  for (const Soil& soil : soils_of(planned, truth)) {
    for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
      WheelModelSpec spec = wheel_model_spec(planned, soil);
      spec.mechanisms = mechanisms_of(planned, truth, vehicle.wheels[i].name);
      wheels.emplace_back(std::move(spec), truth.wheels.empty() ? WheelFault{} : truth.wheels[i],
                          truth.rut_stiffness ? pass_of(vehicle, i) : 1);
    }
  }
  return wheels;
}

void require_known_wheels(const Vehicle& vehicle, const DriveTruth& truth) {
  for (const TrueMechanism& one : truth.mechanisms) {
    for (const std::string& wheel : one.wheels) {
      if (std::ranges::find(vehicle.wheels, wheel, &WheelMount::name) == vehicle.wheels.end()) {
        throw InputError(fmt::format("mechanisms: '{}' is no wheel of {}", wheel, vehicle.name));
      }
    }
  }
}

/// Even-odd rule.
bool within(const std::vector<PathPoint>& corners, double x_m, double y_m) {
  bool inside = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const PathPoint &a = corners[i], &b = corners[j];
    if ((a.y_m > y_m) != (b.y_m > y_m) &&
        x_m < (b.x_m - a.x_m) * (y_m - a.y_m) / (b.y_m - a.y_m) + a.x_m) {
      inside = !inside;
    }
  }
  return inside;
}

std::optional<std::int32_t> code_at(const ClassRaster& classes, double x_m, double y_m) {
  const GridFrame& frame = classes.frame;
  if (!covers(frame, x_m, y_m)) return std::nullopt;
  const int column =
      std::min(static_cast<int>((x_m - frame.west_m) / frame.cell_width_m), frame.columns - 1);
  const int row =
      std::min(static_cast<int>((frame.north_m - y_m) / frame.cell_height_m), frame.rows - 1);
  return classes.code[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                      static_cast<std::size_t>(column)];
}

/// A point that moves with a body, `forward` and `left` of another one.
VehicleState moved(VehicleState state, double forward_m, double left_m) {
  const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad);
  state.x_m += c * forward_m - s * left_m;
  state.y_m += s * forward_m + c * left_m;
  state.motion.vx_mps -= state.motion.yaw_rate_rad_s * left_m;
  state.motion.vy_mps += state.motion.yaw_rate_rad_s * forward_m;
  return state;
}

}  // namespace

TrueWorld::TrueWorld(const PlanningProblem& planned, const DriveTruth& truth)
    : planned_(planned),
      truth_(truth),
      vehicle_(true_vehicle(planned.vehicle, truth)),
      wheels_(wheels_of(planned, truth)),
      laws_(wheels_.begin(), wheels_.end()),
      ground_(planned.map, vehicle_),
      dynamics_(
          vehicle_, laws_,
          [this](double x_m, double y_m, double yaw_rad) { return ground_at(x_m, y_m, yaw_rad); },
          planned.gravity_mps2),
      wheel_sums_(vehicle_, laws_),
      polygon_(vehicle_) {
  require_known_wheels(planned.vehicle, truth);
}

PathPoint TrueWorld::on_the_map(double x_m, double y_m) const {
  return {x_m - truth_.map_east_m, y_m - truth_.map_north_m};
}

std::optional<std::size_t> TrueWorld::soil_at(double x_m, double y_m) const {
  const std::size_t of_map = planned_.map.soils().size();
  for (std::size_t i = 0; i < truth_.zones.size(); ++i) {
    if (within(truth_.zones[i].corners, x_m, y_m)) return of_map + i;
  }
  if (truth_.zone_raster) {
    const auto code = code_at(truth_.zone_raster->classes, x_m, y_m);
    const auto& soils = truth_.zone_raster->soils;
    for (std::size_t i = 0; code && i < soils.size(); ++i) {
      if (soils[i].first == *code) return of_map + truth_.zones.size() + i;
    }
  }
  const PathPoint place = on_the_map(x_m, y_m);
  const auto soil =
      planned_.map.soil_index(place.x_m - truth_.soil_east_m, place.y_m - truth_.soil_north_m);
  return soil ? std::optional(static_cast<std::size_t>(*soil)) : std::nullopt;
}

std::string TrueWorld::soil_name(double x_m, double y_m) const {
  const auto soil = soil_at(x_m, y_m);
  if (!soil) return "";
  const std::size_t of_map = planned_.map.soils().size();
  if (*soil < of_map) return planned_.map.soils()[*soil].name;
  if (*soil < of_map + truth_.zones.size()) return truth_.zones[*soil - of_map].name;
  return "zone_raster";
}

GroundPatch TrueWorld::ground_at(double x_m, double y_m, double yaw_rad) const {
  const PathPoint place = on_the_map(x_m, y_m);
  GroundPatch patch = ground_.at(place.x_m, place.y_m, yaw_rad);
  if (!patch.known) return patch;
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& wheel = vehicle_.wheels[i];
    const auto soil =
        soil_at(x_m + c * wheel.x_m - s * wheel.y_m, y_m + s * wheel.x_m + c * wheel.y_m);
    if (!soil) return {};
    patch.soil[i] = static_cast<std::int16_t>(*soil * vehicle_.wheels.size() + i);
  }
  return patch;
}

/// The steering turns the vehicle about a point that it does not know to lie elsewhere.
double TrueWorld::true_curvature_1pm(double known_1pm) const {
  if (known_1pm == 0 || (truth_.cg_forward_m == 0 && truth_.cg_left_m == 0)) return known_1pm;
  const double x_c = planned_.vehicle.turn_centre_x_m;
  const double y_c = std::copysign(std::sqrt(1 / (known_1pm * known_1pm) - x_c * x_c), known_1pm);
  return std::copysign(1 / std::hypot(x_c - truth_.cg_forward_m, y_c - truth_.cg_left_m),
                       known_1pm);
}

VehicleState TrueWorld::to_true(VehicleState known) const {
  const double curvature = true_curvature_1pm(known.curvature_1pm);
  if (known.curvature_1pm != 0) {
    const double faster = known.curvature_1pm / curvature;
    known.rim_speed_mps *= faster;
    known.rim_acceleration_mps2 *= faster;
  }
  known.curvature_1pm = curvature;
  return moved(known, truth_.cg_forward_m, truth_.cg_left_m);
}

/// Commands are told as the vehicle knows them.
VehicleState TrueWorld::to_known(VehicleState true_state, const VehicleState& commanded) const {
  VehicleState known = moved(true_state, -truth_.cg_forward_m, -truth_.cg_left_m);
  known.curvature_1pm = commanded.curvature_1pm;
  known.rim_speed_mps = commanded.rim_speed_mps;
  known.rim_acceleration_mps2 = commanded.rim_acceleration_mps2;
  return known;
}

StepResult TrueWorld::step(const VehicleState& state, const VehicleControl& control,
                           double duration_s) const {
  if (truth_.cg_forward_m == 0 && truth_.cg_left_m == 0) {
    return dynamics_.step(state, control, duration_s);
  }
  // Commands move at the rates of the known vehicle; the true one is given what they come to.
  const auto approach = [](double value, double target, double step) {
    return std::abs(target - value) <= step ? target : value + std::copysign(step, target - value);
  };
  const Vehicle& known = planned_.vehicle;
  VehicleState commanded = state;
  commanded.curvature_1pm = approach(state.curvature_1pm, control.curvature_target_1pm,
                                     known.curvature_rate_max_1pms * duration_s);
  commanded.rim_speed_mps = approach(state.rim_speed_mps, control.speed_target_mps,
                                     known.acceleration_max_mps2 * duration_s);
  commanded.rim_acceleration_mps2 = (commanded.rim_speed_mps - state.rim_speed_mps) / duration_s;
  const VehicleState aim = to_true(commanded);
  VehicleControl to_aim = control;
  to_aim.curvature_target_1pm = aim.curvature_1pm;
  to_aim.speed_target_mps = aim.rim_speed_mps;
  StepResult result = dynamics_.step(to_true(state), to_aim, duration_s);
  result.state = to_known(result.state, commanded);
  return result;
}

GroundPatch TrueWorld::ground(const VehicleState& state) const {
  const VehicleState there = to_true(state);
  return ground_at(there.x_m, there.y_m, there.yaw_rad);
}

bool TrueWorld::at_rest(const VehicleState& state) const {
  return dynamics_.at_rest(state);
}

double TrueWorld::motor_constant_factor(std::size_t wheel) const {
  return truth_.wheels.empty() ? 1 : truth_.wheels[wheel].motor_constant_factor;
}

std::vector<WheelNow> TrueWorld::wheels(const VehicleState& state) const {
  const VehicleState there = to_true(state);
  const GroundPatch patch = ground_at(there.x_m, there.y_m, there.yaw_rad);
  const PatchAxes axes(patch, planned_.gravity_mps2);
  const double vx = there.motion.vx_mps;
  const GroundReaction reaction{
      .normal_n = vehicle_.mass_kg * (axes.gravity_normal_mps2 + vx * vx * patch.curvature_1pm),
      .forward_n = there.transfer_forward_n,
      .left_n = there.transfer_left_n};
  const bool turns = there.turn_rate_rad_s != 0;
  const WheelSetting setting{
      .wheels = turns ? wheels_on_the_spot(vehicle_)
                      : steered_wheels(vehicle_, {there.curvature_1pm, there.crab_rad}),
      .rim_speed = turns ? there.turn_rate_rad_s : there.rim_speed_mps};
  const WheelSums sums = wheel_sums_.sums(there.motion, setting, patch, reaction);
  std::vector<WheelNow> wheels;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    WheelNow now{.load_n = wheel_sums_.sharing().load_n(i, reaction),
                 .steer_rad = setting.wheels.at(i).steer_rad()};
    const auto law = static_cast<std::size_t>(patch.soil.at(i));
    const WheelMotion at =
        wheel_motion(vehicle_.wheels[i], setting.wheels.at(i), there.motion,
                     now.load_n > 0 ? sums.rim_speed_mps.at(i)
                                    : setting.rim_speed * setting.wheels.at(i).rim_speed_per_speed);
    now.rim_speed_mps = at.rim_speed_mps;
    if (now.load_n > 0) {
      const WheelForces forces = faded(laws_[law], now.load_n, at);
      now.torque_nm = forces.torque_nm;
      now.sinkage_m = forces.sinkage_m;
      LargestSlips slips;  // of this wheel: none near rest, as where limits are judged
      slips.add(wheels_[law].true_motion(at));
      now.slip = slips.slip();
      now.slip_angle_rad = slips.slip_angle_rad();
    }
    wheels.push_back(now);
  }
  return wheels;
}

StateMargins TrueWorld::margins(const VehicleState& state, const GroundPatch& patch) const {
  const SupplyQuestion question = question_of(dynamics_, to_true(state), patch);
  const SupplyAnswer answer =
      SolvedSupply(vehicle_, dynamics_.sharing(), laws_,
                   trim_limits(planned_.vehicle, strain_limits(planned_.limits)))
          .answer(question);
  return margins_of(dynamics_, polygon_, question, answer);
}

}  // namespace regoplan
