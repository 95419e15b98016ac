#include "drive_diagnosis/vehicle_effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

struct Diagnosed {
  std::vector<DriveRecording> drives;
  std::vector<DriveWindow> windows;
  std::optional<VehicleEffects> effects;
  std::vector<std::string> told;  ///< news and stages, in their order
};

const TerrainMap& map_of_all() {
  static const TerrainMap kMap = rolling_map();
  return kMap;
}

Diagnosed diagnosed(std::vector<DriveRecording> drives) {
  Diagnosed result{.drives = std::move(drives), .windows = {}, .effects = {}, .told = {}};
  for (std::size_t i = 0; i < result.drives.size(); ++i) {
    std::ranges::copy(drive_windows(result.drives[i], i, 5, 0.3),
                      std::back_inserter(result.windows));
  }
  const EffectSearchSettings settings{
      .seed = 7,
      .progress = [&](std::string_view stage,
                      double) { result.told.push_back("stage: " + std::string(stage)); },
      .news = [&](const std::string& text) { result.told.push_back("news: " + text); }};
  result.effects = find_vehicle_effects(result.drives, result.windows, map_of_all(),
                                        preset_vehicle("lrv"), 1.62, settings)
                       .effects;
  return result;
}

Diagnosed diagnosed(const SimulatedDrive& drive) {
  return diagnosed(std::vector{record(drive, map_of_all())});
}

/// The rows before and from `row` on as drives of their own, the clock of the second set back to 0.
std::vector<DriveRecording> cut(const DriveRecording& whole, std::size_t row) {
  std::vector<DriveRecording> parts(2, whole);
  const auto keep = [&](std::size_t part, auto& values) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(row);
    part == 0 ? values.erase(at, values.end()) : values.erase(values.begin(), at);
  };
  for (std::size_t part = 0; part < parts.size(); ++part) {
    parts[part].drive_id = part == 0 ? "before" : "after";
    for (auto* values : {&parts[part].time_s, &parts[part].x_m, &parts[part].y_m}) {
      keep(part, *values);
    }
    for (DriveChannel& channel : parts[part].channels) keep(part, channel.values);
  }
  const double from_s = parts[1].time_s.front();
  for (double& time_s : parts[1].time_s) time_s -= from_s;
  return parts;
}

std::string said(const VehicleEffects& effects) {
  std::string text = "windows " + std::to_string(effects.windows);
  for (std::size_t k = 0; k < effects.channels.size(); ++k) {
    text += "; " + effects.channels[k] + " noise " + std::to_string(effects.noise[k]) + " rms " +
            std::to_string(effects.rms[k]);
  }
  std::vector<VehicleFinding> all = effects.found;
  all.push_back(effects.strongest_left);
  for (const VehicleFinding& found : all) {
    text += "\n" + found.id + " " + found.parameter + " " + std::to_string(found.size) + " +- " +
            std::to_string(found.std) + " gain " + std::to_string(found.gain) + " of " +
            std::to_string(found.chance);
  }
  return text;
}

void expect_nothing_claimed(double torque_scatter) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Diagnosed null = diagnosed({.torque_scatter = torque_scatter, .seed = seed});
    ASSERT_TRUE(null.effects);
    EXPECT_TRUE(null.effects->found.empty()) << "seed " << seed << ": " << said(*null.effects);
  }
}

TEST(VehicleEffects, NothingIsClaimedWhereNothingIsOtherwise) {
  expect_nothing_claimed(0.03);
}
TEST(VehicleEffects, NothingIsClaimedWhereNothingIsOtherwiseAndTorqueScatters) {
  expect_nothing_claimed(0.16);
}

/// What is known is told before a zone is fitted, which takes long.
void expect_told_before_it_is_fitted(const std::vector<std::string>& told) {
  const auto first = [&told](std::string_view part) {
    return std::ranges::find_if(
               told,
               [part](const std::string& text) { return text.find(part) != std::string::npos; }) -
           told.begin();
  };
  EXPECT_EQ(first("windows are compared"), 0);
  EXPECT_LT(first("stage: looking for zones"), first("news: soil_zone from about"));
  EXPECT_LT(first("news: soil_zone from about"), first("stage: fitting what stands out"));
  EXPECT_LT(first("stage: fitting what stands out"), static_cast<std::ptrdiff_t>(told.size()));
}

TEST(VehicleEffects, TellHowLongAZoneMustBeAndTorqueThatScattersHidesLongerOnes) {
  const auto least_m = [](double torque_scatter) {
    const Diagnosed null = diagnosed({.torque_scatter = torque_scatter, .seed = 1});
    return null.effects.value().zones_shown.back().least_m.value_or(1e9);  // of one far weaker
  };
  const double quiet_m = least_m(0.03);
  EXPECT_LE(quiet_m, 30);
  EXPECT_GT(least_m(0.16), quiet_m);
}

TEST(VehicleEffects, AWeakZoneOfThirtyMetresIsFoundWhereItLiesAndToldBeforeItIsFitted) {
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    const Diagnosed weak = diagnosed(
        {.weakness = [](double x_m) { return x_m > 140 && x_m < 170 ? 4.0 : 0.0; }, .seed = seed});
    ASSERT_TRUE(weak.effects);
    ASSERT_EQ(weak.effects->found.size(), 1u) << said(*weak.effects);
    EXPECT_EQ(weak.effects->found[0].id, "soil_zone") << said(*weak.effects);
    ASSERT_TRUE(weak.effects->found[0].zone) << said(*weak.effects);
    const SoilZoneFound& zone = *weak.effects->found[0].zone;
    const double window_m = 8;
    EXPECT_NEAR(weak.windows[zone.first].x_m, 140, window_m) << said(*weak.effects);
    EXPECT_NEAR(weak.windows[zone.last].x_m, 170, window_m) << said(*weak.effects);
    EXPECT_GT(zone.resistance.value, 0);
    expect_told_before_it_is_fitted(weak.told);
  }
}

TEST(VehicleEffects, AZoneThatIsCutInTwoFilesBeginsAndEndsInTheTimesOfEach) {
  const DriveRecording whole = record(
      {.weakness = [](double x_m) { return x_m > 140 && x_m < 190 ? 4.0 : 0.0; }, .seed = 11},
      map_of_all());
  const auto middle = std::ranges::find_if(whole.x_m, [](double x_m) { return x_m > 165; });
  const Diagnosed parts =
      diagnosed(cut(whole, static_cast<std::size_t>(middle - whole.x_m.begin())));
  ASSERT_TRUE(parts.effects);
  ASSERT_FALSE(parts.effects->found.empty());
  for (const VehicleFinding& found : parts.effects->found) {
    ASSERT_TRUE(found.zone) << said(*parts.effects);
    const std::vector<double>& time_s = parts.drives[found.zone->drive].time_s;
    EXPECT_LE(found.zone->start_s[0], found.zone->start_s[1]);
    EXPECT_LE(found.zone->end_s[0], found.zone->end_s[1]);
    EXPECT_GE(found.zone->start_s[0], time_s.front());
    EXPECT_LE(found.zone->end_s[1], time_s.back());
  }
}

TEST(VehicleEffects, ASoilFarWeakerThanTheMapSaysIsEstimatedToBearAndToHoldLess) {
  constexpr double kWeakness = 9;  // deviations, beyond what the zone's numbers vary one by one
  const Diagnosed weak =
      diagnosed({.weakness = [](double x_m) { return x_m > 140 && x_m < 170 ? kWeakness : 0.0; },
                 .seed = 14});
  ASSERT_TRUE(weak.effects);
  ASSERT_EQ(weak.effects->found.size(), 1u) << said(*weak.effects);
  ASSERT_TRUE(weak.effects->found[0].zone) << said(*weak.effects);
  const SoilZoneFound& zone = *weak.effects->found[0].zone;
  const UncertainSoil said_there = rolling_map().soils()[0].soil;
  const Soil true_there = weaker(said_there, kWeakness);
  EXPECT_NEAR(std::log(zone.estimate.mean.kphi / true_there.kphi), 0, std::log(2));
  const double halfway_rad =
      (said_there.mean.friction_angle_rad + true_there.friction_angle_rad) / 2;
  EXPECT_LT(zone.estimate.mean.friction_angle_rad, halfway_rad);
  // What is told of how well it is known is true of it.
  EXPECT_NEAR(zone.estimate.mean.friction_angle_rad, true_there.friction_angle_rad,
              3 * zone.estimate.standard_deviation.friction_angle_rad);
}

TEST(VehicleEffects, SoilsBesideAZoneAreToldAsSurelyAsTheyAreKnown) {
  // A zone whose wheels sink deep pulled them by 2.5 in all.
  const Diagnosed weak = diagnosed(
      {.weakness = [](double x_m) { return x_m > 140 && x_m < 170 ? 6.0 : 0.0; }, .seed = 15});
  ASSERT_TRUE(weak.effects);
  ASSERT_EQ(weak.effects->found.size(), 1u) << said(*weak.effects);
  ASSERT_TRUE(weak.effects->found[0].zone) << said(*weak.effects);
  ASSERT_EQ(weak.effects->soils_fitted.size(), 1u);
  const UncertainSoil there = rolling_map().soils()[0].soil;
  const UncertainSoil told = weak.effects->soils_fitted[0].estimate;
  double squares = 0;
  int count = 0;
  for (const SoilParameter& number : soil_parameters()) {
    const double std = told.standard_deviation.*number.member;
    if (!(std > 0)) continue;
    const double pull = (told.mean.*number.member - there.mean.*number.member) / std;
    squares += pull * pull;
    ++count;
  }
  EXPECT_GE(count, 4);
  EXPECT_LT(squares, 1);
}

TEST(VehicleEffects, ASoilIsHandedBackWhereItPredictsTheDriveBetterThanTheMapDoes) {
  const double map_kphi = rolling_map().soils()[0].soil.mean.kphi;
  const auto kphi_after = [&](double weakness, bool is_handed_back) {
    const Diagnosed drive =
        diagnosed({.weakness = [weakness](double) { return weakness; }, .seed = 1});
    const VehicleEffects& effects = drive.effects.value();
    EXPECT_EQ(effects.soils_fitted.size(), 1u);
    const SoilFitted& fitted = effects.soils_fitted.at(0);
    EXPECT_EQ(fitted.is_handed_back(), is_handed_back) << fitted.held_out_nats;
    EXPECT_NE(fitted.estimate.mean.kphi, map_kphi);
    EXPECT_EQ(effects.soils.at(0).soil.mean.kphi,
              is_handed_back ? fitted.estimate.mean.kphi : map_kphi);
    return effects.soils.at(0).soil.mean.kphi;
  };
  EXPECT_LT(kphi_after(1.5, true), map_kphi);
  kphi_after(0, false);
}

TEST(VehicleEffects, AWheelThatDragsIsNamed) {
  SimulatedDrive drive{.seed = 21};
  drive.deviation.wheel_drag_nm[1] = 5;
  const Diagnosed dragging = diagnosed(drive);
  ASSERT_TRUE(dragging.effects);
  ASSERT_EQ(dragging.effects->found.size(), 1u) << said(*dragging.effects);
  const VehicleFinding& found = dragging.effects->found[0];
  EXPECT_EQ(found.id, "wheel_drag") << said(*dragging.effects);
  EXPECT_EQ(found.equivalent.size(), 1u) << said(*dragging.effects);
  EXPECT_NEAR(found.size, 5, 3 * found.std + 0.5);
}

TEST(VehicleEffects, AWheelThatRollsAsIfItHadAnotherRadiusIsNamedAndNotItsDrag) {
  DriveRecording drive = record({.seed = 21}, map_of_all());
  for (float& value : drive.channel("wheel_speed_rear_right_rad_s")->values) value *= 0.97F;
  const Diagnosed slower = diagnosed(std::vector{std::move(drive)});
  ASSERT_TRUE(slower.effects);
  ASSERT_EQ(slower.effects->found.size(), 1u) << said(*slower.effects);
  const VehicleFinding& found = slower.effects->found[0];
  EXPECT_EQ(found.parameter, "radius_rear_right_share") << said(*slower.effects);
  EXPECT_EQ(found.equivalent, std::vector<std::string>{"wheel_radius"}) << said(*slower.effects);
  EXPECT_NEAR(found.size, 1 / 0.97 - 1, 3 * found.std);
}

/// A drive that gains speed and brakes all the way, with channels told later by so many rows.
DriveRecording told_late(const std::vector<std::string>& channels, std::size_t rows) {
  const auto varying_mps = [](double, double x_m) { return 1.2 + 0.5 * std::sin(x_m / 3); };
  DriveRecording drive = record({.speed_mps = varying_mps, .seed = 21}, map_of_all());
  for (const std::string& channel : channels) {
    std::vector<float>& values = drive.channel(channel)->values;
    std::shift_right(values.begin(), values.end(), static_cast<std::ptrdiff_t>(rows));
  }
  return drive;
}

TEST(VehicleEffects, WheelSpeedsThatAreToldLateAreAClockAndNoSoil) {
  const std::vector<std::string> all{"wheel_speed_front_left_rad_s",
                                     "wheel_speed_front_right_rad_s", "wheel_speed_rear_left_rad_s",
                                     "wheel_speed_rear_right_rad_s"};
  for (const auto& [channels, parameter] :
       {std::pair{all, "wheel_speeds_late_s"},
        {std::vector{all.back()}, "wheel_speed_rear_right_late_s"}}) {
    const Diagnosed late = diagnosed(std::vector{told_late(channels, 3)});
    ASSERT_TRUE(late.effects);
    ASSERT_EQ(late.effects->found.size(), 1u) << parameter << said(*late.effects);
    const VehicleFinding& found = late.effects->found[0];
    EXPECT_EQ(found.id, "clock_offset") << said(*late.effects);
    EXPECT_EQ(found.parameter, parameter) << said(*late.effects);
    EXPECT_NEAR(found.size, 0.3, 3 * found.std) << said(*late.effects);
  }
}

TEST(VehicleEffects, NothingElseIsClaimedBesideADragWhereTorqueScatters) {
  for (std::uint64_t seed = 22; seed <= 23; ++seed) {
    SimulatedDrive drive{.torque_scatter = 0.16, .seed = seed};
    drive.deviation.wheel_drag_nm[3] = 7;
    const Diagnosed dragging = diagnosed(drive);
    ASSERT_TRUE(dragging.effects);
    ASSERT_EQ(dragging.effects->found.size(), 1u) << said(*dragging.effects);
    EXPECT_EQ(dragging.effects->found[0].id, "wheel_drag") << said(*dragging.effects);
  }
}

TEST(VehicleEffects, OfTwoFaultsEachIsToldAsItIsBesideTheOther) {
  SimulatedDrive drive{.seed = 21};
  drive.deviation.wheel_drag_nm[0] = drive.deviation.wheel_drag_nm[3] = 5;
  const Diagnosed dragging = diagnosed(drive);
  ASSERT_TRUE(dragging.effects);
  ASSERT_EQ(dragging.effects->found.size(), 2u) << said(*dragging.effects);
  for (const VehicleFinding& found : dragging.effects->found) {
    EXPECT_EQ(found.id, "wheel_drag") << said(*dragging.effects);
    for (const FaultEstimate& other : found.instead) {
      // The one that is claimed beside it is nothing that it could be instead.
      for (const VehicleFinding& claimed : dragging.effects->found) {
        EXPECT_NE(other.parameter, claimed.parameter) << said(*dragging.effects);
      }
      EXPECT_GT(other.size.value, 0) << other.parameter;  // nothing drags by less than nothing
    }
    // Told of the claim as it is told of its size.
    EXPECT_NEAR(found.sigmas * found.std / found.size, 1, 0.4) << said(*dragging.effects);
  }
}

TEST(VehicleEffects, ASteeringOffsetIsNamed) {
  SimulatedDrive drive{.seed = 31};
  const Vehicle vehicle = preset_vehicle("lrv");
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    if (vehicle.wheels[i].x_m > 0) drive.deviation.steering_offset_rad.at(i) = 0.01745;
  }
  const Diagnosed off = diagnosed(drive);
  ASSERT_TRUE(off.effects);
  ASSERT_FALSE(off.effects->found.empty()) << said(*off.effects);
  EXPECT_EQ(off.effects->found[0].id, "steering_offset") << said(*off.effects);
}

TEST(VehicleEffects, TellHowLargeAFaultMustBeAndTorqueThatScattersHidesLargerDrags) {
  const auto least = [](double torque_scatter, const std::string& parameter) {
    const Diagnosed null = diagnosed({.torque_scatter = torque_scatter, .seed = 1});
    const auto& shown = null.effects.value().faults_shown;
    return std::ranges::find(shown, parameter, &FaultShown::parameter)->least;
  };
  const double drag_nm = least(0.03, "drag_rear_right_nm");
  EXPECT_GT(drag_nm, 0);
  EXPECT_GT(least(0.16, "drag_rear_right_nm"), drag_nm);
  EXPECT_LT(least(0.03, "steer_front_deg"), 1);
}

}  // namespace
}  // namespace regoplan
