#include "planner/problem/obstacles.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "terramech/vehicle/steered_wheel.h"

namespace regoplan {
namespace {

using Transform = fcl::Transform3d;
using Mesh = fcl::BVHModel<fcl::OBBRSSd>;

/// A box fixed to the vehicle, turned about its own upright axis.
struct Part {
  std::shared_ptr<fcl::Boxd> box;
  Eigen::Vector3d centre;  // vehicle frame
  double reach_m = 0;      // of any point of it, from its centre

  double underside_m() const { return centre.z() - box->side.z() / 2; }
};

Part part(const Eigen::Vector3d& side, double centre_x, double centre_y, double underside) {
  return {.box = std::make_shared<fcl::Boxd>(side),
          .centre = {centre_x, centre_y, underside + side.z() / 2},
          .reach_m = side.norm() / 2};
}

Part body_of(const Vehicle& vehicle, double clearance) {
  const BodyBox& b = vehicle.body;
  constexpr double kMostOfHeight = 0.1;
  const double underside = b.clearance_m - std::min(clearance, kMostOfHeight * b.clearance_m);
  return part({b.x_max_m - b.x_min_m + 2 * clearance, b.y_max_m - b.y_min_m + 2 * clearance,
               b.clearance_m + b.height_m - underside},
              (b.x_min_m + b.x_max_m) / 2, (b.y_min_m + b.y_max_m) / 2, underside);
}

Part wheel_of(const Vehicle& vehicle, const WheelMount& mount, double clearance) {
  const double diameter = 2 * vehicle.wheel.radius_m;
  const double top = std::max(diameter, vehicle.step_max_m + 0.01);
  return part(
      {diameter + 2 * clearance, vehicle.wheel.width_m + 2 * clearance, top - vehicle.step_max_m},
      mount.x_m, mount.y_m, vehicle.step_max_m);
}

SteeredWheel steering_of(const Vehicle& vehicle, const WheelMount& mount,
                         const VehicleState& state) {
  if (state.turn_rate_rad_s != 0) return wheel_on_the_spot(vehicle, mount);
  return steered_wheel(vehicle, mount,
                       {.curvature_1pm = state.curvature_1pm, .crab_rad = state.crab_rad});
}

/// Where a vehicle stands: its axes on the patch, its origin on the ground.
Transform stand(const VehicleState& state, const GroundPatch& patch) {
  const double c = std::cos(state.yaw_rad), s = std::sin(state.yaw_rad);
  const double p = patch.slope_forward, q = patch.slope_left;
  const Eigen::Vector3d up_in_heading = Eigen::Vector3d{-p, -q, 1}.normalized();
  const Eigen::Vector3d forward_in_heading = Eigen::Vector3d{1, 0, p}.normalized();
  Eigen::Matrix3d turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  Transform place = Transform::Identity();
  place.linear().col(0) = turn * forward_in_heading;
  place.linear().col(1) = turn * up_in_heading.cross(forward_in_heading);
  place.linear().col(2) = turn * up_in_heading;
  place.translation() = Eigen::Vector3d{state.x_m, state.y_m, patch.z_m};
  return place;
}

}  // namespace

struct Obstacles::Shapes {
  const TerrainMap& map;
  const Vehicle& vehicle;
  Part body;
  std::vector<Part> wheels;  // straight ahead, in the order of the vehicle's
  double reach_m = 0;  // of any part, however steered, from the vehicle's origin, on the level
  double top_m = 0;    // of the highest part

  Shapes(const TerrainMap& map_, const Vehicle& vehicle_, double clearance)
      : map(map_), vehicle(vehicle_), body(body_of(vehicle_, clearance)) {
    const auto consider = [&](const Part& p) {
      const double from_centre = std::hypot(p.box->side.x(), p.box->side.y()) / 2;
      reach_m = std::max(reach_m, std::hypot(p.centre.x(), p.centre.y()) + from_centre);
      top_m = std::max(top_m, p.centre.z() + p.box->side.z() / 2);
    };
    consider(body);
    for (const WheelMount& mount : vehicle.wheels) {
      wheels.push_back(wheel_of(vehicle, mount, clearance));
      consider(wheels.back());
    }
  }

  template <class Geometry>
  static bool touch(const Part& part, const Transform& at, const Geometry& other,
                    const Transform& place) {
    fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(part.box.get(), at, &other, place, request, result) > 0;
  }

  /// Where a part is whose own axes are those of the vehicle.
  static Transform place_of(const Part& part, const Transform& stand) {
    Transform at = stand;
    at.translation() = stand * part.centre;
    return at;
  }

  static Transform place_of(const Part& wheel, const Transform& stand,
                            const SteeredWheel& steering) {
    Transform at = place_of(wheel, stand);
    const Eigen::Vector3d forward = stand.linear().col(0), left = stand.linear().col(1);
    at.linear().col(0) = steering.cos_steer * forward + steering.sin_steer * left;
    at.linear().col(1) = steering.cos_steer * left - steering.sin_steer * forward;
    return at;
  }

  /// Ground that is unknown is where the plane of the contacts runs, so that what is known about it
  /// is met all the same.
  static double ground_m(double known_m, double x_m, double y_m, const Transform& stand) {
    if (!std::isnan(known_m)) return known_m;
    const Eigen::Vector3d up = stand.linear().col(2), origin = stand.translation();
    return origin.z() - (up.x() * (x_m - origin.x()) + up.y() * (y_m - origin.y())) / up.z();
  }

  /// A rock in the world. It stands in the ground as deep as it rises, so that no slope shows a gap
  /// beneath it.
  struct Standing {
    double x_m, y_m, ground_m, radius_m, height_m;

    fcl::Cylinderd cylinder() const { return {radius_m, 2 * height_m}; }
    Transform place() const {
      Transform at = Transform::Identity();
      at.translation() = Eigen::Vector3d{x_m, y_m, ground_m};
      return at;
    }
    /// A bound that costs little: beside a part's reach, or nowhere above the plane of its
    /// underside.
    bool clear_of(const Part& part, const Transform& stand) const {
      const Eigen::Vector3d centre = stand * part.centre;
      const double dx = centre.x() - x_m, dy = centre.y() - y_m;
      const double reach = radius_m + part.reach_m;
      if (dx * dx + dy * dy > reach * reach) return true;
      const Eigen::Vector3d up = stand.linear().col(2);
      const double highest = up.dot(Eigen::Vector3d{x_m, y_m, ground_m + height_m}) +
                             radius_m * std::hypot(up.x(), up.y());
      return highest < up.dot(stand.translation()) + part.underside_m();
    }
  };

  bool hits_rock(const Transform& stand, const VehicleState& state) const {
    const Eigen::Vector3d up = stand.linear().col(2);
    const double reach = reach_m + top_m * std::hypot(up.x(), up.y());  // what is high leans out
    return map.any_rock(
        state.x_m - reach, state.x_m + reach, state.y_m - reach, state.y_m + reach,
        [&](const Rock& rock) {
          const double ground =
              ground_m(map.height_m(rock.x_m, rock.y_m), rock.x_m, rock.y_m, stand);
          const Standing standing{rock.x_m, rock.y_m, ground, rock.radius_m, rock.height_m};
          return body_touches(standing, stand) ||
                 (rock.height_m > vehicle.step_max_m && wheel_touches(standing, stand, state));
        });
  }

  bool body_touches(const Standing& rock, const Transform& stand) const {
    return !rock.clear_of(body, stand) &&
           touch(body, place_of(body, stand), rock.cylinder(), rock.place());
  }

  bool wheel_touches(const Standing& rock, const Transform& stand,
                     const VehicleState& state) const {
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      if (rock.clear_of(wheels[i], stand)) continue;
      const SteeredWheel steering = steering_of(vehicle, vehicle.wheels[i], state);
      if (touch(wheels[i], place_of(wheels[i], stand, steering), rock.cylinder(), rock.place())) {
        return true;
      }
    }
    return false;
  }

  bool hits_ground(const Transform& stand) const {
    // Corners of the body bound its footprint, which on a slope reaches farther at the top, and its
    // lowest point.
    const Eigen::Vector3d half = body.box->side / 2;
    Eigen::Vector3d low = Eigen::Vector3d::Constant(1e300), high = -low;
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        for (const double sz : {-1.0, 1.0}) {
          const Eigen::Vector3d corner =
              stand * (body.centre + half.cwiseProduct(Eigen::Vector3d{sx, sy, sz}));
          low = low.cwiseMin(corner);
          high = high.cwiseMax(corner);
        }
      }
    }
    if (map.max_height_m(low.x(), high.x(), low.y(), high.y()) < low.z()) return false;
    const CellRange cells = cells_below(low, high);
    return reaches_underside(stand, cells) &&
           touch(body, place_of(body, stand), mesh_over(cells, stand), Transform::Identity());
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
    const double underside = up.dot(stand.translation()) + body.underside_m();
    for (int row = cells.row_first; row <= cells.row_last; ++row) {
      for (int column = cells.column_first; column <= cells.column_last; ++column) {
        if (up.dot(vertex(row, column)) >= underside) return true;
      }
    }
    return false;
  }

  Mesh mesh_over(const CellRange& cells, const Transform& stand) const {
    const auto corner = [&](int row, int column) {
      Eigen::Vector3d at = vertex(row, column);
      at.z() = ground_m(at.z(), at.x(), at.y(), stand);
      return at;
    };
    Mesh mesh;
    mesh.beginModel();
    for (int r = cells.row_first; r < cells.row_last; ++r) {
      for (int c = cells.column_first; c < cells.column_last; ++c) {
        mesh.addTriangle(corner(r, c), corner(r + 1, c), corner(r, c + 1));
        mesh.addTriangle(corner(r, c + 1), corner(r + 1, c), corner(r + 1, c + 1));
      }
    }
    mesh.endModel();
    return mesh;
  }
};

Obstacles::Obstacles(const TerrainMap& map, const Vehicle& vehicle, double clearance_m)
    : shapes_(std::make_unique<Shapes>(map, vehicle, clearance_m)) {}

Obstacles::~Obstacles() = default;

bool Obstacles::hit(const VehicleState& state, const GroundPatch& patch) const {
  const Transform place = stand(state, patch);
  return shapes_->hits_rock(place, state) || shapes_->hits_ground(place);
}

bool in_the_way(const TerrainMap& map, const Vehicle& vehicle, const Rock& rock) {
  if (rock.height_m > vehicle.step_max_m) return true;
  const double x = rock.x_m, y = rock.y_m, span = longest_arm_m(vehicle);
  const double around = (map.height_m(x + span, y) + map.height_m(x - span, y) +
                         map.height_m(x, y + span) + map.height_m(x, y - span)) /
                        4;
  return map.height_m(x, y) + rock.height_m > around + vehicle.body.clearance_m;
}

}  // namespace regoplan
