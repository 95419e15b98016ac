// What the model of a window says of its motion, its soils and the vehicle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drive_diagnosis/comparison/vehicle_trials.h"
#include "drive_diagnosis/comparison/window_prediction.h"
#include "tests/drive_diagnosis/compared_drive.h"

namespace regoplan {
namespace {

/// The rolling map with two soils, the one of a class everywhere.
TerrainMap of_two_soils(std::int32_t everywhere) {
  const TerrainMap map = rolling_map();
  const UncertainSoil mare = map.soils()[0].soil;
  const UncertainSoil weak{.mean = weaker(mare, 4), .standard_deviation = mare.standard_deviation};
  GridFrame frame = map.elevation().frame;
  frame.cell_width_m *= frame.columns;
  frame.cell_height_m *= frame.rows;
  frame.columns = frame.rows = 1;
  return {map.elevation(),
          ClassRaster{.frame = frame, .code = {everywhere}},
          SoilCatalogue{.soils = {{"mare", "assumed", mare}, {"weak", "assumed", weak}},
                        .classes = {{0, 0}, {1, 1}},
                        .unmapped = {}},
          {}};
}

TEST(WindowModel, ASearchThatLeadsNowhereFromWhereTheLastOneEndedBeginsAtTheMeasuredMotion) {
  // Else a window would tell nothing of soils that differ much from those tried before it.
  const Compared compared({.seed = 3});
  const WindowModel model(compared.map, compared.vehicle, 1.62);
  WindowInput input = compared.comparison->input(20);
  const auto said = model.predict(input, {});
  for (WindowInput::Place& place : input.places) place.near.motion.vx_mps = NAN;
  const auto again = model.predict(input, {});
  ASSERT_TRUE(said && again);
  EXPECT_NEAR(again->forward_mps, said->forward_mps, 1e-6);
}

TEST(WindowModel, MotionsAreSoughtAgainWhereTheVehicleMovesOtherwiseAndNowhereElse) {
  const Compared compared({.seed = 3});
  const TerrainMap map = of_two_soils(0);
  const WindowModel model(map, compared.vehicle, 1.62);
  const WindowInput& input = compared.comparison->input(20);
  const WindowMotions here = model.motions(input, {});
  ASSERT_TRUE(here.places);
  WindowMotions elsewhere = here;  // shows whether they are taken
  for (WindowMotions::Place& place : *elsewhere.places) place.found.motion.vx_mps += 1;
  int taken = 0, sought = 0;
  for (const VehicleTrial& trial :
       vehicle_trials(compared.vehicle, 1.62, {}, map, {true, true}, true)) {
    const auto anew = model.predict(input, trial.deviation),
               known = model.predict(input, trial.deviation, {}, &here),
               shown = model.predict(input, trial.deviation, {}, &elsewhere);
    ASSERT_TRUE(anew && known && shown) << trial.parameter;
    EXPECT_EQ(known->forward_mps, anew->forward_mps) << trial.parameter;
    EXPECT_EQ(known->left_mps, anew->left_mps) << trial.parameter;
    EXPECT_EQ(known->pitch_rad, anew->pitch_rad) << trial.parameter;
    EXPECT_EQ(known->torque_nm, anew->torque_nm) << trial.parameter;
    const bool is_taken = shown->forward_mps > anew->forward_mps + 0.5;
    const bool moves = trial.parameter.starts_with("mare.") || trial.id == "payload";
    const bool only_told = trial.parameter.starts_with("weak.") || trial.id == "wheel_drag" ||
                           trial.id == "motor_constant";
    EXPECT_FALSE(moves && is_taken) << trial.parameter;
    EXPECT_FALSE(only_told && !is_taken) << trial.parameter;
    taken += is_taken;
    sought += !is_taken;
  }
  EXPECT_GT(taken, 10);
  EXPECT_GT(sought, 10);
}

TEST(WindowModel, WhatDragsHoldsBackWhicheverWayTheVehicleRolls) {
  const Compared compared({.seed = 3});
  const WindowModel model(compared.map, compared.vehicle, 1.62);
  const WindowInput ahead = compared.comparison->input(20);
  WindowInput back = ahead;
  back.forward_mps = -ahead.forward_mps;
  for (WindowInput::Place& place : back.places) {
    for (double& rim : place.rim_rad_s) rim = -rim;
    for (MotionStart* start : {&place.start, &place.near}) {
      start->motion = {.vx_mps = -start->motion.vx_mps};
      start->response.setZero();
    }
  }
  const VehicleDeviation drags{.wheel_drag_nm = {0, 5}}, is_towing{.tow_drag_n = 30};
  for (const auto& [input, way] : {std::pair{ahead, 1.0}, {back, -1.0}}) {
    const auto sound = model.predict(input, {}), dragging = model.predict(input, drags),
               towing = model.predict(input, is_towing);
    ASSERT_TRUE(sound && dragging && towing) << way;
    EXPECT_NEAR(dragging->torque_nm[1] - sound->torque_nm[1], way * 5, 1e-9);
    EXPECT_LT(way * towing->forward_mps, way * sound->forward_mps);
  }
}

TEST(SoilStretch, AWheelToTheLeftComesLaterOntoABorderThatLiesFartherThere) {
  const SoilStretch straight{.starts_s = 10, .ends_s = 20};
  const SoilStretch oblique{.starts_s = 10, .ends_s = 20, .starts_slant = 1, .ends_slant = -0.5};
  const WheelTime left{.at_s = 11, .left_s = 2}, right{.at_s = 9, .left_s = -2};
  EXPECT_TRUE(straight.holds(left));
  EXPECT_FALSE(straight.holds(right));
  EXPECT_FALSE(oblique.holds(left));
  EXPECT_TRUE(oblique.holds(right));
  EXPECT_FALSE(oblique.holds({.at_s = 19.5, .left_s = 2}));
  EXPECT_TRUE(oblique.holds({.at_s = 20.5, .left_s = -2}));
}

TEST(WindowModel, NumbersOnTopOfWhateverTheMapHasAreThoseOfItsSoils) {
  const Compared compared({.seed = 3});
  const TerrainMap map = of_two_soils(1);
  const WindowModel model(map, compared.vehicle, 1.62);
  const WindowInput& input = compared.comparison->input(20);
  const SoilNumbers weaker = weaker_by(1);
  const auto soils = model.predict(input, {.soils = {weaker, weaker}});
  const auto stretch = model.predict(
      input, {}, {{.starts_s = -1e9, .ends_s = 1e9, .soil = kAsMapped, .numbers = weaker}});
  ASSERT_TRUE(soils && stretch);
  EXPECT_EQ(stretch->torque_nm, soils->torque_nm);
}

TEST(VehicleTrials, WhatASoundVehicleIsOffGrowsWithItsWeightAndLength) {
  const TerrainMap map = rolling_map();
  const auto unit = [&map](const char* vehicle, double gravity_mps2, std::string_view parameter) {
    const auto trials =
        vehicle_trials(preset_vehicle(vehicle), gravity_mps2, {}, map, {true}, true);
    return std::ranges::find(trials, parameter, &VehicleTrial::parameter)->unit;
  };
  EXPECT_DOUBLE_EQ(unit("lrv", 1.62, "drag_front_left_nm"), 0.2);
  EXPECT_DOUBLE_EQ(unit("lrv", 1.62, "drag_n"), 3);
  EXPECT_DOUBLE_EQ(unit("lrv", 1.62, "forward_m"), 0.015);
  EXPECT_NEAR(unit("curiosity", 3.71, "drag_front_left_nm"), 0.36, 0.005);
  EXPECT_NEAR(unit("tohoku", 9.81, "drag_front_left_nm"), 0.01, 0.0005);
  EXPECT_NEAR(unit("tohoku", 9.81, "up_m"), 0.0066, 0.0001);
}

TEST(WindowModel, AZoneIsOfItsOwnSoilWhateverTheMapSays) {
  const Compared compared({.seed = 3});
  const TerrainMap mare = of_two_soils(0), weak = of_two_soils(1);
  const WindowModel on_mare(mare, compared.vehicle, 1.62), on_weak(weak, compared.vehicle, 1.62);
  const WindowInput& input = compared.comparison->input(20);
  const auto said = on_weak.predict(input, {}),
             zone = on_mare.predict(input, {}, {{.starts_s = -1e9, .ends_s = 1e9, .soil = 1}});
  const auto mare_there = on_mare.predict(input, {});
  ASSERT_TRUE(said && zone && mare_there);
  for (std::size_t i = 0; i < compared.vehicle.wheels.size(); ++i) {
    EXPECT_EQ(zone->torque_nm.at(i), said->torque_nm.at(i));
    EXPECT_GT(zone->torque_nm.at(i), mare_there->torque_nm.at(i) + 1);
  }
}

/// Of a vehicle that turns by its sides a wheel that is mounted askew looked like a drag of a side.
TEST(VehicleTrials, AWheelMayStandAskewWhereNoneIsSteered) {
  const TerrainMap map = rolling_map();
  const auto angles_of = [&map](const Vehicle& vehicle) {
    std::vector<std::string> parameters;
    for (const VehicleTrial& trial : vehicle_trials(vehicle, 1.62, {}, map, {true}, true)) {
      if (trial.id == "steering_offset") parameters.push_back(trial.parameter);
    }
    return parameters;
  };
  Vehicle skid = preset_vehicle("lrv");
  skid.steering = Steering::kSkid;
  std::vector<std::string> each;
  for (WheelMount& mount : skid.wheels) {
    mount.steered = false;
    each.push_back("steer_" + mount.name + "_deg");
  }
  EXPECT_EQ(angles_of(skid), each);
  for (const std::string& parameter : angles_of(preset_vehicle("curiosity"))) {
    EXPECT_EQ(parameter.find("middle"), std::string::npos) << parameter;
  }
}

}  // namespace
}  // namespace regoplan
