#include "planner/ompl/vehicle_space.h"

#include <ompl/base/ProjectionEvaluator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <type_traits>

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

double angle_between(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi));
}

/// Uniform over map, heading and speed; velocities are those of slip-free straight driving.
class UniformSampler : public ob::StateSampler {
 public:
  explicit UniformSampler(const VehicleSpace* space)
      : ob::StateSampler(space),
        frame_(space->frame()),
        speed_max_(space->speed_max_mps()),
        cost_axis_(space->cost_axis()) {}

  void sampleUniform(ob::State* state) override {
    set(state, rng_.uniformReal(frame_.west_m, frame_.east_m()),
        rng_.uniformReal(frame_.south_m(), frame_.north_m),
        rng_.uniformReal(-std::numbers::pi, std::numbers::pi),
        rng_.uniformReal(0.5 * speed_max_, speed_max_));
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    const VehicleState& v = VehicleSpace::vehicle(near);
    set(state, v.x_m + rng_.uniformReal(-distance, distance),
        v.y_m + rng_.uniformReal(-distance, distance), v.yaw_rad + rng_.uniformReal(-1, 1),
        rng_.uniformReal(0.5 * speed_max_, speed_max_));
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    const VehicleState& v = VehicleSpace::vehicle(mean);
    set(state, rng_.gaussian(v.x_m, deviation), rng_.gaussian(v.y_m, deviation),
        rng_.gaussian(v.yaw_rad, 0.5), rng_.uniformReal(0.5 * speed_max_, speed_max_));
  }

 private:
  void set(ob::State* state, double x, double y, double yaw, double speed) {
    auto* typed = state->as<VehicleSpace::StateType>();
    typed->vehicle = {.x_m = x,
                      .y_m = y,
                      .yaw_rad = std::remainder(yaw, 2 * std::numbers::pi),
                      .motion = {.vx_mps = speed},
                      .rim_speed_mps = speed};
    typed->strain = {};
    typed->possible = true;
    typed->cost = cost_axis_ ? rng_.uniformReal(0, cost_axis_->below) : 0;
  }

  GridFrame frame_;
  double speed_max_;
  std::optional<VehicleSpace::CostAxis> cost_axis_;
};

/// Position on the map: what tree planners spread over.
class MapProjection : public ob::ProjectionEvaluator {
 public:
  explicit MapProjection(const VehicleSpace* space)
      : ob::ProjectionEvaluator(space), frame_(space->frame()) {}

  unsigned int getDimension() const override { return 2; }
  void defaultCellSizes() override {
    constexpr double kCells = 40;
    const double size =
        std::min(frame_.east_m() - frame_.west_m, frame_.north_m - frame_.south_m()) / kCells;
    cellSizes_ = {size, size};
    bounds_.resize(2);
    bounds_.low = {frame_.west_m, frame_.south_m()};
    bounds_.high = {frame_.east_m(), frame_.north_m};
  }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    projection[0] = VehicleSpace::vehicle(state).x_m;
    projection[1] = VehicleSpace::vehicle(state).y_m;
  }

 private:
  GridFrame frame_;
};

}  // namespace

VehicleSpace::VehicleSpace(const GridFrame& frame, double speed_max_mps, const Weights& weights)
    : frame_(frame), speed_max_mps_(speed_max_mps), weights_(weights) {
  setName("VehicleOnMap");
  type_ = ob::STATE_SPACE_UNKNOWN;
}

double VehicleSpace::getMaximumExtent() const {
  return std::hypot(frame_.east_m() - frame_.west_m, frame_.north_m - frame_.south_m()) +
         weights_.heading_m_per_rad * std::numbers::pi + 2 * weights_.speed_m +
         (cost_axis_ ? cost_axis_->metres * cost_axis_->below : 0);
}

double VehicleSpace::getMeasure() const {
  return (frame_.east_m() - frame_.west_m) * (frame_.north_m - frame_.south_m());
}

void VehicleSpace::enforceBounds(ob::State* /*state*/) const {
  // The dynamics alone makes states; one outside the map is rejected, not moved.
}

bool VehicleSpace::satisfiesBounds(const ob::State* state) const {
  const VehicleState& v = VehicleSpace::vehicle(state);
  return state->as<StateType>()->possible && regoplan::covers(frame_, v.x_m, v.y_m);
}

void VehicleSpace::copyState(ob::State* to, const ob::State* from) const {
  static_cast<Values&>(*to->as<StateType>()) = *from->as<StateType>();
}

double VehicleSpace::distance(const ob::State* a, const ob::State* b) const {
  const VehicleState& va = VehicleSpace::vehicle(a);
  const VehicleState& vb = VehicleSpace::vehicle(b);
  const double dearer = std::abs(a->as<StateType>()->cost - b->as<StateType>()->cost);
  return std::hypot(va.x_m - vb.x_m, va.y_m - vb.y_m) +
         weights_.heading_m_per_rad * angle_between(va.yaw_rad, vb.yaw_rad) +
         weights_.speed_m * std::abs(va.motion.vx_mps - vb.motion.vx_mps) / speed_max_mps_ +
         (cost_axis_ ? cost_axis_->metres * dearer : 0);
}

bool VehicleSpace::equalStates(const ob::State* a, const ob::State* b) const {
  const VehicleState& va = VehicleSpace::vehicle(a);
  const VehicleState& vb = VehicleSpace::vehicle(b);
  return va.x_m == vb.x_m && va.y_m == vb.y_m && va.yaw_rad == vb.yaw_rad &&
         va.motion.vx_mps == vb.motion.vx_mps && va.motion.vy_mps == vb.motion.vy_mps &&
         va.motion.yaw_rate_rad_s == vb.motion.yaw_rate_rad_s &&
         va.curvature_1pm == vb.curvature_1pm && va.rim_speed_mps == vb.rim_speed_mps;
}

void VehicleSpace::interpolate(const ob::State* from, const ob::State* to, double t,
                               ob::State* state) const {
  const Values a = *from->as<StateType>();
  const Values b = *to->as<StateType>();
  Values& between = *state->as<StateType>();
  between = t < 1 ? a : b;
  VehicleState& v = between.vehicle;
  v.x_m = a.vehicle.x_m + t * (b.vehicle.x_m - a.vehicle.x_m);
  v.y_m = a.vehicle.y_m + t * (b.vehicle.y_m - a.vehicle.y_m);
  v.yaw_rad = a.vehicle.yaw_rad +
              t * std::remainder(b.vehicle.yaw_rad - a.vehicle.yaw_rad, 2 * std::numbers::pi);
  v.motion.vx_mps =
      a.vehicle.motion.vx_mps + t * (b.vehicle.motion.vx_mps - a.vehicle.motion.vx_mps);
}

void VehicleSpace::serialize(void* bytes, const ob::State* state) const {
  static_assert(std::is_trivially_copyable_v<Values>);
  const Values& values = *state->as<StateType>();
  std::memcpy(bytes, &values, sizeof(Values));
}

void VehicleSpace::deserialize(ob::State* state, const void* bytes) const {
  Values values;
  std::memcpy(&values, bytes, sizeof(Values));
  static_cast<Values&>(*state->as<StateType>()) = values;
}

ob::StateSamplerPtr VehicleSpace::allocDefaultStateSampler() const {
  return std::make_shared<UniformSampler>(this);
}

void VehicleSpace::freeState(ob::State* state) const {
  delete state->as<StateType>();
}

void VehicleSpace::registerProjections() {
  registerDefaultProjection(std::make_shared<MapProjection>(this));
}

VehicleControlSpace::VehicleControlSpace(const ob::StateSpacePtr& states, double speed_min_mps,
                                         double speed_max_mps, double curvature_max_1pm)
    : oc::RealVectorControlSpace(states, 2) {
  ob::RealVectorBounds bounds(2);
  bounds.low = {speed_min_mps, -curvature_max_1pm};
  bounds.high = {speed_max_mps, curvature_max_1pm};
  setBounds(bounds);
}

VehicleControl VehicleControlSpace::control(const oc::Control* control) {
  const auto* values = control->as<ControlType>()->values;
  return {.speed_target_mps = values[0], .curvature_target_1pm = values[1]};
}

void VehicleControlSpace::set(oc::Control* control, const VehicleControl& value) {
  auto* values = control->as<ControlType>()->values;
  values[0] = value.speed_target_mps;
  values[1] = value.curvature_target_1pm;
}

}  // namespace regoplan
