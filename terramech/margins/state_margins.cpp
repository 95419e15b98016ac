#include "terramech/margins/state_margins.h"

#include <algorithm>
#include <cmath>

namespace regoplan {

std::optional<double> StateMargins::stability() const {
  if (!cornering || !traction) return std::nullopt;
  return std::min({*cornering, *traction, tip_over});
}

double StateMargins::counted_cornering() const {
  return cornering.value_or(-1);
}

double StateMargins::counted_traction() const {
  return traction.value_or(std::min(counted_cornering(), 0.0));
}

SupplyAnswer SolvedSupply::answer(const SupplyQuestion& question) const {
  if (!(question.normal_n > 0)) return {};  // off the ground
  std::vector<WheelLaw> laws;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    laws.push_back(soil_laws_[static_cast<std::size_t>(question.patch->soil[i])]);
  }
  const SteadyManoeuvre manoeuvre = manoeuvre_of(vehicle_, sharing_, laws, question);
  const SupplyResult result = cornering_supply(manoeuvre, question.force.forward_n, limits_);
  SupplyAnswer answer{
      .supply = {}, .no_supply = result.reason, .too_deep = result.too_deep, .traction_n = {}};
  if (result.supply) {
    answer.supply = SupplyInterval{.right_n = result.supply->right.force_n,
                                   .left_n = result.supply->left.force_n};
    answer.traction_n = largest_traction_n(manoeuvre, question.force, limits_);
  }
  return answer;
}

SupplyAnswer TabledSupply::answer(const SupplyQuestion& question, std::size_t wheels) const {
  if (question.reverse || question.crab_rad != 0 || question.turn != 0) return {};
  SupplyAnswer least;
  for (std::size_t i = 0; i < wheels; ++i) {
    const bool first = i == 0;
    if (!first && question.patch->soil[i] == question.patch->soil[i - 1]) continue;
    const SupplyTable& table = tables_[static_cast<std::size_t>(question.patch->soil[i])];
    const auto supply =
        table.supply(question.curvature_1pm, question.force.forward_n, question.normal_n);
    if (!supply) return {};
    const auto traction =
        table.traction_n(question.curvature_1pm, question.force.left_n, question.normal_n);
    if (first) {
      least = {.supply = supply, .traction_n = traction};
      continue;
    }
    least.supply = SupplyInterval{.right_n = std::max(least.supply->right_n, supply->right_n),
                                  .left_n = std::min(least.supply->left_n, supply->left_n)};
    if (least.traction_n && traction) {
      least.traction_n = std::min(*least.traction_n, *traction);
    } else {
      least.traction_n.reset();
    }
  }
  return least;
}

namespace {

bool drives_in_reverse(const VehicleState& state) {
  if (state.rim_speed_mps != 0) return state.rim_speed_mps < 0;
  if (state.direction_at_rest != 0) return state.direction_at_rest < 0;
  if (state.motion.vx_mps != 0) return state.motion.vx_mps < 0;
  return state.rim_acceleration_mps2 < 0;
}

}  // namespace

SteadyManoeuvre manoeuvre_of(const Vehicle& vehicle, const LoadSharing& sharing,
                             std::span<const WheelLaw> laws, const SupplyQuestion& question) {
  if (question.turn != 0) {
    return SteadyManoeuvre::turn_on_the_spot(vehicle, sharing, laws, question.normal_n,
                                             question.turn > 0);
  }
  return {vehicle,          sharing,          laws, question.curvature_1pm, question.normal_n,
          question.reverse, question.crab_rad};
}

SupplyQuestion question_of(const VehicleDynamics& dynamics, const VehicleState& state,
                           const GroundPatch& patch) {
  const Vehicle& vehicle = dynamics.vehicle();
  const PatchAxes axes(patch, dynamics.gravity_mps2());
  if (state.turn_rate_rad_s != 0) {
    const double centripetal =
        state.turn_rate_rad_s * state.turn_rate_rad_s * vehicle.turn_centre_x_m;
    return {.force = {.forward_n = vehicle.mass_kg * (centripetal - axes.gravity_forward_mps2),
                      .left_n = -vehicle.mass_kg * axes.gravity_left_mps2},
            .normal_n = vehicle.mass_kg * axes.gravity_normal_mps2,
            .turn = state.turn_rate_rad_s > 0 ? 1 : -1,
            .patch = &patch};
  }
  const double slip_free =
      kinematic_body_slip_angle_rad(vehicle, state.curvature_1pm) + state.crab_rad;
  const double c = std::cos(slip_free), s = std::sin(slip_free);
  const double gravity_forward = c * axes.gravity_forward_mps2 + s * axes.gravity_left_mps2;
  const double gravity_left = c * axes.gravity_left_mps2 - s * axes.gravity_forward_mps2;
  const double speed = std::hypot(state.motion.vx_mps, state.motion.vy_mps);
  return {.curvature_1pm = state.curvature_1pm,
          .crab_rad = state.crab_rad,
          .force = {.forward_n = vehicle.mass_kg * (state.rim_acceleration_mps2 - gravity_forward),
                    .left_n = cornering_demand_n(vehicle.mass_kg, speed, state.curvature_1pm,
                                                 gravity_left)},
          .normal_n = vehicle.mass_kg *
                      (axes.gravity_normal_mps2 + speed * speed * c * c * patch.curvature_1pm),
          .reverse = drives_in_reverse(state),
          .patch = &patch};
}

StateMargins margins_of(const VehicleDynamics& dynamics, const SupportPolygon& polygon,
                        const SupplyQuestion& question, const SupplyAnswer& answer) {
  const double weight = dynamics.vehicle().mass_kg * dynamics.gravity_mps2();
  const double slip_free =
      kinematic_body_slip_angle_rad(dynamics.vehicle(), question.curvature_1pm) + question.crab_rad;
  const double c = std::cos(slip_free), s = std::sin(slip_free);
  const PathForce& force = question.force;
  // What the soil does not give does not tip the vehicle: it slides instead.
  const double left_n =
      answer.supply ? std::clamp(force.left_n, answer.supply->right_n, answer.supply->left_n)
                    : force.left_n;
  StateMargins margins{
      .demand_n = force.left_n,
      .supply = answer.supply,
      .no_supply = answer.no_supply,
      .too_deep = answer.too_deep,
      .tip_over = polygon.tip_over_margin({.normal_n = question.normal_n,
                                           .forward_n = c * force.forward_n - s * left_n,
                                           .left_n = s * force.forward_n + c * left_n}),
      .cornering = {},
      .traction = {}};
  if (answer.supply) {
    margins.cornering =
        cornering_margin(force.left_n, answer.supply->right_n, answer.supply->left_n, weight);
  }
  if (answer.traction_n) {
    const double needed_n = question.turn != 0 ? 0
                            : question.reverse ? -force.forward_n
                                               : force.forward_n;
    margins.traction = (*answer.traction_n - needed_n) / weight;
  }
  return margins;
}

}  // namespace regoplan
