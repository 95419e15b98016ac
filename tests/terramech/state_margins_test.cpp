#include "terramech/margins/state_margins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

/// A vehicle that moves on a plane of one soil.
struct Driving {
  VehicleOnSoil on;
  VehicleDynamics dynamics;
  SupportPolygon polygon;
  SolvedSupply supply;

  explicit Driving(const std::string& preset, const Plane& plane = {},
                   const Soil& soil = firm_regolith())
      : on(preset, soil),
        dynamics(on.vehicle, on.soil_laws, plane, on.gravity_mps2),
        polygon(on.vehicle),
        supply(on.vehicle, on.sharing, on.soil_laws, limits_of(on.vehicle)) {}

  SupplyQuestion question(const VehicleState& state, const GroundPatch& patch) const {
    return question_of(dynamics, state, patch);
  }
  StateMargins margins(const VehicleState& state) const {
    const GroundPatch patch = dynamics.ground(state.x_m, state.y_m, state.yaw_rad);
    const SupplyQuestion asked = question(state, patch);
    return margins_of(dynamics, polygon, asked, supply.answer(asked));
  }
};

TEST(Demand, OfAFlatTurnIsCentripetal) {
  const Driving lrv("lrv");
  const double m = lrv.on.vehicle.mass_kg;
  const GroundPatch flat = patch_with(0, 0);
  for (const double k : {0.1, -0.1}) {
    const SupplyQuestion asked = lrv.question(lrv.dynamics.rolling_state(0, 0, 0.3, 3, k), flat);
    EXPECT_NEAR(asked.force.left_n, m * 9 * k, 1e-9);
    EXPECT_NEAR(asked.force.forward_n, 0, 1e-9);
    EXPECT_NEAR(asked.normal_n, m * kMoon_mps2, 1e-9);
    EXPECT_EQ(asked.curvature_1pm, k);
  }
}

TEST(Demand, OfRadiiTenAndTwentyAtThreeMetresASecondIsThatOfTheTable) {
  const Driving lrv("lrv");
  const GroundPatch flat = patch_with(0, 0);
  const auto share = [&](double radius_m) {
    return lrv.question(lrv.dynamics.rolling_state(0, 0, 0, 3, 1 / radius_m), flat).force.left_n /
           lrv.on.weight_n();
  };
  EXPECT_NEAR(share(10), 0.56, 0.005);
  EXPECT_NEAR(share(20), 0.28, 0.005);
}

TEST(Demand, StraightAcrossASlopeHoldsTheVehicleUphill) {
  const Driving lrv("lrv");
  const double angle = 15 * kDegree, weight = lrv.on.weight_n();
  const VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 1);
  const SupplyQuestion left_high = lrv.question(state, patch_with(0, std::tan(angle)));
  EXPECT_NEAR(left_high.force.left_n, weight * std::sin(angle), 1e-9);
  EXPECT_NEAR(left_high.normal_n, weight * std::cos(angle), 1e-9);
  const SupplyQuestion right_high = lrv.question(state, patch_with(0, -std::tan(angle)));
  EXPECT_NEAR(right_high.force.left_n, -weight * std::sin(angle), 1e-9);
}

TEST(Demand, OfATurnOnASideSlopeIsSigned) {
  const Driving lrv("lrv");
  const double angle = 15 * kDegree, m = lrv.on.vehicle.mass_kg, g = kMoon_mps2;
  const GroundPatch left_high = patch_with(0, std::tan(angle));
  const auto demand = [&](double k) {
    return lrv.question(lrv.dynamics.rolling_state(0, 0, 0, 3, k), left_high).force.left_n;
  };
  EXPECT_NEAR(demand(0.05), m * (9 * 0.05 + g * std::sin(angle)), 1e-9);    // uphill: both add
  EXPECT_NEAR(demand(-0.05), m * (-9 * 0.05 + g * std::sin(angle)), 1e-9);  // gravity turns it
}

TEST(Demand, OfATurnWithBodySlipIsTakenAcrossThePath) {
  // The turn centre of Curiosity lies off its origin: the path leaves the heading by an angle, and
  // uphill becomes partly sideways.
  const Driving rover("curiosity");
  const double k = 0.5, angle = 10 * kDegree, g = rover.on.gravity_mps2, m = 899;
  const double off = std::asin(k * 0.089);
  const SupplyQuestion asked = rover.question(rover.dynamics.rolling_state(0, 0, 0, 0.04, k),
                                              patch_with(std::tan(angle), 0));
  EXPECT_NEAR(asked.force.left_n, m * (0.0016 * k - g * std::sin(angle) * std::sin(off)), 1e-9);
  EXPECT_NEAR(asked.force.forward_n, m * g * std::sin(angle) * std::cos(off), 1e-9);
}

TEST(Demand, ForwardIsCommandedAccelerationAndSlope) {
  const Driving lrv("lrv");
  const double angle = 12 * kDegree, m = lrv.on.vehicle.mass_kg;
  VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 1);
  state.rim_acceleration_mps2 = 0.2;
  const SupplyQuestion up = lrv.question(state, patch_with(std::tan(angle), 0));
  EXPECT_NEAR(up.force.forward_n, m * (0.2 + kMoon_mps2 * std::sin(angle)), 1e-9);
  const SupplyQuestion down = lrv.question(state, patch_with(-std::tan(angle), 0));
  EXPECT_NEAR(down.force.forward_n, m * (0.2 - kMoon_mps2 * std::sin(angle)), 1e-9);
}

TEST(Demand, OfReverseTurnsLeansToTheCommandedSideToo) {
  const Driving lrv("lrv");
  const SupplyQuestion asked =
      lrv.question(lrv.dynamics.rolling_state(0, 0, 0, -2, 0.1), patch_with(0, 0));
  EXPECT_TRUE(asked.reverse);
  EXPECT_NEAR(asked.force.left_n, lrv.on.vehicle.mass_kg * 4 * 0.1, 1e-9);
}

TEST(StateMargins, StabilityIsTheSmallestOfTheThree) {
  StateMargins margins;
  margins.tip_over = 0.5;
  EXPECT_FALSE(margins.stability());
  margins.cornering = 0.3;
  EXPECT_FALSE(margins.stability());
  margins.traction = 0.4;
  EXPECT_EQ(margins.stability(), 0.3);
  margins.traction = 0.1;
  EXPECT_EQ(margins.stability(), 0.1);
  margins.tip_over = -0.2;
  EXPECT_EQ(margins.stability(), -0.2);
}

TEST(StateMargins, CountBeyondTheSupplyByTheCorneringThatIsShort) {
  StateMargins margins;
  EXPECT_EQ(margins.counted_cornering(), -1);
  EXPECT_EQ(margins.counted_traction(), -1);
  margins.cornering = -0.009;
  EXPECT_EQ(margins.counted_traction(), -0.009);
  margins.cornering = 0.2;
  EXPECT_EQ(margins.counted_traction(), 0);
  margins.traction = 0.3;
  EXPECT_EQ(margins.counted_cornering(), 0.2);
  EXPECT_EQ(margins.counted_traction(), 0.3);
}

TEST(StateMargins, AreThoseOfTheSteadyManoeuvre) {
  const Driving lrv("lrv");
  const VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 3, 1.0 / 20);
  const StateMargins margins = lrv.margins(state);
  const Supply supply = *lrv.on.supply(1.0 / 20).supply;
  const double demand = 700 * 9.0 / 20, weight = lrv.on.weight_n();
  EXPECT_NEAR(*margins.cornering,
              std::min(supply.left.force_n - demand, demand - supply.right.force_n) / weight, 1e-9);
  EXPECT_NEAR(margins.tip_over, 1 - demand * 0.8 / (weight * 0.9145), 1e-9);
  EXPECT_NEAR(*margins.traction,
              *largest_traction_n(lrv.on.manoeuvre(1.0 / 20), {.left_n = demand},
                                  limits_of(lrv.on.vehicle)) /
                  weight,
              1e-9);
}

TEST(StateMargins, TipOverVanishesAtTheStaticAngleOfASideSlope) {
  const Driving lrv("lrv");
  const VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 0);
  for (const double side : {-1.0, 1.0}) {
    const GroundPatch patch = patch_with(0, side * 0.9145 / 0.8);
    const StateMargins margins =
        margins_of(lrv.dynamics, lrv.polygon, lrv.question(state, patch), {});
    EXPECT_NEAR(margins.tip_over, 0, 1e-12);
  }
}

TEST(StateMargins, OnASideSlopeTurningUphillIsWorseThanDownhill) {
  const Driving lrv("lrv", Plane{0, std::tan(15 * kDegree)});
  const StateMargins uphill = lrv.margins(lrv.dynamics.rolling_state(0, 0, 0, 2, 0.05));
  const StateMargins downhill = lrv.margins(lrv.dynamics.rolling_state(0, 0, 0, 2, -0.05));
  ASSERT_TRUE(uphill.stability() && downhill.stability());
  EXPECT_LT(*uphill.cornering, *downhill.cornering - 0.2);
  EXPECT_LT(uphill.tip_over, downhill.tip_over);
}

/// Direction of travel on the map.
double path_angle_rad(const VehicleState& state) {
  return state.yaw_rad + std::atan2(state.motion.vy_mps, state.motion.vx_mps);
}

TEST(StateMargins, AVehicleThatPloughsStraightOnAtFullLockIsRejectedForCornering) {
  const Driving lrv("lrv", {}, soft_patch());
  const double lock = lrv.on.vehicle.curvature_max_1pm, step_s = 0.05;
  VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 4);
  int ploughs = 0;
  for (int i = 0; i < 60; ++i) {
    const StepResult next =
        lrv.dynamics.step(state, {.speed_target_mps = 4, .curvature_target_1pm = lock}, step_s);
    ASSERT_TRUE(next.converged);
    const double turned =
        std::remainder(path_angle_rad(next.state) - path_angle_rad(state), 2 * std::numbers::pi);
    state = next.state;
    const double speed = std::hypot(state.motion.vx_mps, state.motion.vy_mps);
    const double realised_1pm = turned / (speed * step_s);
    if (state.curvature_1pm < 0.1 || realised_1pm > 0.5 * state.curvature_1pm) continue;
    ++ploughs;
    const StateMargins margins = lrv.margins(state);
    ASSERT_TRUE(margins.cornering) << i;
    EXPECT_LT(*margins.cornering, 0) << i;
    // By the path it takes it would be accepted: what it gets is by Newton's law what it has.
    const double realised_n = lrv.on.vehicle.mass_kg * speed * speed * realised_1pm;
    EXPECT_LT(realised_n, 0.6 * lrv.on.weight_n()) << i;
  }
  EXPECT_GT(ploughs, 20);
}

TEST(StateMargins, WithoutSupplyThereIsNoStability) {
  const Driving lrv("lrv", Plane{std::tan(40 * kDegree), 0});
  const StateMargins margins = lrv.margins(lrv.dynamics.rolling_state(0, 0, 0, 1));
  EXPECT_FALSE(margins.supply);
  EXPECT_EQ(margins.no_supply, NoSupply::kTraction);
  EXPECT_FALSE(margins.cornering || margins.traction || margins.stability());
}

TEST(StateMargins, DoNotDependOnWhichWayTheMapLies) {
  const Driving one("lrv", Plane{0.1, 0.2});
  const StateMargins east = one.margins(one.dynamics.rolling_state(0, 0, 0, 2, 0.05));
  const Driving other("lrv", Plane{-0.2, 0.1});  // turned left by 90 deg
  const StateMargins north =
      other.margins(other.dynamics.rolling_state(0, 0, 90 * kDegree, 2, 0.05));
  EXPECT_NEAR(*east.stability(), *north.stability(), 1e-9);
}

/// A turn on the spot at a heading on a plane.
StateMargins turn_margins(const Driving& rover, double rate_rad_s, double yaw_rad = 0) {
  VehicleState state = rover.dynamics.rolling_state(0, 0, yaw_rad, 0);
  state.turn_rate_rad_s = rate_rad_s;
  return rover.margins(state);
}

TEST(StateMargins, OfATurnOnTheSpotAreTheSameToEitherSide) {
  const Driving rover("curiosity");
  const StateMargins left = turn_margins(rover, 0.02), right = turn_margins(rover, -0.02);
  ASSERT_TRUE(left.stability() && right.stability());
  EXPECT_NEAR(*left.stability(), *right.stability(), 1e-12);
  EXPECT_EQ(left.demand_n, 0);
  EXPECT_GT(*left.traction, 0.2);
}

TEST(StateMargins, OfATurnOnTheSpotShrinkOnASlopeAtEveryHeading) {
  const Driving flat("curiosity"), slope("curiosity", Plane{std::tan(15 * kDegree), 0});
  for (int degrees = 0; degrees < 360; degrees += 45) {
    const StateMargins margins = turn_margins(slope, 0.02, degrees * kDegree);
    ASSERT_TRUE(margins.stability()) << degrees;
    EXPECT_LT(*margins.stability(), *turn_margins(flat, 0.02).stability() - 0.1) << degrees;
  }
  // Held by side forces when it stands across.
  const double weight = slope.on.weight_n();
  EXPECT_NEAR(std::abs(turn_margins(slope, 0.02, 90 * kDegree).demand_n),
              weight * std::sin(15 * kDegree), 1e-3 * weight);
}

TEST(StateMargins, OfATurnOnTheSpotEndWhereScrubIsBeyondTheWheels) {
  Vehicle vehicle = skid_steered();
  const auto traction = [](const Vehicle& on_it) {
    const VehicleOnSoil on(on_it, firm_regolith(), kMoon_mps2);
    const auto turn = SteadyManoeuvre::turn_on_the_spot(on.vehicle, on.sharing, on.wheel_laws,
                                                        on.weight_n(), true);
    return largest_traction_n(turn, {}, limits_of(on.vehicle)).value_or(-1) / on.weight_n();
  };
  vehicle.slip_angle_max_rad = 60 * kDegree;
  const double whole = traction(vehicle);
  EXPECT_GT(whole, 0.02);
  vehicle.torque_max_nm = 25;  // motors that scrub all but stalls
  EXPECT_LT(traction(vehicle), whole);
  vehicle.torque_max_nm.reset();
  for (WheelMount& wheel : vehicle.wheels) wheel.x_m *= 2.5;
  EXPECT_LT(traction(vehicle), 0);  // no trim: dragged at 51 deg, it spins
}

TEST(StateMargins, OfASkidSteeredVehicleAreAnswersAlsoWhereItCanHardlyClimb) {
  Vehicle vehicle = preset_vehicle("curiosity");
  vehicle.steering = Steering::kSkid;
  for (WheelMount& wheel : vehicle.wheels) wheel.steered = false;
  vehicle.steer_angle_max_rad = 0;
  vehicle.slip_angle_max_rad = 45 * kDegree;
  const VehicleOnSoil on(vehicle, loose_regolith(), home_gravity_mps2("curiosity"));
  const VehicleDynamics dynamics(on.vehicle, on.soil_laws, Plane{}, on.gravity_mps2);
  const SolvedSupply supply(on.vehicle, on.sharing, on.soil_laws, limits_of(on.vehicle));
  for (const double curvature_1pm : {0.0, 0.05}) {
    const VehicleState state = dynamics.rolling_state(0, 0, 0, 0.04, curvature_1pm);
    for (int left_deg = 10; left_deg <= 24; left_deg += 2) {
      for (const double forward_deg : {15, 20}) {
        const GroundPatch patch =
            patch_with(std::tan(forward_deg * kDegree), std::tan(left_deg * kDegree));
        EXPECT_NO_THROW(supply.answer(question_of(dynamics, state, patch)))
            << forward_deg << " deg uphill, " << left_deg << " deg across, " << curvature_1pm;
      }
    }
  }
}

TEST(StateMargins, DipsPressAndCrestsLift) {
  const Driving lrv("lrv");
  const VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 3, 0.05);
  const auto margins = [&](double curvature_1pm) {
    GroundPatch patch = patch_with(0, 0);
    patch.curvature_1pm = curvature_1pm;
    const SupplyQuestion asked = lrv.question(state, patch);
    EXPECT_NEAR(asked.normal_n, 700 * (kMoon_mps2 + 9 * curvature_1pm), 1e-9);
    return margins_of(lrv.dynamics, lrv.polygon, asked, lrv.supply.answer(asked));
  };
  const StateMargins flat = margins(0), dip = margins(0.04), crest = margins(-0.08);
  EXPECT_GT(*dip.cornering, *flat.cornering);
  EXPECT_GT(dip.tip_over, flat.tip_over);
  EXPECT_LT(*crest.cornering, *flat.cornering - 0.1);
  EXPECT_LT(crest.tip_over, flat.tip_over - 0.1);
  const StateMargins off = margins(-0.2);  // more than gravity holds
  EXPECT_EQ(off.tip_over, -1);
  EXPECT_FALSE(off.stability());
}

TEST(Demand, OfAVehicleAtRestIsReverseWhereItIsToReverse) {
  const Driving lrv("lrv");
  VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, 0, 0.1);
  EXPECT_FALSE(lrv.question(state, patch_with(0, 0)).reverse);
  state.rim_acceleration_mps2 = -0.3;
  EXPECT_TRUE(lrv.question(state, patch_with(0, 0)).reverse);
  state.motion.vx_mps = 0.5;  // brakes, rims at rest already
  EXPECT_FALSE(lrv.question(state, patch_with(0, 0)).reverse);
  state.motion.vx_mps = -0.5;
  state.rim_acceleration_mps2 = 0.3;
  EXPECT_TRUE(lrv.question(state, patch_with(0, 0)).reverse);
}

TEST(Demand, OfAVehicleThatCameToAStopIsThatOfTheDirectionItDroveIn) {
  const Driving lrv("lrv", {-0.2, 0});  // the ground falls away to the east
  for (const double direction : {1.0, -1.0}) {
    const double before_mps = direction * 0.01;
    VehicleState state = lrv.dynamics.rolling_state(0, 0, 0, before_mps);
    state.rim_acceleration_mps2 = -direction * 0.3;
    const StateMargins before = lrv.margins(state);
    state = lrv.dynamics.step(state, {}, 0.01 / 0.3).state;
    ASSERT_EQ(state.rim_speed_mps, 0);
    EXPECT_EQ(lrv.question(state, patch_with(-0.2, 0)).reverse, direction < 0);
    EXPECT_NEAR(lrv.margins(state).traction.value(), before.traction.value(), 0.01);
    EXPECT_NEAR(lrv.margins(state).cornering.value(), before.cornering.value(), 0.01);
    // Standing on, it is still the same stop, though it creeps the other way.
    state = lrv.dynamics.step(state, {}, 0.1).state;
    state.motion.vx_mps = -direction * 1e-4;
    EXPECT_EQ(lrv.question(state, patch_with(-0.2, 0)).reverse, direction < 0);
  }
}

TEST(SolvedSupply, TakesEachWheelsOwnSoil) {
  const VehicleOnSoil firm("lrv"), soft("lrv", soft_patch());
  const std::vector<WheelLaw> laws{WheelLaw(firm.model), WheelLaw(soft.model)};
  const SolvedSupply supply(firm.vehicle, firm.sharing, laws, limits_of(firm.vehicle));
  const auto left_n = [&](std::array<std::int16_t, kMaxWheels> soil) {
    GroundPatch patch = patch_with(0, 0);
    patch.soil = soil;
    return supply
        .answer({.curvature_1pm = 0, .force = {}, .normal_n = firm.weight_n(), .patch = &patch})
        .supply.value()
        .left_n;
  };
  const double all_firm = left_n({0, 0, 0, 0}), all_soft = left_n({1, 1, 1, 1});
  EXPECT_NEAR(all_firm, firm.supply(0).supply->left.force_n, 1e-9);
  EXPECT_NEAR(all_soft, soft.supply(0).supply->left.force_n, 1e-9);
  const double front_soft = left_n({1, 1, 0, 0});
  EXPECT_LT(front_soft, all_firm);
  EXPECT_GT(front_soft, all_soft);
}

}  // namespace
}  // namespace regoplan
