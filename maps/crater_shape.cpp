#include "maps/crater_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace regoplan {

namespace {

constexpr double kDepth = 0.196;  // of a fresh crater of 1 km, in diameters: Pike (1977)
constexpr double kRim = 0.036;    // likewise
constexpr double kExponent = 0.010;

constexpr double kNode = 0.02;  // radii between the nodes of the heat equation
constexpr int kNodes = static_cast<int>(CraterProfile::kReach / kNode) + 1;
constexpr double kStep = 0.2 * kNode * kNode;  // an explicit step is stable below a quarter
constexpr int kAges = 64;

/// How many steps a snapshot is old. They lie closer together while the crater changes fast.
int steps_of_snapshot(int snapshot) {
  const double share = static_cast<double>(snapshot) / (kAges - 1);
  return static_cast<int>(std::lround(CraterShape::kOldest * share * share / kStep));
}

double fresh_height(double distance) {
  if (distance <= 1) return kRim - kDepth * (1 - distance * distance);
  const double taper = std::clamp((CraterProfile::kReach - distance) / 2, 0.0, 1.0);
  return kRim * std::pow(distance, -3) * taper * taper * (3 - 2 * taper);
}

/// One step of dz/dt = 1/r d/dr (r dz/dr) in finite volumes; the outermost node stays at 0.
std::vector<double> diffused(const std::vector<double>& z) {
  std::vector<double> next = z;
  for (std::size_t i = 0; i + 1 < z.size(); ++i) {
    const double r = static_cast<double>(i);
    const double outer = (r + 0.5) * (z[i + 1] - z[i]);
    const double inner = i == 0 ? 0 : (r - 0.5) * (z[i] - z[i - 1]);
    // Area of the ring over 2 pi; the centre is a disc of half a node.
    const double ring = i == 0 ? 0.125 : r;
    next[i] = z[i] + kStep / (kNode * kNode) * (outer - inner) / ring;
  }
  return next;
}

double size_factor_m(double diameter_m) {
  return diameter_m * std::pow(diameter_m / 1000, kExponent);
}

}  // namespace

CraterShape::CraterShape() {
  std::vector<double> z(kNodes);
  for (int i = 0; i < kNodes; ++i) z[static_cast<std::size_t>(i)] = fresh_height(i * kNode);
  int steps = 0;
  for (int snapshot = 0; snapshot < kAges; ++snapshot) {
    for (; steps < steps_of_snapshot(snapshot); ++steps) z = diffused(z);
    heights_.push_back(z);
  }
}

CraterProfile CraterShape::profile(double diameter_m, double age) const {
  const double place = std::sqrt(std::clamp(age, 0.0, kOldest) / kOldest) * (kAges - 1);
  const auto younger = std::min(static_cast<std::size_t>(place), std::size_t{kAges - 2});
  const double share = place - static_cast<double>(younger);
  const double factor_m = size_factor_m(diameter_m);
  std::vector<double> height_m(kNodes);
  for (std::size_t i = 0; i < height_m.size(); ++i) {
    height_m[i] = factor_m * std::lerp(heights_[younger][i], heights_[younger + 1][i], share);
  }
  return CraterProfile(std::move(height_m));
}

CraterProfile::CraterProfile(std::vector<double> height_m) : height_m_(std::move(height_m)) {}

double CraterProfile::height_m(double distance) const {
  const double place = distance / kReach * static_cast<double>(height_m_.size() - 1);
  const auto node = static_cast<std::size_t>(place);
  if (node + 1 >= height_m_.size()) return 0;
  return height_m_[node] +
         (place - static_cast<double>(node)) * (height_m_[node + 1] - height_m_[node]);
}

double CraterProfile::depth_m() const {
  return rim_height_m() - height_m_.front();
}

double CraterProfile::rim_height_m() const {
  return *std::ranges::max_element(height_m_);
}

}  // namespace regoplan
