#include "terramech/margins/supply_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBentIntervals = 6, kOuterIntervals = 8;  // of curvature, either side
constexpr std::size_t kCurvatures = 2 * (kBentIntervals + kOuterIntervals) + 1;
constexpr std::size_t kForces = 33;
constexpr std::size_t kNormals = 3;
constexpr double kHollow = 0.35;        // of the weight, that dips add to the loads and crests take
constexpr double kCheckedForce = 0.45;  // over the normal load: what steady manoeuvres come to
constexpr double kForceMax = 0.7;       // over the normal load; steeper than tan of any slope limit

/// Whether every wheel has a twin on the other side: left turns then mirror right turns.
bool is_mirror_symmetric(const Vehicle& vehicle) {
  return std::all_of(vehicle.wheels.begin(), vehicle.wheels.end(), [&](const WheelMount& wheel) {
    return std::any_of(vehicle.wheels.begin(), vehicle.wheels.end(), [&](const WheelMount& twin) {
      return twin.x_m == wheel.x_m && twin.y_m == -wheel.y_m && twin.steered == wheel.steered &&
             twin.driven == wheel.driven;
    });
  });
}

/// Curvature of a node over the largest: finest about straight driving, where fast vehicles live,
/// and again near full lock, where the steering's range comes to decide within a short way.
double share_of_node(std::size_t node) {
  constexpr std::size_t kMiddle = kCurvatures / 2;
  constexpr double kPower = 1.5, kWhole = kBentIntervals + 2;
  const std::size_t out = node > kMiddle ? node - kMiddle : kMiddle - node;
  const double bent = static_cast<double>(std::min(out, kBentIntervals));
  const double outer = static_cast<double>(out) - bent;
  const double from = std::pow(bent / kWhole, kPower);
  const double share = from + (1 - from) * outer / static_cast<double>(kOuterIntervals);
  return node < kMiddle ? -share : share;
}

/// Of each interval of curvatures: the most found anywhere, while that is little. Where tight turns
/// scrub, as of skid steering, it is a third of the load and says nothing of straight ways; there
/// the most found in the interval and in those beside it.
std::vector<double> bounds_of(const std::vector<std::vector<double>>& excess) {
  constexpr double kReserve = 1.5, kLittle = 0.02;
  std::vector<double> most(excess.size(), 0);
  for (std::size_t i = 0; i < excess.size(); ++i) {
    for (const double one : excess[i]) most[i] = std::max(most[i], one);
  }
  const double anywhere = most.empty() ? 0 : *std::ranges::max_element(most);
  std::vector<double> bounds(excess.size());
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const double before = i > 0 ? most[i - 1] : 0, after = i + 1 < most.size() ? most[i + 1] : 0;
    const double near = kReserve * std::max({before, most[i], after});
    bounds[i] = std::max(near, std::min(kReserve * anywhere, kLittle));
  }
  return bounds;
}

/// Every wheel on the same soil.
std::vector<WheelLaw> same_soil(const Vehicle& vehicle, const WheelLaw& law) {
  return std::vector<WheelLaw>(vehicle.wheels.size(), law);
}

}  // namespace

SupplyTable::SupplyTable(const Vehicle& vehicle, const WheelLaw& law, const TrimLimits& limits,
                         double weight_n, double tilt_max_rad, int threads)
    : weight_n_(weight_n) {
  for (std::size_t i = 0; i < kCurvatures; ++i) {
    curvatures_1pm_.push_back(vehicle.curvature_max_1pm * share_of_node(i));
  }
  for (std::size_t i = 0; i < kForces; ++i) {
    forces_.push_back(kForceMax * (2 * static_cast<double>(i) / (kForces - 1) - 1));
  }
  normals_ = {std::cos(tilt_max_rad) - kHollow, 1, 1 + kHollow};

  const bool mirrors = is_mirror_symmetric(vehicle);
  const std::size_t count = kCurvatures * kForces * kNormals;
  right_.assign(count, kNone);
  left_.assign(count, kNone);
  traction_.assign(count, kNone);
  const LoadSharing sharing(vehicle);
  const std::vector<WheelLaw> laws = same_soil(vehicle, law);
  const std::size_t first = mirrors ? kCurvatures / 2 * kForces * kNormals : 0;
  parallel_for(count - first, threads, [&](std::size_t number) {
    const std::size_t i = first + number;
    const double normal = weight_n * normals_[i % kNormals];
    const double force = forces_[i / kNormals % kForces] * normal;
    const SteadyManoeuvre manoeuvre(vehicle, sharing, laws,
                                    curvatures_1pm_[i / (kNormals * kForces)], normal);
    const SupplyResult result = cornering_supply(manoeuvre, force, limits);
    if (result.supply) {
      right_[i] = result.supply->right.force_n / normal;
      left_[i] = result.supply->left.force_n / normal;
    }
    const auto traction = largest_traction_n(manoeuvre, {.forward_n = 0, .left_n = force}, limits);
    if (traction) traction_[i] = *traction / normal;
  });
  for (std::size_t i = 0; i < first; ++i) {  // right turns, as left turns in the mirror
    const std::size_t k = kCurvatures - 1 - i / (kNormals * kForces);
    const std::size_t j = i / kNormals % kForces, n = i % kNormals;
    const std::size_t same_force = (k * kForces + j) * kNormals + n;
    const std::size_t opposite_force = (k * kForces + kForces - 1 - j) * kNormals + n;
    right_[i] = -left_[same_force];
    left_[i] = -right_[same_force];
    traction_[i] = traction_[opposite_force];
  }
  std::vector<std::vector<double>> excess(kCurvatures - 1);
  const std::size_t middle = (kCurvatures - 1) / 2;
  parallel_for(kCurvatures - 1 - (mirrors ? middle : 0), threads, [&](std::size_t number) {
    const std::size_t interval = (mirrors ? middle : 0) + number;
    excess[interval] = excesses(vehicle, sharing, laws, limits, interval);
  });
  for (std::size_t i = 0; mirrors && i < middle; ++i) excess[i] = excess[kCurvatures - 2 - i];

  overestimate_bounds_ = bounds_of(excess);
  std::vector<double> losses;
  for (std::size_t i = 0; i < excess.size(); ++i) {
    for (const double one : excess[i]) losses.push_back(overestimate_bounds_[i] - one);
  }
  if (losses.empty()) return;  // no supply anywhere
  std::sort(losses.begin(), losses.end());
  loss_ = {.median = losses[losses.size() / 2], .at_99_percent = losses[losses.size() * 99 / 100]};
}

std::vector<double> SupplyTable::excesses(const Vehicle& vehicle, const LoadSharing& sharing,
                                          std::span<const WheelLaw> laws, const TrimLimits& limits,
                                          std::size_t interval) const {
  std::mt19937_64 random(20040928 + interval);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> excesses;
  for (int i = 0; i < kChecksPerInterval; ++i) {
    const double curvature =
        std::lerp(curvatures_1pm_[interval], curvatures_1pm_[interval + 1], unit(random));
    const double normal = weight_n_ * std::lerp(normals_.front(), normals_.back(), unit(random));
    const double force = kCheckedForce * (2 * unit(random) - 1) * normal;
    const SteadyManoeuvre manoeuvre(vehicle, sharing, laws, curvature, normal);
    const auto tabled = interpolated_supply(curvature, force, normal);
    const SupplyResult solved = cornering_supply(manoeuvre, force, limits);
    if (tabled && solved.supply) {
      excesses.push_back((tabled->left_n - solved.supply->left.force_n) / normal);
      excesses.push_back((solved.supply->right.force_n - tabled->right_n) / normal);
    }
    const auto tabled_traction = interpolated_traction_n(curvature, force, normal);
    const auto traction = largest_traction_n(manoeuvre, {.forward_n = 0, .left_n = force}, limits);
    if (tabled_traction && traction) excesses.push_back((*tabled_traction - *traction) / normal);
  }
  return excesses;
}

std::optional<SupplyInterval> SupplyTable::supply(double curvature_1pm, double forward_n,
                                                  double normal_n) const {
  const auto interval = interpolated_supply(curvature_1pm, forward_n, normal_n);
  if (!interval) return std::nullopt;
  const double bound = overestimate_bound(curvature_1pm) * normal_n;
  return SupplyInterval{.right_n = interval->right_n + bound, .left_n = interval->left_n - bound};
}

std::optional<double> SupplyTable::traction_n(double curvature_1pm, double left_n,
                                              double normal_n) const {
  const auto traction = interpolated_traction_n(curvature_1pm, left_n, normal_n);
  if (!traction) return std::nullopt;
  return *traction - overestimate_bound(curvature_1pm) * normal_n;
}

double SupplyTable::overestimate_bound(double curvature_1pm) const {
  const auto above =
      std::upper_bound(curvatures_1pm_.begin() + 1, curvatures_1pm_.end() - 1, curvature_1pm);
  return overestimate_bounds_[static_cast<std::size_t>(above - curvatures_1pm_.begin()) - 1];
}

std::optional<SupplyTable::Cell> SupplyTable::locate(const std::vector<double>& nodes,
                                                     double value) {
  constexpr double kRounding = 1e-9;
  if (!(value >= nodes.front() - kRounding && value <= nodes.back() + kRounding)) return {};
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, value);
  const auto low = static_cast<std::size_t>(above - nodes.begin()) - 1;
  return Cell{low, std::clamp((value - nodes[low]) / (nodes[low + 1] - nodes[low]), 0.0, 1.0)};
}

std::optional<double> SupplyTable::interpolate(const std::vector<double>& values,
                                               std::size_t middle, std::size_t inner, const Cell& a,
                                               const Cell& b, const Cell& c) {
  double sum = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::size_t i = corner >> 2, j = corner >> 1 & 1, k = corner & 1;
    const double weight =
        (i ? a.share : 1 - a.share) * (j ? b.share : 1 - b.share) * (k ? c.share : 1 - c.share);
    if (weight > 0) sum += weight * values[((a.low + i) * middle + b.low + j) * inner + c.low + k];
  }
  if (std::isnan(sum)) return std::nullopt;
  return sum;
}

std::optional<SupplyInterval> SupplyTable::interpolated_supply(double curvature_1pm,
                                                               double forward_n,
                                                               double normal_n) const {
  const auto a = locate(curvatures_1pm_, curvature_1pm);
  const auto b = locate(forces_, forward_n / normal_n);
  const auto c = locate(normals_, normal_n / weight_n_);
  if (!a || !b || !c) return std::nullopt;
  const auto right = interpolate(right_, kForces, kNormals, *a, *b, *c);
  const auto left = interpolate(left_, kForces, kNormals, *a, *b, *c);
  if (!right || !left) return std::nullopt;
  return SupplyInterval{.right_n = *right * normal_n, .left_n = *left * normal_n};
}

std::optional<double> SupplyTable::interpolated_traction_n(double curvature_1pm, double left_n,
                                                           double normal_n) const {
  const auto a = locate(curvatures_1pm_, curvature_1pm);
  const auto b = locate(forces_, left_n / normal_n);
  const auto c = locate(normals_, normal_n / weight_n_);
  if (!a || !b || !c) return std::nullopt;
  const auto traction = interpolate(traction_, kForces, kNormals, *a, *b, *c);
  if (!traction) return std::nullopt;
  return *traction * normal_n;
}

}  // namespace regoplan
