#include "terramech/vehicle/wheel_loads.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <optional>

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
/// Neither turns under load, and the two rockers share the body's pitch moment equally.
UnitLoads rocker_bogie(const Vehicle& vehicle) {
  assert(vehicle.wheels.size() == 6 && vehicle.rocker_bogie);
  std::vector<double> axles;
  for (const WheelMount& wheel : vehicle.wheels) axles.push_back(wheel.x_m);
  std::sort(axles.begin(), axles.end());
  const double between_front_and_middle = (axles[3] + axles[4]) / 2;

  // Rows: sum N, sum N x, sum N y; left bogie, right bogie, difference of the rockers.
  Eigen::Matrix<double, 6, 6> balance = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const WheelMount& wheel = vehicle.wheels[static_cast<std::size_t>(i)];
    const bool left = wheel.y_m > 0;
    balance.col(i).head<3>() << 1, wheel.x_m, wheel.y_m;
    if (wheel.x_m < between_front_and_middle) {
      balance(left ? 3 : 4, i) = wheel.x_m - vehicle.rocker_bogie->bogie_pivot_x_m;
    }
    balance(5, i) = (left ? 1 : -1) * (wheel.x_m - vehicle.rocker_bogie->rocker_pivot_x_m);
  }
  return balance.inverse().leftCols<3>();
}

/// The wheel's mirror image on the other side, itself where it stands between the sides.
std::optional<Eigen::Index> twin_of(const Vehicle& vehicle, Eigen::Index wheel) {
  const WheelMount& own = vehicle.wheels[static_cast<std::size_t>(wheel)];
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    if (vehicle.wheels[i].x_m == own.x_m && vehicle.wheels[i].y_m == -own.y_m) {
      return static_cast<Eigen::Index>(i);
    }
  }
  return std::nullopt;
}

}  // namespace

LoadSharing::LoadSharing(const Vehicle& vehicle) {
  const UnitLoads unit = vehicle.suspension == Suspension::kRockerBogie ? rocker_bogie(vehicle)
                                                                        : equal_springs(vehicle);
  for (Eigen::Index i = 0; i < unit.rows(); ++i) {
    // Rounding, which a mirrored vehicle would show, is taken out where there is a twin.
    Eigen::RowVector3d mirrored = unit.row(i);
    if (const auto twin = twin_of(vehicle, i)) {
      mirrored = {unit(*twin, 0), unit(*twin, 1), -unit(*twin, 2)};
    }
    const Eigen::RowVector3d share = (unit.row(i) + mirrored) / 2;
    shares_.push_back({.of_normal = share[0],
                       .of_forward = -vehicle.cg_height_m * share[1],
                       .of_left = -vehicle.cg_height_m * share[2]});
  }
}

std::vector<double> LoadSharing::loads_n(const GroundReaction& reaction) const {
  std::vector<double> loads(shares_.size());
  for (std::size_t i = 0; i < loads.size(); ++i) loads[i] = load_n(i, reaction);
  return loads;
}

}  // namespace regoplan
