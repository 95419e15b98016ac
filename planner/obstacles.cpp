#include "planner/obstacles.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace regoplan {
namespace {

using Transform = fcl::Transform3d;
using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

/// A box fixed to the vehicle.
struct Part {
  std::shared_ptr<fcl::Boxd> box;
  Eigen::Vector3d centre;  // vehicle frame
};

Part part(double x_min, double x_max, double y_min, double y_max, double z_min, double z_max) {
  return {std::make_shared<fcl::Boxd>(x_max - x_min, y_max - y_min, z_max - z_min),
          {(x_min + x_max) / 2, (y_min + y_max) / 2, (z_min + z_max) / 2}};
}

/// Where a vehicle stands: its axes on the patch, its origin on the ground.
Transform stand(double x_m, double y_m, double yaw_rad, const GroundPatch& patch) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  const double p = patch.slope_forward, q = patch.slope_left;
  const Eigen::Vector3d up_in_heading = Eigen::Vector3d{-p, -q, 1}.normalized();
  const Eigen::Vector3d forward_in_heading = Eigen::Vector3d{1, 0, p}.normalized();
  Eigen::Matrix3d turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  Transform place = Transform::Identity();
  place.linear().col(0) = turn * forward_in_heading;
  place.linear().col(1) = turn * up_in_heading.cross(forward_in_heading);
  place.linear().col(2) = turn * up_in_heading;
  place.translation() = Eigen::Vector3d{x_m, y_m, patch.z_m};
  return place;
}

}  // namespace

struct Obstacles::Shapes {
  const TerrainMap& map;
  double step_max_m;
  Part body;
  std::vector<Part> wheels;
  double reach_m = 0;  // of any part, from the vehicle's origin

  Shapes(const TerrainMap& map_, const Vehicle& vehicle, double clearance)
      : map(map_), step_max_m(vehicle.step_max_m) {
    const BodyBox& b = vehicle.body;
    constexpr double kMostOfHeight = 0.1;
    body = part(b.x_min_m - clearance, b.x_max_m + clearance, b.y_min_m - clearance,
                b.y_max_m + clearance,
                b.clearance_m - std::min(clearance, kMostOfHeight * b.clearance_m),
                b.clearance_m + b.height_m);
    const double r = vehicle.wheel.radius_m, half_width = vehicle.wheel.width_m / 2;
    for (const WheelMount& wheel : vehicle.wheels) {
      // Steered or not, the box holds the wheel at any angle of its range.
      const double angle = wheel.steered ? vehicle.steer_angle_max_rad : 0;
      const double long_half = r * std::cos(angle) + half_width * std::sin(angle);
      const double x_half = (wheel.steered ? std::max(r, long_half) : r) + clearance;
      const double y_half =
          (wheel.steered ? r * std::sin(angle) + half_width * std::cos(angle) : half_width) +
          clearance;
      wheels.push_back(part(wheel.x_m - x_half, wheel.x_m + x_half, wheel.y_m - y_half,
                            wheel.y_m + y_half, vehicle.step_max_m,
                            std::max(2 * r, vehicle.step_max_m + 0.01)));
    }
    const auto consider = [&](const Part& p) {
      reach_m = std::max(reach_m, std::hypot(std::abs(p.centre.x()) + p.box->side.x() / 2,
                                             std::abs(p.centre.y()) + p.box->side.y() / 2));
    };
    consider(body);
    for (const Part& wheel : wheels) consider(wheel);
  }

  template <class Geometry>
  static bool touch(const Part& part, const Transform& stand, const Geometry& other,
                    const Transform& place) {
    Transform at = stand;
    at.translation() = stand * part.centre;
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(part.box.get(), at, &other, place, request, result) > 0;
  }

  bool hits_rock(const Transform& stand) const {
    const double x = stand.translation().x(), y = stand.translation().y();
    return map.any_rock(x - reach_m, x + reach_m, y - reach_m, y + reach_m, [&](const Rock& rock) {
      if (rock.height_m <= step_max_m) return false;
      // It stands in the ground as deep as it rises, so that no slope shows a gap beneath it.
      const double ground = map.height_m(rock.x_m, rock.y_m);
      if (std::isnan(ground)) return false;
      const fcl::Cylinderd cylinder(rock.radius_m, 2 * rock.height_m);
      Transform place = Transform::Identity();
      place.translation() = Eigen::Vector3d{rock.x_m, rock.y_m, ground};
      return touch(body, stand, cylinder, place) ||
             std::any_of(wheels.begin(), wheels.end(),
                         [&](const Part& wheel) { return touch(wheel, stand, cylinder, place); });
    });
  }

  bool hits_ground(const Transform& stand) const {
    // Corners of the body's underside bound its footprint and its lowest point.
    const Eigen::Vector3d half = body.box->side / 2;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        const Eigen::Vector3d corner =
            stand * (body.centre + Eigen::Vector3d{sx * half.x(), sy * half.y(), -half.z()});
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
      }
    }
    if (map.max_height_m(low.x(), high.x(), low.y(), high.y()) < low.z()) return false;
    const CellRange cells = cells_below(low, high);
    return reaches_underside(stand, cells) &&
           touch(body, stand, mesh_over(cells), Transform::Identity());
  }

  /// Elevation cells whose centres span a rectangle.
  struct CellRange {
    int column_first = 0, column_last = 0, row_first = 0, row_last = 0;
  };

  CellRange cells_below(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
    const GridFrame& frame = map.elevation().frame;
    const auto column_of = [&](double x) {
      return static_cast<int>(std::floor((x - frame.west_m) / frame.cell_width_m - 0.5));
    };
    const auto row_of = [&](double y) {
      return static_cast<int>(std::floor((frame.north_m - y) / frame.cell_height_m - 0.5));
    };
    return {.column_first = std::clamp(column_of(low.x()), 0, frame.columns - 1),
            .column_last = std::clamp(column_of(high.x()) + 1, 0, frame.columns - 1),
            .row_first = std::clamp(row_of(high.y()), 0, frame.rows - 1),
            .row_last = std::clamp(row_of(low.y()) + 1, 0, frame.rows - 1)};
  }

  Eigen::Vector3d vertex(int row, int column) const {
    const GridFrame& frame = map.elevation().frame;
    const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                      static_cast<std::size_t>(column);
    return {frame.west_m + (column + 0.5) * frame.cell_width_m,
            frame.north_m - (row + 0.5) * frame.cell_height_m, map.elevation().height_m[cell]};
  }

  /// Whether any vertex rises above the plane of the body's underside; where none does, no triangle
  /// can touch the body, and the dearer test is saved.
  bool reaches_underside(const Transform& stand, const CellRange& cells) const {
    const Eigen::Vector3d up = stand.linear().col(2);
    const double underside = up.dot(stand.translation()) + body.centre.z() - body.box->side.z() / 2;
    for (int row = cells.row_first; row <= cells.row_last; ++row) {
      for (int column = cells.column_first; column <= cells.column_last; ++column) {
        if (up.dot(vertex(row, column)) >= underside) return true;
      }
    }
    return false;
  }

  Mesh mesh_over(const CellRange& cells) const {
    Mesh mesh;
    mesh.beginModel();
    for (int r = cells.row_first; r < cells.row_last; ++r) {
      for (int c = cells.column_first; c < cells.column_last; ++c) {
        mesh.addTriangle(vertex(r, c), vertex(r + 1, c), vertex(r, c + 1));
        mesh.addTriangle(vertex(r, c + 1), vertex(r + 1, c), vertex(r + 1, c + 1));
      }
    }
    mesh.endModel();
    return mesh;
  }
};

Obstacles::Obstacles(const TerrainMap& map, const Vehicle& vehicle, double clearance_m)
    : shapes_(std::make_unique<Shapes>(map, vehicle, clearance_m)) {}

Obstacles::~Obstacles() = default;

bool Obstacles::hit(double x_m, double y_m, double yaw_rad, const GroundPatch& patch) const {
  const Transform place = stand(x_m, y_m, yaw_rad, patch);
  return shapes_->hits_rock(place) || shapes_->hits_ground(place);
}

}  // namespace regoplan
