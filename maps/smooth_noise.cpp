#include "maps/smooth_noise.h"

#include <array>
#include <cmath>
#include <numbers>

namespace regoplan {

namespace {

/// The finaliser of SplitMix64 (Steele et al. 2014).
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

struct Gradient {
  double x, y;
};

const std::array<Gradient, 64>& gradients() {
  static const std::array<Gradient, 64> directions = [] {
    std::array<Gradient, 64> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / 64;
      result[i] = {std::cos(angle), std::sin(angle)};
    }
    return result;
  }();
  return directions;
}

/// Slope of the field at a lattice point times the way from there.
double pull(std::uint64_t seed, std::int64_t column, std::int64_t row, double x, double y) {
  const std::uint64_t hash =
      mixed(seed + static_cast<std::uint64_t>(column) * 0x9e3779b97f4a7c15ULL +
            static_cast<std::uint64_t>(row) * 0xd1342543de82ef95ULL);
  const Gradient& gradient = gradients()[hash & 63];
  return gradient.x * x + gradient.y * y;
}

/// Blends with a continuous second derivative: no creases in a hillshade.
double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace

std::uint64_t sub_seed(std::uint64_t seed, std::uint64_t stream) {
  return mixed(mixed(seed + 0x9e3779b97f4a7c15ULL) + stream * 0x9e3779b97f4a7c15ULL);
}

SmoothNoise::SmoothNoise(std::uint64_t seed, double wavelength_m) : seed_(sub_seed(seed, 1)) {
  const double turn = 2 * std::numbers::pi * unit(sub_seed(seed, 2));
  cosine_pm_ = std::cos(turn) / wavelength_m;
  sine_pm_ = std::sin(turn) / wavelength_m;
  x_shift_ = 1000 * unit(sub_seed(seed, 3));
  y_shift_ = 1000 * unit(sub_seed(seed, 4));
}

double SmoothNoise::operator()(double x_m, double y_m) const {
  const double u = cosine_pm_ * x_m - sine_pm_ * y_m + x_shift_;
  const double v = sine_pm_ * x_m + cosine_pm_ * y_m + y_shift_;
  const auto column = static_cast<std::int64_t>(std::floor(u));
  const auto row = static_cast<std::int64_t>(std::floor(v));
  const double x = u - static_cast<double>(column);
  const double y = v - static_cast<double>(row);
  const double across = fade(x);
  const double near =
      std::lerp(pull(seed_, column, row, x, y), pull(seed_, column + 1, row, x - 1, y), across);
  const double far = std::lerp(pull(seed_, column, row + 1, x, y - 1),
                               pull(seed_, column + 1, row + 1, x - 1, y - 1), across);
  return std::lerp(near, far, fade(y));
}

}  // namespace regoplan
