#include "planner/problem/world.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

std::vector<WheelModel> models_of(const PlanningProblem& problem, WorldUse use) {
  std::vector<WheelModel> models;
  for (const MapSoil& soil : problem.map.soils()) {
    models.emplace_back(wheel_model_spec(problem, soil.soil.mean),
                        use == WorldUse::kSearch ? WheelAccuracy::kFast : WheelAccuracy::kExact);
  }
  return models;
}

std::optional<ForceTable> table_of(const PlanningProblem& problem, const MapSoil& soil) {
  const double nominal_load_n = problem.vehicle.mass_kg * problem.gravity_mps2 /
                                static_cast<double>(problem.vehicle.wheels.size());
  // Far below what the supply's bound and the reserves of a search leave; no verdict rests on it.
  constexpr TableAccuracy kAccuracy{.at_999_permille = 5e-3, .at_worst = 2e-2};
  try {
    return ForceTable::cached({.model = wheel_model_spec(problem, soil.soil.mean),
                               .nominal_load_n = nominal_load_n,
                               .accuracy = kAccuracy});
  } catch (const InputError&) {
    return std::nullopt;  // no table is that accurate: the search asks the model itself
  }
}

std::vector<std::optional<ForceTable>> tables_of(const PlanningProblem& problem, WorldUse use) {
  std::vector<std::optional<ForceTable>> tables;
  for (const MapSoil& soil : problem.map.soils()) {
    tables.push_back(use == WorldUse::kSearch ? table_of(problem, soil) : std::nullopt);
  }
  return tables;
}

std::vector<WheelLaw> views_of(const std::vector<WheelModel>& models,
                               const std::vector<std::optional<ForceTable>>& tables) {
  std::vector<WheelLaw> laws;
  for (std::size_t i = 0; i < models.size(); ++i) {
    laws.push_back(tables[i] ? WheelLaw(*tables[i]) : WheelLaw(models[i]));
  }
  return laws;
}

/// Half of a square in which ground must be known for the wheels to stand on known ground wherever
/// a search's reserve moves them, the heights between cells included.
double edge_reach_m(const PlanningProblem& problem) {
  const GridFrame& frame = problem.map.elevation().frame;
  double wheels_m = 0;
  for (const WheelMount& wheel : problem.vehicle.wheels) {
    wheels_m = std::max(wheels_m, std::hypot(wheel.x_m, wheel.y_m));
  }
  return wheels_m + std::max(frame.cell_width_m, frame.cell_height_m) + World::kSearchClearance_m;
}

double largest_by_magnitude(const Vehicle& vehicle, double curvature_1pm) {
  double largest = 0;
  for (const WheelMount& wheel : vehicle.wheels) {
    const double angle = steer_angle_rad(vehicle, wheel, curvature_1pm);
    // Front wheels tell the direction: a left turn is positive.
    if (wheel.x_m > vehicle.turn_centre_x_m && std::abs(angle) > std::abs(largest)) largest = angle;
  }
  return largest;
}

RejectedState at_state(const VehicleState& state) {
  return {.x_m = state.x_m,
          .y_m = state.y_m,
          .yaw_rad = state.yaw_rad,
          .speed_mps = state.motion.vx_mps,
          .curvature_1pm = state.curvature_1pm};
}

}  // namespace

World::World(const PlanningProblem& problem, WorldUse use, int threads)
    : problem_(problem),
      use_(use),
      models_(models_of(problem, use)),
      force_tables_(tables_of(problem, use)),
      laws_(views_of(models_, force_tables_)),
      edge_reach_m_(edge_reach_m(problem)),
      ground_(problem.map, problem.vehicle),
      known_(problem.map),
      dynamics_(
          problem.vehicle, laws_,
          [this](double x_m, double y_m, double yaw_rad) { return ground_.at(x_m, y_m, yaw_rad); },
          problem.gravity_mps2),
      judge_(dynamics_, laws_, strain_limits(problem.limits)),
      obstacles_(problem.map, problem.vehicle, use == WorldUse::kSearch ? kSearchClearance_m : 0) {
  if (use != WorldUse::kSearch) return;
  for (std::size_t soil = 0; soil < laws_.size(); ++soil) {
    lateral_shares_.push_back(lateral_share_of(static_cast<int>(soil)));
  }
  judge_.use_tables(problem.limits.slope_max_rad, threads);
}

double World::lateral_share_of(int soil) const {
  GroundPatch level{.known = true};
  level.soil.fill(static_cast<std::int16_t>(soil));
  constexpr double kSlow_mps = 0.01;  // forces depend on ratios of velocities only
  const StateMargins straight = judge_.margins(dynamics_.rolling_state(0, 0, 0, kSlow_mps), level);
  if (!straight.supply) return 0;
  const double least_n = std::min(straight.supply->left_n, -straight.supply->right_n);
  const double weight_n = problem_.vehicle.mass_kg * problem_.gravity_mps2;
  return std::max(0.0, least_n / weight_n - problem_.limits.margin_min);
}

double World::lateral_share(double x_m, double y_m) const {
  if (const auto soil = problem_.map.soil_index(x_m, y_m)) {
    return lateral_shares_[static_cast<std::size_t>(*soil)];
  }
  return *std::ranges::max_element(lateral_shares_);
}

VehicleState World::start() const {
  const StartState& start = problem_.start;
  return dynamics_.rolling_state(start.x_m, start.y_m, start.heading_rad, start.speed_mps);
}

bool World::at_goal(const VehicleState& state) const {
  if (!within_goal(state)) return false;
  const double share = use_ == WorldUse::kSearch ? kSearchLimitShare : 1;
  const double speed_mps = std::hypot(state.motion.vx_mps, state.motion.vy_mps);
  const double speed_max_mps = share * problem_.goal.speed_max_mps;
  return (speed_max_mps > 0 && speed_mps <= speed_max_mps) || dynamics_.at_rest(state);
}

bool World::within_goal(const VehicleState& state) const {
  const Goal& goal = problem_.goal;
  const double share = use_ == WorldUse::kSearch ? kSearchGoalShare : 1;
  if (std::hypot(state.x_m - goal.x_m, state.y_m - goal.y_m) > share * goal.radius_m) return false;
  return !goal.heading_rad ||
         std::abs(std::remainder(state.yaw_rad - *goal.heading_rad, 2 * std::numbers::pi)) <=
             share * goal.heading_tolerance_rad;
}

double World::search_step_s() const {
  constexpr double kTravel_m = 0.3, kLongest_s = 2.5;
  const GridFrame& frame = problem_.map.elevation().frame;
  const double travel = std::min({kTravel_m, frame.cell_width_m, frame.cell_height_m});
  return std::min(travel / problem_.speed_max_mps, kLongest_s);
}

std::optional<RejectedState> World::rejected(const VehicleState& state, const WheelStrain& strain,
                                             std::optional<double> margin_min) const {
  RejectedState rejection = at_state(state);
  const auto because = [&](Rejection reason, std::optional<Exceeded> exceeded = std::nullopt) {
    rejection.reason = reason;
    rejection.exceeded = exceeded;
    return rejection;
  };
  if (!problem_.map.inside(state.x_m, state.y_m)) return because(Rejection::kBounds);
  if (const auto exceeded = too_fast(state)) return because(Rejection::kSpeed, exceeded);
  const GroundPatch patch = ground_.at(state.x_m, state.y_m, state.yaw_rad);
  if (!patch.known || (use_ == WorldUse::kSearch && beside_the_edge(state))) {
    return because(Rejection::kUnknownTerrain);
  }
  if (obstacles_.hit(state, patch)) return because(Rejection::kObstacle);
  // Each limit with what a state has of it, by magnitude.
  struct Held {
    Rejection reason;
    double found;
    double limit;
    double held;  // up to which the limit counts as kept
  };
  const Limits& limits = problem_.limits;
  const bool search = use_ == WorldUse::kSearch;
  const double share = search ? kSearchLimitShare : 1;
  for (const Held& held :
       {Held{Rejection::kSlope, patch.tilt_rad(), limits.slope_max_rad, steepest_held_rad(limits)},
        Held{Rejection::kSinkage, strain.sinkage_m, limits.sinkage_max_m, limits.sinkage_max_m},
        Held{Rejection::kSlip, strain.slip, limits.slip_max, limits.slip_max},
        Held{Rejection::kSlipAngle, strain.slip_angle_rad, limits.slip_angle_max_rad,
             limits.slip_angle_max_rad}}) {
    const double allowed = share * held.limit;
    if (std::abs(held.found) > (search ? allowed : held.held)) {
      return because(held.reason, Exceeded{.found = held.found, .limit = allowed});
    }
  }
  if (!margin_min) return std::nullopt;
  return rejected_by(margins(state, patch), *margin_min, rejection);
}

std::optional<Exceeded> World::too_fast(const VehicleState& state) const {
  constexpr double kRounding = 1e-3;  // in which a speed counts as held
  // Downhill a vehicle slides faster than its wheels turn; the speed limit holds all the same.
  const double speed_mps = std::hypot(state.motion.vx_mps, state.motion.vy_mps);
  // A search keeps a reserve, but may start as fast as the problem says.
  const double limit_mps =
      use_ == WorldUse::kSearch
          ? std::max(0.995 * problem_.speed_max_mps, (1 + kRounding / 2) * problem_.start.speed_mps)
          : problem_.speed_max_mps;
  const double allowed_mps = use_ == WorldUse::kSearch ? limit_mps : (1 + kRounding) * limit_mps;
  if (!(speed_mps > allowed_mps)) return std::nullopt;
  return Exceeded{.found = speed_mps, .limit = limit_mps};
}

bool World::beside_the_edge(const VehicleState& state) const {
  const double x = state.x_m, y = state.y_m;
  if (known_.around(x, y, edge_reach_m_)) return false;
  const auto ends = [&](double dx_m, double dy_m) {
    return !ground_.at(x + dx_m, y + dy_m, state.yaw_rad).known;
  };
  constexpr double c = kSearchClearance_m;
  return ends(c, c) || ends(c, -c) || ends(-c, c) || ends(-c, -c);
}

Judgement World::judge(const VehicleState& state, const WheelStrain& strain, double time_s) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::optional<RejectedState> rejection = rejected(state, strain, std::nullopt);
  const GroundPatch patch = ground_.at(state.x_m, state.y_m, state.yaw_rad);
  if (!patch.known) {
    TrajectoryPoint point = point_of(state, strain, time_s, patch, {});
    point.z_m = point.demand_n = point.tip_over_margin = kNone;
    return {.point = point, .rejected = rejection};
  }
  const StateMargins found = margins(state, patch);
  return {.point = point_of(state, strain, time_s, patch, found),
          .rejected = rejection ? rejection
                                : rejected_by(found, problem_.limits.margin_min, at_state(state))};
}

TrajectoryPoint World::describe(const VehicleState& state, const WheelStrain& strain,
                                double time_s) const {
  const GroundPatch patch = ground_.at(state.x_m, state.y_m, state.yaw_rad);
  return point_of(state, strain, time_s, patch, margins(state, patch));
}

TrajectoryPoint World::point_of(const VehicleState& state, const WheelStrain& strain, double time_s,
                                const GroundPatch& patch, const StateMargins& margins) const {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {.time_s = time_s,
          .x_m = state.x_m,
          .y_m = state.y_m,
          .z_m = patch.z_m,
          .yaw_rad = state.yaw_rad,
          .speed_mps = state.motion.vx_mps,
          .yaw_rate_rad_s = state.motion.yaw_rate_rad_s,
          .steer_rad = largest_by_magnitude(problem_.vehicle, state.curvature_1pm),
          .curvature_1pm = state.curvature_1pm,
          .acceleration_mps2 = state.rim_acceleration_mps2,
          .slip_max = strain.slip,
          .slip_angle_max_rad = strain.slip_angle_rad,
          .sinkage_max_m = strain.sinkage_m,
          .torque_max_nm = strain.torque_max_nm,
          .soil = problem_.map.soil_index(state.x_m, state.y_m).value_or(-1),
          .demand_n = margins.demand_n,
          .supply_min_n = margins.supply ? margins.supply->right_n : kNone,
          .supply_max_n = margins.supply ? margins.supply->left_n : kNone,
          .cornering_margin = margins.cornering.value_or(kNone),
          .tip_over_margin = margins.tip_over,
          .traction_margin = margins.traction.value_or(kNone),
          .margin = margins.stability().value_or(kNone)};
}

}  // namespace regoplan
