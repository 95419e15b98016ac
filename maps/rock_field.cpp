#include "maps/rock_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <unordered_map>

#include "terramech/basics/input_error.h"

namespace regoplan {

namespace {

double decay_pm(double total_coverage) {
  return 1.79 + 0.152 / total_coverage;
}

double covered(double total_coverage, const RockFieldSettings& settings) {
  const double q = decay_pm(total_coverage);
  return total_coverage *
         (std::exp(-q * settings.diameter_min_m) - std::exp(-q * settings.diameter_max_m));
}

/// The k whose rocks between the two diameters cover what is asked: `covered` grows with k.
double total_coverage(const RockFieldSettings& settings) {
  const double most = covered(1, settings);
  if (settings.coverage > most) {
    throw ValueError("rock_coverage", settings.coverage,
                     fmt::format("0 to {:.3g} for rocks of {} to {} m", most,
                                 settings.diameter_min_m, settings.diameter_max_m));
  }
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (covered(middle, settings) < settings.coverage ? low : high) = middle;
  }
  return high;
}

/// Diameters, largest first, whose areas add up to the share asked of `area_m2`.
std::vector<double> draw_diameters(const RockFieldSettings& settings, double area_m2,
                                   std::mt19937_64& random) {
  const double q = decay_pm(total_coverage(settings));
  // The area covered falls as exp(-q D), the number of rocks as exp(-q D) / D^2: draw from the
  // first and keep with (D_min/D)^2.
  const double at_min = std::exp(-q * settings.diameter_min_m);
  const double at_max = std::exp(-q * settings.diameter_max_m);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<double> diameters;
  double missing_m2 = settings.coverage * area_m2;
  while (missing_m2 > 0) {
    const double d = std::clamp(-std::log(at_min - share(random) * (at_min - at_max)) / q,
                                settings.diameter_min_m, settings.diameter_max_m);
    if (share(random) > std::pow(settings.diameter_min_m / d, 2)) continue;
    const double area = 0.25 * std::numbers::pi * d * d;
    // The last rock is taken with the chance that makes the mean coverage right.
    if (area > missing_m2 && share(random) > missing_m2 / area) break;
    diameters.push_back(d);
    missing_m2 -= area;
  }
  std::ranges::sort(diameters, std::greater<>());
  return diameters;
}

/// Placed rocks by square bins as wide as the largest rock: neighbours lie in the bins next door.
class PlacedRocks {
 public:
  explicit PlacedRocks(double bin_m) : bin_m_(bin_m) {}

  bool room_for(const Rock& rock) const {
    const std::int64_t column = bin(rock.x_m);
    const std::int64_t row = bin(rock.y_m);
    for (std::int64_t c = column - 1; c <= column + 1; ++c) {
      for (std::int64_t r = row - 1; r <= row + 1; ++r) {
        const auto found = bins_.find(key(c, r));
        if (found == bins_.end()) continue;
        for (const Rock& other : found->second) {
          const double apart_m = std::hypot(rock.x_m - other.x_m, rock.y_m - other.y_m);
          if (apart_m <= rock.radius_m + other.radius_m) return false;
        }
      }
    }
    return true;
  }

  void add(const Rock& rock) { bins_[key(bin(rock.x_m), bin(rock.y_m))].push_back(rock); }

 private:
  std::int64_t bin(double at_m) const {
    return static_cast<std::int64_t>(std::floor(at_m / bin_m_));
  }
  static std::int64_t key(std::int64_t column, std::int64_t row) {
    return column * (std::int64_t{1} << 32) + row;
  }

  double bin_m_;
  std::unordered_map<std::int64_t, std::vector<Rock>> bins_;
};

}  // namespace

std::vector<Rock> scatter_rocks(const GridFrame& frame, const std::vector<float>& abundance,
                                const RockFieldSettings& settings, std::uint64_t seed) {
  if (settings.coverage == 0) return {};
  std::mt19937_64 random(seed);
  const double width_m = frame.east_m() - frame.west_m;
  const double height_m = frame.north_m - frame.south_m();
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> flatness(0.5, 0.08);
  // Cells are drawn by their abundance, so that a few rocky rims cost no more than an even field.
  std::discrete_distribution<std::size_t> cells(abundance.begin(), abundance.end());
  const auto place = [&](double radius_m) {
    const std::size_t cell = cells(random);
    const std::size_t column = cell % static_cast<std::size_t>(frame.columns);
    const std::size_t row = cell / static_cast<std::size_t>(frame.columns);
    Rock rock;
    rock.x_m = frame.west_m + (static_cast<double>(column) + share(random)) * frame.cell_width_m;
    rock.y_m = frame.north_m - (static_cast<double>(row) + share(random)) * frame.cell_height_m;
    rock.radius_m = radius_m;
    return rock;
  };
  PlacedRocks placed(settings.diameter_max_m);
  std::vector<Rock> rocks;
  for (const double diameter_m : draw_diameters(settings, width_m * height_m, random)) {
    const double shape = std::clamp(flatness(random), 0.3, 0.7);
    Rock rock;
    bool found = false;
    for (int attempt = 0; attempt < 2000 && !found; ++attempt) {
      rock = place(diameter_m / 2);
      found = rock.x_m - rock.radius_m >= frame.west_m &&
              rock.x_m + rock.radius_m <= frame.east_m() &&
              rock.y_m - rock.radius_m >= frame.south_m() &&
              rock.y_m + rock.radius_m <= frame.north_m && placed.room_for(rock);
    }
    if (!found) {
      throw ValueError("rock_coverage", settings.coverage,
                       fmt::format("less: after {} rocks there is no room left", rocks.size()));
    }
    rock.height_m = shape * diameter_m;
    placed.add(rock);
    rocks.push_back(rock);
  }
  return rocks;
}

}  // namespace regoplan
