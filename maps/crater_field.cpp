#include "maps/crater_field.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "maps/smooth_noise.h"

namespace regoplan {

namespace {

constexpr double kEquilibriumDensity = 0.079;  // craters above 1 m a square metre

/// Height at the centre and slopes along x and y of the older ground under the crater's bowl.
Eigen::Vector3d plane_under(const Crater& crater, const std::vector<double>& height_m,
                            const GridFrame& frame) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double radius_m = crater.diameter_m / 2;
  for_cells_around(crater, 1, frame, [&](std::size_t cell, double x_m, double y_m, double) {
    const Eigen::Vector3d basis(1, (x_m - crater.x_m) / radius_m, (y_m - crater.y_m) / radius_m);
    normal += basis * basis.transpose();
    right += basis * height_m[cell];
  });
  // A crater of which a sliver or nothing lies on the grid: the level that is there, no slope.
  if (normal(0, 0) == 0) return Eigen::Vector3d::Zero();
  normal(1, 1) += 0.01 * normal(0, 0);
  normal(2, 2) += 0.01 * normal(0, 0);
  const Eigen::Vector3d scaled = normal.ldlt().solve(right);
  return {scaled[0], scaled[1] / radius_m, scaled[2] / radius_m};
}

/// 1 in the bowl, 0 beyond the rim: how far the impact has wiped out what was there. The edge of
/// what it replaced wears down with the crater.
double wiped_out(double distance, double age) {
  const double half_width = 0.2 + 0.9 * std::sqrt(age);
  const double t = std::clamp(0.5 + 0.5 * (1.05 - distance) / half_width, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Lets ground that stands steeper than it can slide down, between neighbours, until it rests.
void slump(std::vector<double>& height_m, const GridFrame& frame) {
  struct Neighbour {
    int columns, rows;
  };
  constexpr double kRepose = 0.754;  // tan 37 deg: dry regolith, as the walls of fresh craters
  constexpr int kSweepsMax = 100;
  for (int sweep = 0; sweep < kSweepsMax; ++sweep) {
    bool slid = false;
    for (const auto& [columns, rows] : {Neighbour{1, 0}, {0, 1}, {1, 1}, {-1, 1}}) {
      const double drop_max_m =
          kRepose * std::hypot(columns * frame.cell_width_m, rows * frame.cell_height_m);
      for (int row = 0; row + rows < frame.rows; ++row) {
        const int end = frame.columns - std::max(columns, 0);
        for (int column = std::max(-columns, 0); column < end; ++column) {
          const std::ptrdiff_t cell = static_cast<std::ptrdiff_t>(row) * frame.columns + column;
          double& here = height_m[static_cast<std::size_t>(cell)];
          double& there = height_m[static_cast<std::size_t>(
              cell + static_cast<std::ptrdiff_t>(rows) * frame.columns + columns)];
          const double excess = std::abs(here - there) - drop_max_m;
          if (excess <= 1e-3 * drop_max_m) continue;
          const double slide = std::copysign(0.5 * excess, here - there);
          here -= slide;
          there += slide;
          slid = true;
        }
      }
    }
    if (!slid) return;
  }
}

}  // namespace

double Crater::freshness() const {
  return std::exp(-age / 0.04);
}

double Crater::distance(double x_at_m, double y_at_m) const {
  const double dx = x_at_m - x_m;
  const double dy = y_at_m - y_m;
  const double away_m = std::sqrt(dx * dx + dy * dy);
  if (away_m == 0) return 0;
  const double c = dx / away_m;
  const double s = dy / away_m;
  // Multiple angles by turning on: cheaper than four sines a cell.
  double cosine = c;
  double sine = s;
  double rim = 1;
  for (std::size_t i = 0; i < wave_cos.size(); ++i) {
    const double turned = cosine * c - sine * s;
    sine = sine * c + cosine * s;
    cosine = turned;
    rim += wave_cos[i] * cosine + wave_sin[i] * sine;
  }
  return away_m / (0.5 * diameter_m * rim);
}

std::vector<Crater> draw_craters(const GridFrame& frame, double diameter_min_m,
                                 double diameter_max_m, double density_scale, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double border_m = 0.5 * CraterProfile::kReach * diameter_max_m;
  const double width_m = frame.east_m() - frame.west_m + 2 * border_m;
  const double height_m = frame.north_m - frame.south_m() + 2 * border_m;
  const double small = std::pow(diameter_min_m, -2);
  const double large = std::pow(diameter_max_m, -2);
  const double expected =
      density_scale * kEquilibriumDensity * (small - large) * width_m * height_m;
  const int count = expected > 0 ? std::poisson_distribution<int>(expected)(random) : 0;
  std::uniform_real_distribution<double> share(0, 1);
  std::normal_distribution<double> wave(0, 1);
  std::vector<Crater> craters;
  for (int i = 0; i < count; ++i) {
    Crater crater;
    crater.x_m = frame.west_m - border_m + width_m * share(random);
    crater.y_m = frame.south_m() - border_m + height_m * share(random);
    crater.diameter_m = std::pow(small - share(random) * (small - large), -0.5);
    crater.age = std::lerp(CraterShape::kYoungest, CraterShape::kOldest, share(random));
    for (std::size_t k = 0; k < crater.wave_cos.size(); ++k) {
      // Two standard deviations of all four at once stay within kRimMax.
      const double amplitude = 0.022 * 2 / (2 + static_cast<double>(k));
      crater.wave_cos[k] = amplitude * std::clamp(wave(random), -2.0, 2.0);
      crater.wave_sin[k] = amplitude * std::clamp(wave(random), -2.0, 2.0);
    }
    // Those that do not reach in are drawn all the same: the surface does not hang on the border.
    const double reach_m = 0.5 * CraterProfile::kReach * crater.diameter_m * Crater::kRimMax;
    const bool reaches_in =
        crater.x_m + reach_m > frame.west_m && crater.x_m - reach_m < frame.east_m() &&
        crater.y_m + reach_m > frame.south_m() && crater.y_m - reach_m < frame.north_m;
    if (reaches_in) craters.push_back(crater);
  }
  // Time itself, not the age in radii: a large crater wears down more slowly.
  const auto time = [](const Crater& crater) {
    return crater.age * crater.diameter_m * crater.diameter_m;
  };
  std::ranges::stable_sort(craters, std::greater<>(), time);
  return craters;
}

std::vector<double> with_craters(std::vector<double> height_m, const GridFrame& frame,
                                 const std::vector<Crater>& craters) {
  const CraterShape shape;
  for (const Crater& crater : craters) {
    const Eigen::Vector3d plane = plane_under(crater, height_m, frame);
    const CraterProfile profile = shape.profile(crater.diameter_m, crater.age);
    const auto dig = [&](std::size_t cell, double x_m, double y_m, double distance) {
      const double before =
          plane[0] + plane[1] * (x_m - crater.x_m) + plane[2] * (y_m - crater.y_m);
      height_m[cell] +=
          wiped_out(distance, crater.age) * (before - height_m[cell]) + profile.height_m(distance);
    };
    for_cells_around(crater, CraterProfile::kReach, frame, dig);
  }
  slump(height_m, frame);
  return height_m;
}

}  // namespace regoplan
