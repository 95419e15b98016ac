#pragma once

#include <ompl/control/ControlSampler.h>
#include <ompl/control/DirectedControlSampler.h>

#include "planner/certificate/cost_to_go.h"
#include "planner/problem/world.h"

namespace regoplan {

class OmplProblem;

/// Curvature whose centripetal force the soil under the vehicle can give on level ground, with
/// margin to spare, within the steering. \param world of a search
double curvature_reach_1pm(const World& world, double x_m, double y_m, double speed_mps);

/// The speed at which the tightest turn is what the soil there can hold: none turns the vehicle
/// faster.
double fastest_turning_mps(const World& world, double x_m, double y_m);

/// A speed target: half of the time the fastest that stays below the limit downhill.
double drawn_speed_mps(const PlanningProblem& problem, ompl::RNG& random);

/// A speed as above and a curvature within its reach, mostly gentle.
VehicleControl drawn_control(const World& world, const VehicleState& from, ompl::RNG& random);

/// Where to steer for on the cheapest way: as far ahead as the vehicle needs to turn in.
CostToGo::Place aim(const World& world, const CostToGo& way, const VehicleState& state,
                    double speed_mps, ompl::RNG& random);

/// Pure pursuit of a place, within the reach of the speed.
VehicleControl control_toward(const World& world, const VehicleState& state, double x_m, double y_m,
                              double speed_mps);

/// Controls that steer: a curvature drawn among those whose centripetal force the soil
/// there can give on the flat at the speed drawn, half of the time toward the goal where the
/// state is known.
class SteeringSampler : public ompl::control::ControlSampler {
 public:
  SteeringSampler(const ompl::control::ControlSpace* space, const World& world,
                  const CostToGo& way);

  void sample(ompl::control::Control* control) override;
  void sample(ompl::control::Control* control, const ompl::base::State* state) override;
  void sampleNext(ompl::control::Control* control, const ompl::control::Control* previous,
                  const ompl::base::State* state) override;

 private:
  const World& world_;
  const CostToGo& way_;
};

/// Drives from one state toward another, or half of the time along the cheapest way to the goal:
/// pure pursuit at several speeds, and some free tries; the motion that comes nearest wins. Those
/// that arrive at the goal come before all.
class PursuitSampler : public ompl::control::DirectedControlSampler {
 public:
  /// \param problem must outlive it
  PursuitSampler(const ompl::control::SpaceInformation* si, OmplProblem& problem);

  unsigned int sampleTo(ompl::control::Control* control, const ompl::base::State* source,
                        ompl::base::State* target) override;
  unsigned int sampleTo(ompl::control::Control* control, const ompl::control::Control* previous,
                        const ompl::base::State* source, ompl::base::State* target) override;

 private:
  /// Propagates while valid; stops at the goal. \returns steps done
  unsigned int drive(const ompl::control::Control* control, const ompl::base::State* source,
                     unsigned int steps, ompl::base::State* result) const;

  OmplProblem& problem_;
  const World& world_;
  const CostToGo& way_;
  ompl::RNG rng_;
};

/// The curvature of the circle through a state, tangent to its heading, that meets a point; limited
/// to what the vehicle can steer.
double pursuit_curvature_1pm(const VehicleState& state, double x_m, double y_m,
                             double curvature_max_1pm);

}  // namespace regoplan
