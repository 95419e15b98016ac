#include "maps/ground_finder.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace regoplan {

GroundFinder::GroundFinder(const TerrainMap& map, const Vehicle& vehicle)
    : map_(map), vehicle_(vehicle) {
  const auto count = static_cast<Eigen::Index>(vehicle.wheels.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> place(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const WheelMount& wheel = vehicle.wheels[static_cast<std::size_t>(i)];
    place.row(i) << 1, wheel.x_m, wheel.y_m;
  }
  const Eigen::Matrix3d gram = place.transpose() * place;
  const Eigen::Matrix<double, 3, Eigen::Dynamic> fit = gram.inverse() * place.transpose();
  for (Eigen::Index i = 0; i < count; ++i) {
    fit_[static_cast<std::size_t>(i)] = {fit(0, i), fit(1, i), fit(2, i)};
  }
  const auto [rear, front] = std::ranges::minmax(vehicle.wheels, {}, &WheelMount::x_m);
  wheelbase_m_ = front.x_m - rear.x_m;
}

GroundPatch GroundFinder::at(double x_m, double y_m, double yaw_rad) const {
  GroundPatch patch;
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    const WheelMount& wheel = vehicle_.wheels[i];
    const double x = x_m + c * wheel.x_m - s * wheel.y_m;
    const double y = y_m + s * wheel.x_m + c * wheel.y_m;
    const double height = map_.height_m(x, y);
    const auto soil = map_.soil_index(x, y);
    if (std::isnan(height) || !soil) return {};
    patch.z_m += fit_[i][0] * height;
    patch.slope_forward += fit_[i][1] * height;
    patch.slope_left += fit_[i][2] * height;
    patch.soil[i] = static_cast<std::int16_t>(*soil);
  }
  patch.known = true;
  const double reach_x = wheelbase_m_ * c, reach_y = wheelbase_m_ * s;
  const double bend_m = map_.height_m(x_m + reach_x, y_m + reach_y) - 2 * map_.height_m(x_m, y_m) +
                        map_.height_m(x_m - reach_x, y_m - reach_y);
  if (!std::isnan(bend_m)) patch.curvature_1pm = bend_m / (wheelbase_m_ * wheelbase_m_);
  return patch;
}

}  // namespace regoplan
