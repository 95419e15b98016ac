#include "drive_diagnosis/drive_claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "drive_diagnosis/comparison/soil_deviation.h"
#include "drive_diagnosis/silent_effects.h"
#include "terramech/basics/angles.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// How often a text has another in it.
int count_of(std::string_view part, std::string_view text) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos;
       at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

DriveDiagnosis diagnosed(const SimulatedDrive& drive, const TerrainMap& map = rolling_map()) {
  return diagnose_drives(
      {record(drive, rolling_map())},
      {.map = map, .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5}, {});
}

/// The rolling map with heights of its own.
TerrainMap with_heights(const std::function<void(std::vector<float>& height_m)>& change) {
  const TerrainMap map = rolling_map();
  ElevationRaster elevation = map.elevation();
  change(elevation.height_m);
  return {std::move(elevation), map.classes(), map.catalogue(), map.rocks()};
}

/// Whether the heights of the map are told not to be sought.
bool is_silent_of_heights(const DriveDiagnosis& diagnosis) {
  return std::ranges::any_of(diagnosis.silent, [](const SilentEffect& silent) {
    return silent.ids == std::vector<std::string>{"map_heights"};
  });
}

TEST(DriveClaims, AZoneIsToldByTheChanceOfNoneAndByOneIntervalOfItsSoil) {
  // Standard deviations of the evidence stood beside the interval of one number, at odds with it.
  const DriveDiagnosis diagnosis = diagnosed(
      {.weakness = [](double x_m) { return x_m > 140 && x_m < 170 ? 4.0 : 0.0; }, .seed = 11});
  ASSERT_EQ(diagnosis.claims.size(), 1u);
  const std::string& text = diagnosis.claims[0].text;
  EXPECT_EQ(count_of("standard deviations", text), 0) << text;
  EXPECT_EQ(count_of("95 %", text), 1) << text;
  EXPECT_EQ(count_of("by chance alone fewer than one of a million drives", text), 1) << text;
  EXPECT_LT(diagnosis.where.at(0).p_value, 1e-6);
}

/// Of a steered pair one wheel is off: both the pair and the wheel may be told, and each is.
TEST(DriveClaims, AFaultIsToldWithTheNumbersThatItIsHardlyToldFrom) {
  SimulatedDrive drive{.seed = 31};
  const Vehicle vehicle = preset_vehicle("lrv");
  std::vector<std::string> front;
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    if (vehicle.wheels[i].x_m > 0) front.push_back("steer_" + vehicle.wheels[i].name + "_deg");
    if (vehicle.wheels[i].name == "front_left") {
      drive.deviation.steering_offset_rad.at(i) = 2 * kDegree;
    }
  }
  const DriveDiagnosis diagnosis = diagnosed(drive);
  ASSERT_FALSE(diagnosis.claims.empty());
  const DriveClaim& claim = diagnosis.claims[0];
  ASSERT_EQ(claim.id, "steering_offset");
  std::vector<std::string> told{claim.parameters.begin()->first};
  for (const FaultEstimate& other : claim.instead) {
    told.push_back(other.parameter);
    EXPECT_EQ(count_of(other.parameter + " = ", claim.text), 1) << claim.text;
  }
  EXPECT_NE(std::ranges::find(told, "steer_front_left_deg"), told.end()) << claim.text;
}

/// No wheel drags by less than nothing: a sensor of torque that reads too little is no such name.
TEST(DriveClaims, ADragOfLessThanNothingIsNotClaimedButTold) {
  SimulatedDrive drive{.seed = 21};
  drive.deviation.wheel_drag_nm[1] = -5;
  const DriveDiagnosis diagnosis = diagnosed(drive);
  EXPECT_EQ(diagnosis.verdict, DriveVerdict::kUndecided);
  EXPECT_TRUE(diagnosis.claims.empty());
  const auto told = std::ranges::find(diagnosis.findings, "no_name", &DriveFinding::id);
  ASSERT_NE(told, diagnosis.findings.end());
  EXPECT_EQ(count_of("wheel_drag of drag_", told->text), 1) << told->text;
  EXPECT_LT(told->value.value(), -4);
  EXPECT_FALSE(nearest_text(diagnosis));
}

/// Why what stands out has no name is told of what it would be.
TEST(DriveClaims, WhySomethingHasNoNameIsToldOfWhatItWouldBe) {
  const auto text = [](const std::string& id, const std::string& parameter) {
    return unnamed_finding({.id = id, .parameter = parameter, .size = -1.2}).text;
  };
  EXPECT_EQ(count_of("nothing loses more than all of it", text("payload", "mass_share")), 1);
  EXPECT_EQ(count_of("centre of gravity beside its wheels", text("cg_offset", "left_m")), 1);
  EXPECT_EQ(count_of("drags by less than nothing", text("tow_drag", "drag_n")), 1);
}

/// Nothing weighs less than nothing: a payload of -88 % had been claimed.
TEST(DriveClaims, AMassOfLessThanNothingIsNotClaimedButTold) {
  SimulatedDrive drive{.torque_scatter = 0,
                       .weave_1pm = [](double, double x_m) { return 0.012 * std::sin(x_m / 9); },
                       .seed = 21};
  drive.deviation.motor_share.fill(-1.2);
  const DriveDiagnosis diagnosis = diagnosed(drive);
  for (const DriveClaim& claim : diagnosis.claims) ADD_FAILURE() << claim.id << claim.text;
  EXPECT_EQ(std::ranges::count(diagnosis.findings, "no_name", &DriveFinding::id), 1);
}

/// The torque of real wheels rises with their load otherwise than the model's: that was a centre of
/// gravity .3 m lower, at 17 standard deviations.
TEST(DriveClaims, AWheelWhoseTorqueRisesOtherwiseWithItsLoadIsNoFaultOfTheVehicle) {
  SimulatedDrive drive{.seed = 33};
  drive.deviation.torque_by_load = -0.1;
  const DriveDiagnosis diagnosis = diagnosed(drive);
  ASSERT_EQ(diagnosis.claims.size(), 1u);
  const DriveClaim& claim = diagnosis.claims[0];
  EXPECT_EQ(claim.equivalent, std::vector<std::string>{"wheel_law"});
  const DriveEstimate& size = claim.parameters.at("torque_by_load");
  EXPECT_NEAR(size.value, -0.1, 3 * size.std);
  EXPECT_LT(size.std, 0.03);
  EXPECT_EQ(count_of("wheel physics that the model lacks", claim.text), 1) << claim.text;
}

/// A law that differs in how torque rises with the load is trusted no better in all of it: drives
/// of such a law had a payload of 12 % beside it.
TEST(DriveClaims, ATorqueThatDiffersWithTheWheelLawIsNoPayload) {
  SimulatedDrive drive{.attitude = true, .seed = 33};
  drive.deviation.torque_by_load = -0.15;
  drive.deviation.motor_share.fill(0.12);
  const DriveDiagnosis diagnosis = diagnosed(drive);
  ASSERT_EQ(diagnosis.claims.size(), 1u);
  EXPECT_EQ(diagnosis.claims[0].id, "wheel_law");
}

/// What a wheel law that differs does itself is no soil: zones of .6 and 2 % had been claimed
/// beside it.
TEST(DriveClaims, AZoneThatChangesLessThanTheWheelLawDoesIsToldAndNotClaimed) {
  const auto with_zone = [](double deviations) {
    SimulatedDrive drive{
        .weakness = [deviations](double x_m) { return x_m > 140 && x_m < 170 ? deviations : 0.0; },
        .torque_scatter = 0.01,
        .seed = 11};
    drive.deviation.torque_by_load = -0.08;
    return diagnosed(drive);
  };
  const DriveDiagnosis weak = with_zone(4), far_weaker = with_zone(8);
  ASSERT_EQ(weak.claims.size(), 1u);
  EXPECT_EQ(weak.claims[0].id, "wheel_law");
  const auto told = std::ranges::find(weak.findings, "zone_within_law", &DriveFinding::id);
  ASSERT_NE(told, weak.findings.end());
  EXPECT_LT(told->value.value(), 0.02);
  EXPECT_EQ(count_of("zone of other soil is claimed", told->text), 1) << told->text;
  ASSERT_EQ(far_weaker.claims.size(), 2u);
  EXPECT_EQ(std::ranges::count(far_weaker.claims, "soil_zone", &DriveClaim::id), 1);
}

/// Wheels that sink deeper downhill tilt a vehicle more than the ground does.
TEST(DriveClaims, AVehicleThatTiltsALittleMoreThanTheGroundIsOnNoOtherMap) {
  SimulatedDrive drive{.attitude = true, .seed = 34};
  drive.deviation.tilt_share = 0.05;
  const DriveDiagnosis diagnosis = diagnosed(drive);
  for (const DriveClaim& claim : diagnosis.claims) ADD_FAILURE() << claim.id << claim.text;
}

/// Heights a quarter too large had been a vehicle that weighs a sixth less.
TEST(DriveClaims, AMapWhoseHeightsAreTooLargeIsNoPayload) {
  const DriveDiagnosis diagnosis =
      diagnosed({.attitude = true, .seed = 34}, with_heights([](std::vector<float>& height_m) {
                  for (float& height : height_m) height *= 1.25F;
                }));
  ASSERT_EQ(diagnosis.claims.size(), 1u);
  const DriveClaim& claim = diagnosis.claims[0];
  EXPECT_EQ(claim.equivalent, std::vector<std::string>{"map_heights"});
  EXPECT_NEAR(claim.parameters.at("height_share").value, 1 / 1.25 - 1, 0.04);
  EXPECT_FALSE(is_silent_of_heights(diagnosis));
}

/// The map of another ground is not one whose heights are none.
TEST(DriveClaims, AMapOfAnotherGroundIsNotOneOfOtherHeights) {
  const DriveDiagnosis diagnosis =
      diagnosed({.attitude = true, .seed = 34},
                with_heights([](std::vector<float>& height_m) { std::ranges::reverse(height_m); }));
  for (const DriveClaim& claim : diagnosis.claims) EXPECT_NE(claim.id, "map_heights");
  EXPECT_EQ(std::ranges::count(diagnosis.findings, "map_slopes", &DriveFinding::id), 1);
  EXPECT_TRUE(is_silent_of_heights(diagnosis));
}

/// Whatever is not sought is told: how wheels stand that are not steered, where others are.
TEST(DriveClaims, WheelsThatAreTakenToStandStraightAheadAreTold) {
  const auto told_of = [](const Vehicle& vehicle) {
    DriveDiagnosis diagnosis;
    diagnosis.effects.emplace();
    say_what_is_silent({.map = rolling_map(), .vehicle = vehicle, .gravity_mps2 = 1.62}, {},
                       diagnosis);
    std::string told;
    for (const SilentEffect& silent : diagnosis.silent) {
      if (silent.ids == std::vector<std::string>{"steering_offset"}) told += silent.why;
    }
    return told;
  };
  EXPECT_EQ(told_of(preset_vehicle("lrv")), "");
  EXPECT_EQ(count_of("middle_left, middle_right", told_of(preset_vehicle("curiosity"))), 1)
      << told_of(preset_vehicle("curiosity"));
  Vehicle skid = preset_vehicle("lrv");
  skid.steering = Steering::kSkid;
  for (WheelMount& mount : skid.wheels) mount.steered = false;
  EXPECT_EQ(told_of(skid), "");  // of these it is sought
}

/// What is not enough for a claim is told where chance seldom shows as much.
TEST(DriveClaims, WhatComesNearestToAClaimIsTold) {
  DriveDiagnosis diagnosis{.verdict = DriveVerdict::kConsistent};
  EXPECT_FALSE(nearest_text(diagnosis));
  diagnosis.effects = VehicleEffects{.strongest_left = {.id = "wheel_drag",
                                                        .parameter = "drag_front_left_nm",
                                                        .size = 1.2,
                                                        .std = 0.3,
                                                        .sigmas = 4,
                                                        .gain = 12,
                                                        .chance = 14,
                                                        .equivalent = {"wheel_drag", "cg_offset"}}};
  const std::string text = nearest_text(diagnosis).value_or("");
  EXPECT_EQ(count_of("wheel_drag or cg_offset: drag_front_left_nm = 1.2", text), 1) << text;
  EXPECT_EQ(count_of("one of 300 drives", text), 1) << text;
  diagnosis.effects->strongest_left.gain = 6;  // one of twenty sound drives shows 6.2
  EXPECT_FALSE(nearest_text(diagnosis));
}

/// Roll that scattered as the map's cross slope had been told for radians in a column of degrees.
TEST(DriveClaims, AnAngleThatHardlyFollowsTheGroundIsOfAnotherUnitOnlyWhereItHardlyChanges) {
  const auto told_of = [](double scatter_deg) {
    DriveDiagnosis diagnosis;
    diagnosis.mountings = {{.day = "monday",
                            .pitch_rad = {},
                            .roll_rad = DriveEstimate{0.1, 0.001},
                            .roll_slope = 0.01,
                            .roll_scatter_rad = scatter_deg * kDegree,
                            .roll_ground_scatter_rad = 4.5 * kDegree}};
    judge_mounting({.map = rolling_map()}, diagnosis);
    EXPECT_TRUE(diagnosis.claims.empty());
    EXPECT_EQ(diagnosis.findings.size(), 1U);
    return diagnosis.findings.at(0);
  };
  EXPECT_EQ(told_of(0.08).id, "unit");
  const DriveFinding other = told_of(4);
  EXPECT_EQ(other.id, "other_ground");
  EXPECT_EQ(count_of("roll changes by 4.0 deg where the map's ground does by 4.5", other.text), 1)
      << other.text;
  // `mounting` has a number of that day: something is said of it
  EXPECT_EQ(count_of("nothing is said", other.text), 0);
}

/// The names of the claimed class had stood among what is not shown, too.
TEST(DriveClaims, WhatIsClaimedIsNotAmongWhatIsNotShown) {
  DriveDiagnosis diagnosis;
  diagnosis.claims = {{.id = "side_drag", .equivalent = {"side_drag", "wheel_drag", "cg_offset"}}};
  say_what_is_silent({.map = rolling_map()}, {}, diagnosis);
  for (const SilentEffect& silent : diagnosis.silent) {
    for (const std::string& id : diagnosis.claims[0].equivalent) {
      EXPECT_EQ(std::ranges::count(silent.ids, id), 0) << id << ": " << silent.why;
    }
  }
}

TEST(DriveClaims, ASoilFarFromWhatTheMapSaysIsClaimedWhereItPredictsBetter) {
  const DriveSetup setup{.map = rolling_map(), .vehicle = preset_vehicle("lrv")};
  const auto claims = [&](double deviations, double held_out_nats) {
    SoilNumbers off{};
    const auto& numbers = soil_parameters();
    const auto kphi = std::ranges::find(numbers, "kphi", &SoilParameter::name) - numbers.begin();
    off.at(static_cast<std::size_t>(kphi)) = deviations;
    const UncertainSoil& said = setup.map.soils()[0].soil;
    UncertainSoil estimate = said;
    estimate.mean = deviating(said, off);
    DriveDiagnosis result;
    result.effects = VehicleEffects{
        .soils_fitted = {{.soil = 0, .estimate = estimate, .held_out_nats = held_out_nats}}};
    claim_soils(setup, result);
    return result.claims;
  };
  ASSERT_EQ(claims(-5, 40).size(), 1u);
  EXPECT_EQ(claims(-5, 40)[0].id, "soil_change");
  EXPECT_NEAR(claims(-5, 40)[0].sigmas, 5, 0.01);
  EXPECT_EQ(claims(-5, 40)[0].parameters.size(), 1u);
  EXPECT_TRUE(claims(-4, 40).empty());
  EXPECT_TRUE(claims(-5, -1).empty());
}

TEST(DriveClaims, WhyASoilStaysAsTheMapHasItIsToldInASentence) {
  const std::string text = withheld_text({.held_out_nats = std::log(0.5)}, {.name = "mare"});
  EXPECT_EQ(count_of("mare stays as the map has it", text), 1) << text;
  EXPECT_EQ(count_of("0.5 times as likely", text), 1) << text;
}

}  // namespace
}  // namespace regoplan
