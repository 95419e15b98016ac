#pragma once

#include <array>
#include <vector>

#include "driving/drive_truth.h"
#include "driving/driven_world.h"

namespace regoplan::drives {

/// A vehicle that drives on the equations of reference.md by code of its own: stress integrals,
/// sinkage, wheel loads, steering geometry and integration share nothing with `terramech` but the
/// structures that describe vehicle, soil and state. Ground: the plane under the wheels, as the map
/// tells it.
///
/// Wheel: Gauss-Legendre quadrature on both sides of the angle of the largest stress, the sinkage
/// by the secant method. Body: Newton's equations in the plane of the ground, by TR-BDF2, in halved
/// steps where that finds no balance; load transfer and the fading of forces near standstill as the
/// physics that both simulators are to agree in. For vehicles whose every wheel is driven at its
/// kinematic speed, and that roll forward.
///
/// What a truth conceals of the vehicle: drags, offsets of steering and motor constants of wheels,
/// a payload, a centre of gravity elsewhere. Newton's equations are those of the true centre of
/// gravity, the steering is that of the known vehicle.
class IndependentSimulator : public DrivenWorld {
 public:
  /// \param vehicle as it is known; must outlive it \param soils that the ground tells by index
  /// \param ground of a place and heading \param truth of the vehicle; its ground is not asked
  IndependentSimulator(const Vehicle& vehicle, std::vector<Soil> soils, double gravity_mps2,
                       VehicleDynamics::Ground ground, double longest_step_s,
                       const DriveTruth& truth = {});

  const Vehicle& known_vehicle() const override { return vehicle_; }
  StepResult step(const VehicleState& state, const VehicleControl& control,
                  double duration_s) const override;
  std::vector<WheelNow> wheels(const VehicleState& state) const override;
  GroundPatch ground(const VehicleState& state) const override;
  /// Not judged here. \throws std::logic_error
  StateMargins margins(const VehicleState& state, const GroundPatch& patch) const override;
  bool at_rest(const VehicleState& state) const override;
  PathPoint on_the_map(double x_m, double y_m) const override {
    return {x_m - truth_.map_east_m, y_m - truth_.map_north_m};
  }
  double motor_constant_factor(std::size_t wheel) const override {
    return faults_[wheel].motor_constant_factor;
  }

  struct WheelAnswer {
    double along_n = 0;  ///< force on the wheel along its heading
    double left_n = 0;   ///< and to its left
    double torque_nm = 0;
    double sinkage_m = 0;
    bool carried = true;  ///< some sinkage below the radius carries the load
  };
  /// \param load_n above 0 \param along_mps, left_mps velocity of the contact \param rim_mps r w
  WheelAnswer wheel(const Soil& soil, double load_n, double along_mps, double left_mps,
                    double rim_mps) const;

 private:
  struct Motion {
    double along = 0, left = 0, turn = 0;  ///< body velocities
  };
  struct Sum {
    double along = 0, left = 0, moment = 0;
  };
  struct Posture;
  Sum forces(const Motion& motion, const Posture& posture, double transfer_along,
             double transfer_left, std::vector<WheelNow>* wheels) const;
  StepResult halved_substep(const VehicleState& state, const VehicleControl& control, double h,
                            int halvings) const;
  StepResult substep(const VehicleState& state, const VehicleControl& control, double h) const;
  double load(std::size_t wheel, double normal, double along, double left) const;
  VehicleState moved(VehicleState state, double sign) const;

  const Vehicle& vehicle_;  ///< as it is known
  DriveTruth truth_;
  std::vector<WheelFault> faults_;
  Vehicle carried_;  ///< the true one, told from its own centre of gravity
  std::vector<Soil> soils_;
  double gravity_;
  VehicleDynamics::Ground ground_;
  double longest_step_s_;
  mutable double last_sinkage_m_ = 0.01;  ///< where the next search begins; no result hangs on it
  std::vector<std::array<double, 3>> shares_;  ///< of the normal, along and lateral force
};

}  // namespace regoplan::drives
