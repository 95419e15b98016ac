#include "terramech/margins/supply_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "terramech/margins/state_margins.h"
#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

constexpr double kTiltMax_rad = 25 * kDegree;

/// An LRV and its table on one soil, by the fast model as searches use it.
struct Tabled {
  VehicleOnSoil on;
  SupplyTable table;

  explicit Tabled(const Soil& soil)
      : on(preset_vehicle("lrv"), soil, kMoon_mps2, WheelAccuracy::kFast),
        table(on.vehicle, WheelLaw(on.model), limits_of(on.vehicle), on.weight_n(), kTiltMax_rad,
              2) {}
};

const Tabled& firm() {
  static const Tabled tabled(firm_regolith());
  return tabled;
}
const Tabled& soft() {
  static const Tabled tabled(soft_patch());
  return tabled;
}

TEST(SupplyTable, PromisesNoMoreThanSolvedSupply) {
  for (const Tabled* tabled : {&firm(), &soft()}) {
    std::mt19937_64 random(271828);  // not the states that the bound was measured in
    std::uniform_real_distribution<double> unit(0, 1);
    const VehicleOnSoil& on = tabled->on;
    int answers = 0, too_much = 0;
    for (int i = 0; i < 1000; ++i) {
      const double k = on.vehicle.curvature_max_1pm * (2 * unit(random) - 1);
      // Slopes, dips and crests.
      const double normal = on.weight_n() * std::lerp(0.65, 1.3, unit(random));
      const double force = 0.45 * (2 * unit(random) - 1) * normal;
      const SteadyManoeuvre manoeuvre(on.vehicle, on.sharing, on.wheel_laws, k, normal);
      if (const auto supply = tabled->table.supply(k, force, normal)) {
        ++answers;
        const SupplyResult solved = cornering_supply(manoeuvre, force, limits_of(on.vehicle));
        ASSERT_TRUE(solved.supply) << k << ' ' << force / normal;
        too_much += supply->left_n > solved.supply->left.force_n ||
                    supply->right_n < solved.supply->right.force_n;
      }
      if (const auto traction = tabled->table.traction_n(k, force, normal)) {
        ++answers;
        const auto solved =
            largest_traction_n(manoeuvre, {.forward_n = 0, .left_n = force}, limits_of(on.vehicle));
        ASSERT_TRUE(solved) << k << ' ' << force / normal;
        too_much += *traction > *solved;
      }
    }
    EXPECT_GT(answers, 1250);
    EXPECT_EQ(too_much, 0);
  }
}

/// Scrub of tight turns had taken a third of the load off the traction of straight driving: a
/// search could not set off but in reverse, where no table is asked.
TEST(SupplyTable, OfSkidSteeringLosesLittleOnStraightWays) {
  Vehicle vehicle = preset_vehicle("lrv");
  vehicle.mass_kg = 80;
  vehicle.cg_height_m = 0.3;
  vehicle.steering = Steering::kSkid;
  vehicle.turn_centre_x_m = 0;
  vehicle.curvature_max_1pm = 1;
  vehicle.steer_angle_max_rad = 0;
  vehicle.slip_angle_max_rad = 50 * kDegree;
  vehicle.sinkage_max_m = 0.05;
  vehicle.wheel.radius_m = 0.15;
  vehicle.wheel.width_m = 0.12;
  for (WheelMount& wheel : vehicle.wheels) {
    wheel.x_m = std::copysign(0.35, wheel.x_m);
    wheel.y_m = std::copysign(0.35, wheel.y_m);
    wheel.steered = false;
  }
  const Soil sand{.cohesion_pa = 500,
                  .friction_angle_rad = 33 * kDegree,
                  .kc = 2000,
                  .kphi = 1.2e6,
                  .n = 1.05,
                  .lambda = 0.9,
                  .density_kgpm3 = 1550,
                  .kx0_m = 0.02,
                  .ky0_m = 0.015,
                  .ky1_m = 0.02};
  const VehicleOnSoil on(vehicle, sand, kEarth_mps2, WheelAccuracy::kFast);
  const SupplyTable table(on.vehicle, WheelLaw(on.model), limits_of(on.vehicle), on.weight_n(),
                          kTiltMax_rad, 2);
  EXPECT_LE(table.overestimate_bound(0), 0.02);
  double most = 0;
  for (double k = 0; k < on.vehicle.curvature_max_1pm; k += 0.01) {
    most = std::max(most, table.overestimate_bound(k));
  }
  EXPECT_GT(most, 0.05);
}

TEST(SupplyTable, IsCloseWhereFastVehiclesLive) {
  // Gentle turns on the flat: within twice the bound, which is taken off, and that below 1 %.
  std::mt19937_64 random(31415);
  std::uniform_real_distribution<double> unit(-1, 1);
  const VehicleOnSoil& on = firm().on;
  for (int i = 0; i < 60; ++i) {
    const double k = 0.1 * unit(random), force = 0.2 * unit(random) * on.weight_n();
    EXPECT_LT(firm().table.overestimate_bound(k), 0.01);
    const auto supply = firm().table.supply(k, force, on.weight_n());
    const SupplyResult solved = on.supply(k, force);
    ASSERT_TRUE(supply && solved.supply);
    EXPECT_NEAR(supply->left_n, solved.supply->left.force_n, 0.02 * on.weight_n()) << k;
    EXPECT_NEAR(supply->right_n, solved.supply->right.force_n, 0.02 * on.weight_n()) << k;
  }
}

TEST(SupplyTable, TellsHowMuchItLoses) {
  for (const Tabled* tabled : {&firm(), &soft()}) {
    const SupplyTable::Loss& loss = tabled->table.loss();
    EXPECT_GT(loss.median, 0);
    EXPECT_LT(loss.median, 0.01);
    EXPECT_GT(loss.at_99_percent, loss.median);
    EXPECT_LT(loss.at_99_percent, 0.05);
  }
}

TEST(SupplyTable, AnswersNothingOutsideItsGrid) {
  const SupplyTable& table = firm().table;
  const double weight = firm().on.weight_n(), lock = firm().on.vehicle.curvature_max_1pm;
  EXPECT_TRUE(table.supply(0.1, 0, weight));
  EXPECT_TRUE(table.traction_n(0.1, 0, weight));
  for (const double k : {-1.001 * lock, 1.001 * lock, double(NAN)}) {
    EXPECT_FALSE(table.supply(k, 0, weight)) << k;
    EXPECT_FALSE(table.traction_n(k, 0, weight)) << k;
  }
  for (const double force : {-0.71, 0.71, double(NAN)}) {
    EXPECT_FALSE(table.supply(0, force * weight, weight)) << force;
    EXPECT_FALSE(table.traction_n(0, force * weight, weight)) << force;
  }
  for (const double share : {1.36, 0.55, 0.0, double(NAN)}) {
    EXPECT_FALSE(table.supply(0, 0, share * weight)) << share;
    EXPECT_FALSE(table.traction_n(0, 0, share * weight)) << share;
  }
}

TEST(SupplyTable, AnswersNothingWhereSupplyEnds) {
  const double weight = soft().on.weight_n();
  EXPECT_FALSE(soft().table.supply(0, 0.5 * weight, weight));
  EXPECT_FALSE(soft().table.traction_n(0, 0.6 * weight, weight));
}

TEST(SupplyTable, MirrorsWithTheTurn) {
  const SupplyTable& table = firm().table;
  const double weight = firm().on.weight_n();
  for (const double k : {0.03, 0.2, 0.45}) {
    const auto left_turn = table.supply(k, 100, weight), right_turn = table.supply(-k, 100, weight);
    ASSERT_TRUE(left_turn && right_turn);
    EXPECT_NEAR(left_turn->left_n, -right_turn->right_n, 1e-9);
    EXPECT_NEAR(left_turn->right_n, -right_turn->left_n, 1e-9);
    EXPECT_NEAR(*table.traction_n(k, 200, weight), *table.traction_n(-k, -200, weight), 1e-9);
  }
}

TEST(SupplyTable, IsTheSameForAnyNumberOfThreads) {
  const VehicleOnSoil& on = firm().on;
  const SupplyTable alone(on.vehicle, WheelLaw(on.model), limits_of(on.vehicle), on.weight_n(),
                          kTiltMax_rad, 1);
  for (double k = -0.5; k < 0.5; k += 0.07) {
    EXPECT_EQ(alone.overestimate_bound(k), firm().table.overestimate_bound(k));
    EXPECT_EQ(alone.supply(k, 50, on.weight_n())->left_n,
              firm().table.supply(k, 50, on.weight_n())->left_n);
    EXPECT_EQ(alone.traction_n(k, 50, on.weight_n()),
              firm().table.traction_n(k, 50, on.weight_n()));
  }
}

TEST(TabledSupply, TakesTheLeastOfTheSoilsUnderTheWheels) {
  const std::vector<SupplyTable> tables{firm().table, soft().table};
  const TabledSupply supply(tables);
  GroundPatch patch = patch_with(0, 0);
  const auto answer = [&](std::array<std::int16_t, kMaxWheels> soil) {
    patch.soil = soil;
    return supply.answer({.curvature_1pm = 0.1,
                          .force = {.forward_n = 50, .left_n = 100},
                          .normal_n = firm().on.weight_n(),
                          .patch = &patch},
                         4);
  };
  const SupplyAnswer on_firm = answer({0, 0, 0, 0}), on_soft = answer({1, 1, 1, 1});
  EXPECT_GT(on_firm.supply->left_n, on_soft.supply->left_n);
  for (const auto& soil : {std::array<std::int16_t, kMaxWheels>{0, 0, 0, 1},
                           std::array<std::int16_t, kMaxWheels>{1, 0, 1, 0}}) {
    const SupplyAnswer mixed = answer(soil);
    EXPECT_EQ(mixed.supply->left_n, on_soft.supply->left_n);
    EXPECT_EQ(mixed.supply->right_n, on_soft.supply->right_n);
    EXPECT_EQ(mixed.traction_n, on_soft.traction_n);
  }
}

}  // namespace
}  // namespace regoplan
