#include "terramech/wheel_loads.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cassert>

namespace regoplan {
namespace {

/// Loads for unit values of (sum N, sum N x, sum N y), one row a wheel.
using UnitLoads = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Equal springs: N = a + b x + c y.
UnitLoads equal_springs(const Vehicle& vehicle) {
  const auto count = static_cast<Eigen::Index>(vehicle.wheels.size());
  UnitLoads place(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const WheelMount& wheel = vehicle.wheels[static_cast<std::size_t>(i)];
    place.row(i) << 1, wheel.x_m, wheel.y_m;
  }
  const Eigen::Matrix3d gram = place.transpose() * place;
  return place * gram.inverse();
}

/// Six wheels, three a side: the rocker carries the front wheel and, at its other end, the bogie.
UnitLoads rocker_bogie(const Vehicle& vehicle) {
  std::array<std::vector<std::size_t>, 2> sides;  // left, right
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    sides[vehicle.wheels[i].y_m > 0 ? 0 : 1].push_back(i);
  }
  assert(sides[0].size() == 3 && sides[1].size() == 3 && vehicle.rocker_bogie);
  const double pivot = vehicle.rocker_bogie->rocker_pivot_x_m;
  const double bogie = vehicle.rocker_bogie->bogie_pivot_x_m;
  const double y_left = vehicle.wheels[sides[0][0]].y_m;
  const double y_right = vehicle.wheels[sides[1][0]].y_m;

  UnitLoads unit = UnitLoads::Zero(6, 3);
  for (int column = 0; column < 3; ++column) {
    const double normal = column == 0, moment_x = column == 1, moment_y = column == 2;
    for (int side = 0; side < 2; ++side) {
      std::vector<std::size_t>& wheels = sides[static_cast<std::size_t>(side)];
      std::sort(wheels.begin(), wheels.end(), [&](std::size_t a, std::size_t b) {
        return vehicle.wheels[a].x_m > vehicle.wheels[b].x_m;
      });
      const double own = side == 0 ? y_left : y_right;
      const double other = side == 0 ? y_right : y_left;
      const double carried = (moment_y - other * normal) / (own - other);
      const double turned = (moment_x - pivot * normal) / 2;  // half by the differential
      const double front = vehicle.wheels[wheels[0]].x_m;
      const double middle = vehicle.wheels[wheels[1]].x_m;
      const double rear = vehicle.wheels[wheels[2]].x_m;
      const double on_front = (turned - carried * (bogie - pivot)) / (front - bogie);
      const double on_bogie = carried - on_front;
      unit(static_cast<Eigen::Index>(wheels[0]), column) = on_front;
      unit(static_cast<Eigen::Index>(wheels[1]), column) =
          on_bogie * (bogie - rear) / (middle - rear);
      unit(static_cast<Eigen::Index>(wheels[2]), column) =
          on_bogie * (middle - bogie) / (middle - rear);
    }
  }
  return unit;
}

}  // namespace

LoadSharing::LoadSharing(const Vehicle& vehicle) {
  const UnitLoads unit = vehicle.suspension == Suspension::kRockerBogie ? rocker_bogie(vehicle)
                                                                        : equal_springs(vehicle);
  for (Eigen::Index i = 0; i < unit.rows(); ++i) {
    shares_.push_back({.of_normal = unit(i, 0),
                       .of_forward = -vehicle.cg_height_m * unit(i, 1),
                       .of_left = -vehicle.cg_height_m * unit(i, 2)});
  }
}

std::vector<double> LoadSharing::loads_n(const GroundReaction& reaction) const {
  std::vector<double> loads(shares_.size());
  for (std::size_t i = 0; i < loads.size(); ++i) loads[i] = load_n(i, reaction);
  return loads;
}

}  // namespace regoplan
