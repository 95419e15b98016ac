#include "maps/synthetic_terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "maps/crater_field.h"
#include "maps/rock_field.h"
#include "maps/terrain_summary.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

SyntheticTerrainSettings with_seed(std::uint64_t seed) {
  SyntheticTerrainSettings settings;
  settings.seed = seed;
  return settings;
}

/// Standard deviation of the heights.
double deviation_m(const ElevationRaster& elevation) {
  double sum = 0;
  double squares = 0;
  for (const double height : elevation.height_m) {
    sum += height;
    squares += height * height;
  }
  const double count = static_cast<double>(elevation.height_m.size());
  return std::sqrt(squares / count - sum / count * sum / count);
}

TEST(SyntheticTerrain, TheSameSeedGivesTheSameBitsAndAnotherOthers) {
  const SyntheticTerrain first = make_synthetic_terrain(with_seed(1));
  const SyntheticTerrain again = make_synthetic_terrain(with_seed(1));
  EXPECT_EQ(first.elevation.height_m, again.elevation.height_m);
  EXPECT_EQ(first.classes.code, again.classes.code);
  EXPECT_EQ(first.rocks, again.rocks);
  const SyntheticTerrain other = make_synthetic_terrain(with_seed(2));
  EXPECT_NE(first.elevation.height_m, other.elevation.height_m);
  EXPECT_NE(first.classes.code, other.classes.code);
  EXPECT_NE(first.rocks, other.rocks);
}

TEST(SyntheticTerrain, ChangingTheRocksLeavesTheGroundAlone) {
  SyntheticTerrainSettings settings;
  const SyntheticTerrain first = make_synthetic_terrain(settings);
  settings.rock_coverage = 0;
  const SyntheticTerrain bare = make_synthetic_terrain(settings);
  EXPECT_EQ(first.elevation.height_m, bare.elevation.height_m);
  EXPECT_EQ(first.classes.code, bare.classes.code);
  EXPECT_TRUE(bare.rocks.empty());
}

TEST(SyntheticTerrain, TheGroundBetweenCratersIsAsRoughAsAsked) {
  SyntheticTerrainSettings settings;
  settings.crater_density_scale = 0;
  settings.rock_coverage = 0;
  for (const double roughness_m : {0.0, 0.02, 0.3}) {
    settings.roughness_m = roughness_m;
    EXPECT_NEAR(deviation_m(make_synthetic_terrain(settings).elevation), roughness_m,
                1e-3 * roughness_m);
  }
}

TEST(SyntheticTerrain, SmallestAndCoarsestMapsAreAsRoughAsAsked) {
  for (const double cell_m : {0.01, 0.4, 1.0, 3.0, 100.0}) {
    SyntheticTerrainSettings settings;
    settings.cell_m = cell_m;
    settings.width_m = settings.height_m = 16 * cell_m;
    settings.crater_density_scale = settings.rock_coverage = 0;
    settings.crater_diameter_min_m = settings.crater_diameter_max_m = 4 * cell_m;
    settings.rock_diameter_min_m = settings.rock_diameter_max_m = 0.05;
    settings.soil_zone_size_m = 4 * cell_m;
    EXPECT_NEAR(deviation_m(make_synthetic_terrain(settings).elevation), 0.05, 1e-4) << cell_m;
  }
}

TEST(SyntheticTerrain, RocksDoNotTouchAndLieOnTheMap) {
  const SyntheticTerrain terrain = make_synthetic_terrain(with_seed(5));
  const GridFrame& frame = terrain.elevation.frame;
  ASSERT_GT(terrain.rocks.size(), 100U);
  for (std::size_t i = 0; i < terrain.rocks.size(); ++i) {
    const Rock& a = terrain.rocks[i];
    ASSERT_GE(a.x_m - a.radius_m, frame.west_m);
    ASSERT_LE(a.x_m + a.radius_m, frame.east_m());
    ASSERT_GE(a.y_m - a.radius_m, frame.south_m());
    ASSERT_LE(a.y_m + a.radius_m, frame.north_m);
    for (std::size_t k = 0; k < i; ++k) {
      const Rock& b = terrain.rocks[k];
      ASSERT_GT(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), a.radius_m + b.radius_m);
    }
  }
}

TEST(SyntheticTerrain, RocksCoverTheShareAskedHalfAsHighAsWide) {
  for (const double coverage : {0.001, 0.01, 0.05}) {
    SyntheticTerrainSettings settings = with_seed(8);
    settings.rock_coverage = coverage;
    double area_m2 = 0;
    double ratio = 0;
    const std::vector<Rock> rocks = make_synthetic_terrain(settings).rocks;
    for (const Rock& rock : rocks) {
      area_m2 += std::numbers::pi * rock.radius_m * rock.radius_m;
      ratio += rock.height_m / (2 * rock.radius_m);
      ASSERT_GE(2 * rock.radius_m, settings.rock_diameter_min_m);
      ASSERT_LE(2 * rock.radius_m, settings.rock_diameter_max_m);
    }
    EXPECT_NEAR(area_m2 / (settings.width_m * settings.height_m) / coverage, 1, 0.05);
    EXPECT_NEAR(ratio / static_cast<double>(rocks.size()), 0.5, 0.03);
  }
}

// Golombek & Rapp (1997): rocks above D cover k exp(-q D), q = 1.79 + 0.152/k.
TEST(SyntheticTerrain, RockSizesFollowGolombekAndRapp) {
  const double k = 0.05;
  const double q = 1.79 + 0.152 / k;
  const double diameter_min_m = 0.3;
  const GridFrame frame{.columns = 400,
                        .rows = 400,
                        .west_m = 0,
                        .north_m = 400,
                        .cell_width_m = 1,
                        .cell_height_m = 1};
  const std::vector<Rock> rocks = scatter_rocks(frame, std::vector<float>(160000, 1),
                                                {.coverage = k * std::exp(-q * diameter_min_m),
                                                 .diameter_min_m = diameter_min_m,
                                                 .diameter_max_m = 10},
                                                1);
  for (const double diameter_m : {0.4, 0.6, 0.9}) {
    double area_m2 = 0;
    for (const Rock& rock : rocks) {
      if (2 * rock.radius_m < diameter_m) continue;
      area_m2 += std::numbers::pi * rock.radius_m * rock.radius_m;
    }
    EXPECT_NEAR(area_m2 / 160000 / (k * std::exp(-q * diameter_m)), 1, 0.1) << diameter_m;
  }
}

TEST(SyntheticTerrain, SoilZonesShareTheMapEqually) {
  SyntheticTerrainSettings settings;
  for (const int zones : {1, 3, 5}) {
    settings.soil_zones = zones;
    std::map<std::int32_t, int> cells;
    const ClassRaster classes = make_synthetic_terrain(settings).classes;
    for (const std::int32_t code : classes.code) ++cells[code];
    ASSERT_EQ(cells.size(), static_cast<std::size_t>(zones));
    EXPECT_EQ(cells.begin()->first, 1);
    EXPECT_EQ(cells.rbegin()->first, zones);
    for (const auto& [code, count] : cells) {
      EXPECT_NEAR(count, static_cast<double>(classes.code.size()) / zones, 2);
    }
  }
}

TEST(SyntheticTerrain, SlopesAreThoseOfALunarMare) {
  const SyntheticTerrain terrain = make_synthetic_terrain(with_seed(4));
  const TerrainSummary summary = summarize(TerrainMap(
      terrain.elevation, std::nullopt,
      {.soils = {{.name = "regolith", .source = "", .soil = {}}}, .classes = {}, .unmapped = {}},
      terrain.rocks));
  EXPECT_GT(summary.slope_p50_rad, 1.5 * kDegree);
  EXPECT_LT(summary.slope_p50_rad, 6 * kDegree);
  EXPECT_LT(summary.slope_max_rad, 42 * kDegree) << "walls slump to repose, under some texture";
  EXPECT_NEAR(summary.rock_share, 0.005, 0.0003);
}

TEST(SyntheticTerrain, SettingsOutOfRangeAreNamed) {
  const auto field_of = [](auto change) -> std::string {
    SyntheticTerrainSettings settings;
    change(settings);
    try {
      make_synthetic_terrain(settings);
    } catch (const ValueError& error) {
      return error.field();
    }
    return "no error";
  };
  EXPECT_EQ(field_of([](auto& s) { s.cell_m = 0; }), "cell_m");
  EXPECT_EQ(field_of([](auto& s) { s.width_m = -1; }), "width_m");
  EXPECT_EQ(field_of([](auto& s) { s.height_m = std::nan(""); }), "height_m");
  EXPECT_EQ(field_of([](auto& s) { s.crater_diameter_min_m = 1; }), "crater_diameter_min_m");
  EXPECT_EQ(field_of([](auto& s) { s.crater_diameter_max_m = 2; }), "crater_diameter_max_m");
  EXPECT_EQ(field_of([](auto& s) { s.crater_density_scale = -1; }), "crater_density_scale");
  EXPECT_EQ(field_of([](auto& s) { s.roughness_m = -1; }), "roughness_m");
  EXPECT_EQ(field_of([](auto& s) { s.rock_coverage = 0.5; }), "rock_coverage");
  EXPECT_EQ(field_of([](auto& s) { s.rock_diameter_min_m = 2, s.rock_coverage = 0.2; }),
            "rock_coverage");
  EXPECT_EQ(field_of([](auto& s) { s.soil_zones = 0; }), "soil_zones");
}

TEST(CraterField, AFreshCraterOnTheMapHasThePikeDepthItWasDrawnWith) {
  const GridFrame frame{.columns = 400,
                        .rows = 400,
                        .west_m = 0,
                        .north_m = 100,
                        .cell_width_m = 0.25,
                        .cell_height_m = 0.25};
  Crater crater;
  crater.x_m = crater.y_m = 50;
  crater.diameter_m = 20;
  crater.age = CraterShape::kYoungest;
  // On a slope of 0.1 with a bump where the crater digs: the slope stays, the bump goes.
  std::vector<double> ground;
  for (int i = 0; i < 160000; ++i) {
    const double x_m = 0.25 * (i % 400 + 0.5);
    const double y_m = 100 - 0.25 * (i / 400 + 0.5);
    ground.push_back(0.1 * x_m + (std::hypot(x_m - 50, y_m - 50) < 2 ? 0.5 : 0));
  }
  const std::vector<double> dug = with_craters(ground, frame, {crater});
  const auto at = [&](double x_m, double y_m) {
    return dug[static_cast<std::size_t>((100 - y_m) / 0.25) * 400 +
               static_cast<std::size_t>(x_m / 0.25)];
  };
  const CraterProfile profile = CraterShape().profile(20, crater.age);
  EXPECT_NEAR(at(50, 50) - 5.0, profile.height_m(0), 0.08);
  EXPECT_NEAR((at(60.1, 50) + at(39.9, 50)) / 2 - 5.0, profile.height_m(1.01), 0.03);
  EXPECT_NEAR(at(60.1, 50) - at(39.9, 50), 0.1 * 20.2, 0.15);
  EXPECT_NEAR(at(99, 99), 9.9, 0.02) << "far ground stays";
}

TEST(CraterField, CratersStandInEquilibriumDensityOldestFirstAndMostlyWorn) {
  const GridFrame frame{.columns = 1000,
                        .rows = 1000,
                        .west_m = 0,
                        .north_m = 1000,
                        .cell_width_m = 1,
                        .cell_height_m = 1};
  const std::vector<Crater> craters = draw_craters(frame, 4, 100, 1, 3);
  const CraterShape shape;
  double time = 1e300;
  std::map<double, int> larger;
  int inside = 0;
  int fresh = 0;
  for (const Crater& crater : craters) {
    const double crater_time = crater.age * crater.diameter_m * crater.diameter_m;
    ASSERT_LE(crater_time, time);
    time = crater_time;
    if (!covers(frame, crater.x_m, crater.y_m)) continue;
    ++inside;
    for (const double diameter_m : {4.0, 8.0, 16.0})
      larger[diameter_m] += crater.diameter_m >= diameter_m;
    fresh += shape.profile(crater.diameter_m, crater.age).depth_m() > 0.14 * crater.diameter_m;
  }
  for (const auto& [diameter_m, count] : larger) {
    const double expected = 0.079e6 * (std::pow(diameter_m, -2) - 1e-4);
    EXPECT_NEAR(count, expected, 4 * std::sqrt(expected)) << diameter_m;
  }
  EXPECT_NEAR(static_cast<double>(fresh) / inside, 0.1, 0.03);
}

}  // namespace
}  // namespace regoplan
