#pragma once

#include <ompl/base/StateSpace.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <memory>
#include <optional>

#include "maps/terrain_map.h"
#include "terramech/vehicle/vehicle_dynamics.h"

namespace regoplan {

/// OMPL's view of the states of a vehicle on a map. The metric is symmetric: distance on the map
/// plus weighted differences of heading and speed, in metres. Each state carries the strain of the
/// step that led to it, which validity needs and the dynamics knows anyway.
///
/// Under a bound of the cost it is state-cost space (Hauser and Zhou 2016): the cost of the way to
/// a state is a coordinate of it, drawn and measured like the others.
class VehicleSpace : public ompl::base::StateSpace {
 public:
  struct Values {
    VehicleState vehicle;
    WheelStrain strain;
    bool possible = true;  ///< false where the dynamics found no such state
    double cost = 0;       ///< of the way there, by the objective, where planners count it
  };
  /// OMPL forbids copying states; their values may be.
  class StateType : public ompl::base::State, public Values {};

  /// How much a radian of heading and a share of the top speed count, metres.
  struct Weights {
    double heading_m_per_rad = 1;
    double speed_m = 0.5;
  };

  /// The coordinate of the cost: up to a bound, and how much a unit of it counts.
  struct CostAxis {
    double below = 0;
    double metres = 0;
  };

  VehicleSpace(const GridFrame& frame, double speed_max_mps, const Weights& weights);

  /// From here on the cost is a coordinate. Not while a planner runs.
  void set_cost_axis(const CostAxis& axis) { cost_axis_ = axis; }
  const std::optional<CostAxis>& cost_axis() const { return cost_axis_; }

  unsigned int getDimension() const override { return 5; }
  double getMaximumExtent() const override;
  double getMeasure() const override;
  void enforceBounds(ompl::base::State* state) const override;
  bool satisfiesBounds(const ompl::base::State* state) const override;
  void copyState(ompl::base::State* to, const ompl::base::State* from) const override;
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override;
  bool equalStates(const ompl::base::State* a, const ompl::base::State* b) const override;
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override;
  unsigned int getSerializationLength() const override { return sizeof(Values); }
  /// Keeps everything that a state holds, strain and cost included.
  void serialize(void* bytes, const ompl::base::State* state) const override;
  void deserialize(ompl::base::State* state, const void* bytes) const override;
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;
  ompl::base::State* allocState() const override { return new StateType; }
  void freeState(ompl::base::State* state) const override;
  void registerProjections() override;

  /// The vehicle of a state of this space.
  static const VehicleState& vehicle(const ompl::base::State* state) {
    return state->as<StateType>()->vehicle;
  }

  const GridFrame& frame() const { return frame_; }
  double speed_max_mps() const { return speed_max_mps_; }

 private:
  GridFrame frame_;
  double speed_max_mps_;
  Weights weights_;
  std::optional<CostAxis> cost_axis_;
};

/// Controls: speed target and curvature target.
class VehicleControlSpace : public ompl::control::RealVectorControlSpace {
 public:
  VehicleControlSpace(const ompl::base::StateSpacePtr& states, double speed_min_mps,
                      double speed_max_mps, double curvature_max_1pm);

  static VehicleControl control(const ompl::control::Control* control);
  static void set(ompl::control::Control* control, const VehicleControl& value);
};

}  // namespace regoplan
