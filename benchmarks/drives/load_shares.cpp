#include "benchmarks/drives/load_shares.h"

#include <algorithm>

#include "benchmarks/drives/linear_system.h"

namespace regoplan::drives {
namespace {

/// Loads for a normal force, a force along and one to the left, of one newton each.
std::vector<std::array<double, 3>> sprung(const Vehicle& v) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (const WheelMount& w : v.wheels) {
    sx += w.x_m;
    sy += w.y_m;
    sxx += w.x_m * w.x_m;
    sxy += w.x_m * w.y_m;
    syy += w.y_m * w.y_m;
  }
  const auto count = static_cast<double>(v.wheels.size());
  std::vector<std::array<double, 3>> shares(v.wheels.size());
  const double right_side[3][3] = {{1, 0, 0}, {0, -v.cg_height_m, 0}, {0, 0, -v.cg_height_m}};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [a, b, c] = solved<3>({{{count, sx, sy, right_side[k][0]},
                                       {sx, sxx, sxy, right_side[k][1]},
                                       {sy, sxy, syy, right_side[k][2]}}});
    for (std::size_t i = 0; i < v.wheels.size(); ++i) {
      shares[i][k] = a + b * v.wheels[i].x_m + c * v.wheels[i].y_m;
    }
  }
  return shares;
}

/// Rocker and bogie of each side; front, middle and rear are told by x.
std::vector<std::array<double, 3>> rocking(const Vehicle& v) {
  const double rocker = v.rocker_bogie->rocker_pivot_x_m;
  const double bogie = v.rocker_bogie->bogie_pivot_x_m;
  std::array<std::array<std::size_t, 3>, 2> sides{};  // left, right: front, middle, rear
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<std::size_t> of_side;
    for (std::size_t i = 0; i < v.wheels.size(); ++i) {
      if ((v.wheels[i].y_m > 0) == (side == 0)) of_side.push_back(i);
    }
    std::ranges::sort(
        of_side, [&](std::size_t a, std::size_t b) { return v.wheels[a].x_m > v.wheels[b].x_m; });
    std::ranges::copy(of_side, sides[side].begin());
  }
  /// Loads of a side's wheels for its load and its half of the pitch moment.
  const auto split = [&](std::size_t side, double load, double moment) {
    const auto [f, m, r] = sides[side];
    const double front = (load * (rocker - bogie) + moment) / (v.wheels[f].x_m - bogie);
    const double rest = load - front;
    const double middle = rest * (bogie - v.wheels[r].x_m) / (v.wheels[m].x_m - v.wheels[r].x_m);
    return std::array{front, middle, rest - middle};
  };
  const auto roll = [&](std::size_t side, const std::array<double, 3>& loads) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += loads[i] * v.wheels[sides[side][i]].y_m;
    return sum;
  };
  std::vector<std::array<double, 3>> shares(v.wheels.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const double normal = k == 0 ? 1 : 0;
    const double pitch = k == 1 ? -v.cg_height_m : 0, lean = k == 2 ? -v.cg_height_m : 0;
    const double moment = (pitch - normal * rocker) / 2;
    const double unit_left = roll(0, split(0, 1, 0)), unit_right = roll(1, split(1, 1, 0));
    const double given = roll(0, split(0, 0, moment)) + roll(1, split(1, 0, moment));
    const auto [left, right] = solved<2>({{{1, 1, normal}, {unit_left, unit_right, lean - given}}});
    for (std::size_t side = 0; side < 2; ++side) {
      const auto loads = split(side, side == 0 ? left : right, moment);
      for (std::size_t i = 0; i < 3; ++i) shares[sides[side][i]][k] = loads[i];
    }
  }
  return shares;
}

}  // namespace

std::vector<std::array<double, 3>> load_shares(const Vehicle& vehicle) {
  return vehicle.rocker_bogie ? rocking(vehicle) : sprung(vehicle);
}

}  // namespace regoplan::drives
