#include "drive_diagnosis/corrected_world.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regoplan {
namespace {

const UncertainSoil kFirm{.mean = {.cohesion_pa = 170,
                                   .friction_angle_rad = 0.61,
                                   .kc = 1400,
                                   .kphi = 8.2e5,
                                   .n = 1,
                                   .a0 = 0.4,
                                   .a1 = 0.15,
                                   .lambda = 0.9,
                                   .density_kgpm3 = 1500,
                                   .kx0_m = 0.018,
                                   .ky0_m = 0.013}};

/// 100 m by 60 m that rises toward the east, a metre a cell.
TerrainMap map_of(const std::vector<MapSoil>& soils) {
  const GridFrame frame{.columns = 100,
                        .rows = 60,
                        .west_m = 0,
                        .north_m = 60,
                        .cell_width_m = 1,
                        .cell_height_m = 1,
                        .crs_wkt = {}};
  std::vector<float> height_m;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      height_m.push_back(static_cast<float>(column) / 10);
    }
  }
  SoilCatalogue catalogue{.soils = soils, .classes = {}, .unmapped = {}};
  for (std::size_t i = 0; i < soils.size(); ++i) {
    catalogue.classes.emplace_back(static_cast<std::int32_t>(i) + 1, static_cast<int>(i));
  }
  ClassRaster classes{.frame = frame, .code = std::vector<std::int32_t>(6000, 1)};
  return {{.frame = frame, .height_m = height_m},
          std::move(classes),
          std::move(catalogue),
          {{.x_m = 5, .y_m = 5, .radius_m = 1, .height_m = 1}}};
}

/// Straight east along y = 30 at 1 m/s, from x = 0 on.
std::vector<DriveWindow> windows_east(int count) {
  std::vector<DriveWindow> windows;
  for (int i = 0; i < count; ++i) {
    windows.push_back({.start_s = 5.0 * i,
                       .end_s = 5.0 * (i + 1),
                       .x_m = 5.0 * i + 2.5,
                       .y_m = 30,
                       .speed_mps = 1});
  }
  return windows;
}

/// From 22 to 42 m.
SoilZoneFound zone_found() {
  return {.first = 4, .last = 8, .starts_s = 22, .ends_s = 42, .soil = 0, .estimate = kFirm};
}

VehicleEffects with(VehicleFinding finding, const TerrainMap& map) {
  VehicleEffects effects;
  effects.soils = map.soils();
  effects.found.push_back(std::move(finding));
  return effects;
}

TEST(CorrectedMap, AZoneLiesBesideItsTrackAndNowhereElse) {
  const TerrainMap map = map_of({{.name = "firm", .source = "", .soil = kFirm}});
  const VehicleEffects effects = with({.id = "soil_zone", .zone = zone_found()}, map);
  const TerrainMap corrected = corrected_map(map, effects, windows_east(15));
  ASSERT_EQ(corrected.soils().size(), 2u);
  EXPECT_EQ(corrected.soils()[1].name, "firm_zone_1");
  const auto soil = [&corrected](double x_m, double y_m) {
    return corrected.soil_index(x_m, y_m).value_or(-1);
  };
  EXPECT_EQ(soil(21.4, 30.4), 0);
  EXPECT_EQ(soil(22.6, 30.4), 1);
  EXPECT_EQ(soil(41.4, 30.4), 1);
  EXPECT_EQ(soil(42.6, 30.4), 0);
  // Half its length to either side, 10 m, and a window of 5 m.
  EXPECT_EQ(soil(32.4, 44.4), 1);
  EXPECT_EQ(soil(32.4, 15.6), 1);
  EXPECT_EQ(soil(32.4, 45.6), 0);
  EXPECT_EQ(soil(32.4, 14.4), 0);
}

TEST(ZoneTrack, FollowsTheSmoothedTrackThroughABendToItsEnds) {
  DriveWindow window{.start_s = 0, .end_s = 10, .x_m = 20, .y_m = 30};
  window.track = {.x0_m = 20,
                  .y0_m = 30,
                  .x = {.value = 0, .slope = 1},
                  .y = {.value = 0, .slope = 0, .bend = 0.1}};
  const std::vector<MapPlace> track =
      zone_track({.first = 0, .last = 0, .starts_s = 1, .ends_s = 8.5}, {window});
  EXPECT_GE(track.size(), 5u);
  EXPECT_EQ(track.front().x_m, 16);
  EXPECT_EQ(track.back().x_m, 23.5);
  for (const MapPlace& place : track) {
    EXPECT_NEAR(place.y_m, 30 + 0.1 / 2 * std::pow(place.x_m - 20, 2), 1e-9);
  }
}

TEST(CorrectedMap, AZoneLikeASoilOfTheMapTakesItsClass) {
  const TerrainMap map = map_of({{.name = "firm", .source = "", .soil = kFirm},
                                 {.name = "loose", .source = "", .soil = kFirm}});
  SoilZoneFound zone = zone_found();
  zone.like = 1;
  const TerrainMap corrected =
      corrected_map(map, with({.id = "soil_zone", .zone = zone}, map), windows_east(15));
  EXPECT_EQ(corrected.soils().size(), 2u);
  EXPECT_EQ(corrected.soil_index(30, 30), 1);
  EXPECT_EQ(corrected.soil_index(60, 30), 0);
}

TEST(CorrectedMap, AnOffsetMovesHeightsSoilsAndRocks) {
  const TerrainMap map = map_of({{.name = "firm", .source = "", .soil = kFirm}});
  const TerrainMap corrected = corrected_map(
      map, with({.id = "map_offset", .parameter = "east_m", .size = 2.5}, map), windows_east(15));
  EXPECT_NEAR(corrected.height_m(52.5, 30), map.height_m(50, 30), 1e-6);
  EXPECT_EQ(corrected.rocks()[0].x_m, 7.5);
  EXPECT_EQ(corrected.soil_index(1, 30), std::nullopt);  // nothing is known there any more
}

TEST(CorrectedMap, HeightsThatAreTooLargeAreScaledAndNothingElse) {
  const TerrainMap map = map_of({{.name = "firm", .source = "", .soil = kFirm}});
  const TerrainMap corrected = corrected_map(
      map, with({.id = "map_heights", .parameter = "height_share", .size = -0.2}, map),
      windows_east(15));
  EXPECT_NEAR(corrected.height_m(50, 30), 0.8 * map.height_m(50, 30), 1e-6);
  EXPECT_EQ(corrected.rocks(), map.rocks());
  EXPECT_EQ(corrected.classes()->code, map.classes()->code);
}

TEST(CorrectedMap, ABorderMovesSoilsAlone) {
  const TerrainMap map = map_of({{.name = "firm", .source = "", .soil = kFirm}});
  const TerrainMap corrected = corrected_map(
      map, with({.id = "zone_border", .parameter = "north_m", .size = -3}, map), windows_east(15));
  EXPECT_EQ(corrected.height_m(50, 30), map.height_m(50, 30));
  EXPECT_EQ(corrected.rocks(), map.rocks());
  EXPECT_EQ(corrected.classes()->frame.north_m, 57);
}

TEST(CorrectedVehicle, TakesWhatWasNamedAndNothingElse) {
  const Vehicle lrv = preset_vehicle("lrv");
  VehicleEffects effects;
  effects.found = {{.id = "payload", .parameter = "mass_share", .size = 0.1},
                   {.id = "cg_offset", .parameter = "forward_m", .size = 0.05},
                   {.id = "steering_offset", .parameter = "steer_front_deg", .size = 2}};
  const Vehicle corrected = corrected_vehicle(lrv, effects);
  EXPECT_DOUBLE_EQ(corrected.mass_kg, 1.1 * lrv.mass_kg);
  EXPECT_EQ(corrected.wheel.radius_m, lrv.wheel.radius_m);
  EXPECT_EQ(corrected.cg_height_m, lrv.cg_height_m);
  // The front wheels are nearer to a centre of gravity that lies farther ahead.
  for (std::size_t i = 0; i < lrv.wheels.size(); ++i) {
    EXPECT_DOUBLE_EQ(corrected.wheels[i].x_m, lrv.wheels[i].x_m - 0.05);
    EXPECT_EQ(corrected.wheels[i].y_m, lrv.wheels[i].y_m);
  }
  EXPECT_DOUBLE_EQ(corrected.body.x_max_m, lrv.body.x_max_m - 0.05);
  EXPECT_DOUBLE_EQ(corrected.turn_centre_x_m, lrv.turn_centre_x_m - 0.05);
}

TEST(CorrectedVehicle, CanBePlannedForWhereverItsCentreOfGravityWasFound) {
  const Vehicle lrv = preset_vehicle("lrv");
  for (const char* way : {"forward_m", "left_m", "up_m"}) {
    for (const double off_m : {-0.25, -0.1, 0.1, 0.25}) {
      VehicleEffects effects;
      effects.found = {{.id = "cg_offset", .parameter = way, .size = off_m}};
      const Vehicle corrected = corrected_vehicle(lrv, effects);
      EXPECT_NO_THROW(validate(corrected)) << way << " " << off_m;
      EXPECT_LE(corrected.curvature_max_1pm, lrv.curvature_max_1pm);
      EXPECT_GT(corrected.curvature_max_1pm, 0.8 * lrv.curvature_max_1pm);
    }
  }
}

}  // namespace
}  // namespace regoplan
