#include "maps/synthetic_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "maps/crater_field.h"
#include "maps/rock_field.h"
#include "maps/smooth_noise.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"

namespace regoplan {

namespace {

/// What hangs on the seed separately, so that a change of one leaves the others alone.
enum Stream : std::uint64_t { kCraters, kGround, kTexture, kRocks, kRockPatches, kZones };

/// `value(x_m, y_m)` at the centre of every cell.
template <typename Number, typename Value>
std::vector<Number> over_cells(const GridFrame& frame, Value value) {
  std::vector<Number> cells;
  cells.reserve(static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows));
  for (int row = 0; row < frame.rows; ++row) {
    const double y_m = frame.north_m - (row + 0.5) * frame.cell_height_m;
    for (int column = 0; column < frame.columns; ++column) {
      const double x_m = frame.west_m + (column + 0.5) * frame.cell_width_m;
      cells.push_back(static_cast<Number>(value(x_m, y_m)));
    }
  }
  return cells;
}

/// Noise of several wavelengths, a factor of `kLacunarity` apart; the amplitude goes with the
/// wavelength to the power of the Hurst exponent of lunar ground at metres and below (Helfenstein &
/// Shepard 1999).
class FractalNoise {
 public:
  FractalNoise(std::uint64_t seed, double wavelength_min_m, double wavelength_max_m) {
    constexpr double kLacunarity = 1.8;
    constexpr double kHurst = 0.6;
    const auto octaves = static_cast<std::uint64_t>(
        std::max(0.0, std::log(wavelength_max_m / wavelength_min_m) / std::log(kLacunarity) + 1));
    for (std::uint64_t octave = 0; octave < octaves; ++octave) {
      const double wavelength_m =
          wavelength_max_m * std::pow(kLacunarity, -static_cast<double>(octave));
      octaves_.push_back(
          {SmoothNoise(sub_seed(seed, octave), wavelength_m), std::pow(wavelength_m, kHurst)});
    }
  }

  double operator()(double x_m, double y_m) const {
    double sum = 0;
    for (const Octave& octave : octaves_) sum += octave.amplitude * octave.noise(x_m, y_m);
    return sum;
  }

 private:
  struct Octave {
    SmoothNoise noise;
    double amplitude;
  };
  std::vector<Octave> octaves_;
};

struct Moments {
  double mean, deviation;
};

Moments moments(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0;
  for (const double value : values) sum += value;
  double squares = 0;
  for (const double value : values) squares += (value - sum / count) * (value - sum / count);
  return {sum / count, std::sqrt(squares / count)};
}

/// Adds `strength(crater) x ring(distance)` of each fresh crater to the cells around it.
template <typename Ring>
void add_around_craters(std::vector<float>& cells, const GridFrame& frame,
                        const std::vector<Crater>& craters, Ring ring) {
  for (const Crater& crater : craters) {
    if (crater.freshness() < 0.02) continue;
    const auto add = [&](std::size_t cell, double, double, double distance) {
      cells[cell] += static_cast<float>(crater.freshness() * ring(crater, distance));
    };
    for_cells_around(crater, CraterProfile::kReach, frame, add);
  }
}

/// Craters wipe out the swell of the old ground; the fine texture lies on top of everything,
/// rougher where fresh ejecta lie.
std::vector<float> make_heights(const SyntheticTerrainSettings& settings, const GridFrame& frame,
                                const std::vector<Crater>& craters) {
  const double longest_m =
      std::min({std::max(60.0, 12 * settings.cell_m), settings.width_m / 2, settings.height_m / 2});
  const double shortest_m = 3 * settings.cell_m;
  const double split_m = std::max(8.0, shortest_m);
  const FractalNoise swell(sub_seed(settings.seed, kGround), split_m, longest_m);
  const FractalNoise texture(sub_seed(settings.seed, kTexture), shortest_m,
                             std::min(split_m / 1.8, longest_m));
  std::vector<double> ground = over_cells<double>(frame, swell);
  const std::vector<double> fine = over_cells<double>(frame, texture);
  std::vector<double> both = ground;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] += fine[i];
  const auto [mean, deviation] = moments(both);
  const double scale = deviation > 0 ? settings.roughness_m / deviation : 0;
  for (double& height : ground) height = (height - mean) * scale;
  ground = with_craters(std::move(ground), frame, craters);
  std::vector<float> roughening(ground.size(), 1);
  add_around_craters(roughening, frame, craters, [](const Crater& crater, double distance) {
    const double outside = std::pow(std::max(distance, 1.0), -2);
    return std::min(4.0, 0.2 * crater.diameter_m) * outside * std::min(1.0, distance);
  });
  std::vector<float> heights(ground.size());
  for (std::size_t i = 0; i < ground.size(); ++i) {
    heights[i] = static_cast<float>(ground[i] + scale * roughening[i] * fine[i]);
  }
  return heights;
}

/// Rocks lie in patches, and thick on the rims of fresh craters that dug through the regolith
/// (some metres thick on the maria: craters from about ten metres on).
std::vector<float> rock_abundance(const SyntheticTerrainSettings& settings, const GridFrame& frame,
                                  const std::vector<Crater>& craters) {
  const SmoothNoise patches(sub_seed(settings.seed, kRockPatches), 30);
  std::vector<float> abundance = over_cells<float>(
      frame, [&](double x_m, double y_m) { return std::exp(1.5 * patches(x_m, y_m)); });
  add_around_craters(abundance, frame, craters, [](const Crater& crater, double distance) {
    const double dug_through = std::clamp((crater.diameter_m - 6) / 14, 0.0, 1.0);
    const double inside = 25 * std::min(1.0, distance * distance);
    const double outside = 25 * std::pow(std::max(distance, 1.0), -3);
    return dug_through * (distance < 1 ? inside : outside);
  });
  return abundance;
}

/// Zones of equal area of one smooth field of looseness, which fresh ejecta raise.
std::vector<std::int32_t> make_zones(const SyntheticTerrainSettings& settings,
                                     const GridFrame& frame, const std::vector<Crater>& craters) {
  const std::uint64_t seed = sub_seed(settings.seed, kZones);
  const SmoothNoise broad(sub_seed(seed, 0), settings.soil_zone_size_m);
  const SmoothNoise middle(sub_seed(seed, 1), settings.soil_zone_size_m / 2.3);
  const SmoothNoise fine(sub_seed(seed, 2), settings.soil_zone_size_m / 7);
  std::vector<float> looseness = over_cells<float>(frame, [&](double x_m, double y_m) {
    return broad(x_m, y_m) + 0.35 * middle(x_m, y_m) + 0.1 * fine(x_m, y_m);
  });
  add_around_craters(looseness, frame, craters, [](const Crater&, double distance) {
    return std::pow(std::max(distance, 1.0), -3);
  });
  std::vector<float> sorted = looseness;
  std::ranges::sort(sorted);
  const auto zones = static_cast<std::size_t>(settings.soil_zones);
  std::vector<float> bounds;
  for (std::size_t zone = 1; zone < zones; ++zone) {
    bounds.push_back(sorted[zone * sorted.size() / zones]);
  }
  std::vector<std::int32_t> codes;
  codes.reserve(looseness.size());
  for (const float value : looseness) {
    codes.push_back(
        static_cast<std::int32_t>(1 + (std::ranges::upper_bound(bounds, value) - bounds.begin())));
  }
  return codes;
}

}  // namespace

void validate(const SyntheticTerrainSettings& settings) {
  require("cell_m", settings.cell_m, {.min = 0.01, .max = 100});
  require("width_m", settings.width_m,
          {.min = 16 * settings.cell_m, .max = 20000 * settings.cell_m});
  require("height_m", settings.height_m,
          {.min = 16 * settings.cell_m, .max = 20000 * settings.cell_m});
  // A crater of fewer cells has neither rim nor floor.
  require("crater_diameter_min_m", settings.crater_diameter_min_m,
          {.min = 4 * settings.cell_m, .max = 5000});
  require("crater_diameter_max_m", settings.crater_diameter_max_m,
          {.min = settings.crater_diameter_min_m, .max = 5000});
  require("crater_density_scale", settings.crater_density_scale, {.min = 0, .max = 4});
  require("roughness_m", settings.roughness_m, {.min = 0, .max = 100});
  require("rock_coverage", settings.rock_coverage, {.min = 0, .max = 0.3});
  require("rock_diameter_min_m", settings.rock_diameter_min_m, {.min = 0.05, .max = 20});
  require("rock_diameter_max_m", settings.rock_diameter_max_m,
          {.min = settings.rock_diameter_min_m,
           .max = std::min({20.0, settings.width_m / 2, settings.height_m / 2})});
  require("soil_zones", settings.soil_zones, {.min = 1, .max = kSoilZonesMax});
  require("soil_zone_size_m", settings.soil_zone_size_m, {.min = 2 * settings.cell_m, .max = 1e6});
}

SyntheticTerrain make_synthetic_terrain(const SyntheticTerrainSettings& settings) {
  validate(settings);
  const auto cells = [&](double length_m) {
    return static_cast<int>(std::ceil(length_m / settings.cell_m - 1e-9));
  };
  GridFrame frame;
  frame.columns = cells(settings.width_m);
  frame.rows = cells(settings.height_m);
  frame.cell_width_m = frame.cell_height_m = settings.cell_m;
  frame.north_m = frame.rows * settings.cell_m;
  const std::vector<Crater> craters =
      draw_craters(frame, settings.crater_diameter_min_m, settings.crater_diameter_max_m,
                   settings.crater_density_scale, sub_seed(settings.seed, kCraters));
  SyntheticTerrain terrain;
  terrain.elevation = {frame, make_heights(settings, frame, craters)};
  terrain.classes = {frame, make_zones(settings, frame, craters)};
  terrain.rocks = scatter_rocks(frame, rock_abundance(settings, frame, craters),
                                {.coverage = settings.rock_coverage,
                                 .diameter_min_m = settings.rock_diameter_min_m,
                                 .diameter_max_m = settings.rock_diameter_max_m},
                                sub_seed(settings.seed, kRocks));
  return terrain;
}

}  // namespace regoplan
