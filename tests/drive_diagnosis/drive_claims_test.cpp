#include "drive_diagnosis/drive_claims.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(DriveClaims, AZoneIsToldByTheChanceOfNoneAndByOneIntervalOfItsSoil) {
  // Standard deviations of the evidence stood beside the interval of one number, at odds with it.
  const DriveDiagnosis diagnosis = diagnose_drives(
      {record(
          {.weakness = [](double x_m) { return x_m > 140 && x_m < 170 ? 4.0 : 0.0; }, .seed = 11},
          rolling_map())},
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5},
      {});
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
  const DriveDiagnosis diagnosis = diagnose_drives(
      {record(drive, rolling_map())},
      {.map = rolling_map(), .vehicle = vehicle, .gravity_mps2 = 1.62, .window_s = 5}, {});
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

TEST(DriveClaims, WhyASoilStaysAsTheMapHasItIsToldInASentence) {
  const std::string text = withheld_text({.held_out_nats = std::log(0.5)}, {.name = "mare"});
  EXPECT_EQ(count_of("mare stays as the map has it", text), 1) << text;
  EXPECT_EQ(count_of("0.5 times as likely", text), 1) << text;
}

}  // namespace
}  // namespace regoplan
