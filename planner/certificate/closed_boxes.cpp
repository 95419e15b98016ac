#include "planner/certificate/closed_boxes.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace regoplan {
namespace {

/// Values from low to high no farther apart than `spacing`, both ends among them.
template <class Visit>
bool all_between(double low, double high, double spacing, Visit visit) {
  const int parts = std::max(1, static_cast<int>(std::ceil((high - low) / spacing)));
  for (int i = 0; i <= parts; ++i) {
    if (!visit(low + (high - low) * i / parts)) return false;
  }
  return true;
}

/// Heights as a plane and what they stray from it.
struct SlopingGround {
  double east = 0, north = 0;                   ///< the plane's slopes
  double low_m = INFINITY, high_m = -INFINITY;  ///< heights less the plane, which is 0 at the place

  double steepness() const { return std::hypot(east, north); }
  double middle_m() const { return (low_m + high_m) / 2; }
  double stray_m() const { return (high_m - low_m) / 2; }
};

/// Raster cells that a height in a square can come from.
struct Window {
  int first_column = 0, last_column = 0, first_row = 0, last_row = 0;
  bool at_edge = false;  ///< the square reaches past the outermost centres of cells
};

Window window_around(const GridFrame& frame, double x_m, double y_m, double half_m) {
  const auto cell_before = [](double away_m, double cell_m) {
    return static_cast<int>(std::floor(away_m / cell_m - 0.5));
  };
  const int west = cell_before(x_m - half_m - frame.west_m, frame.cell_width_m);
  const int east = cell_before(x_m + half_m - frame.west_m, frame.cell_width_m) + 1;
  const int north = cell_before(frame.north_m - y_m - half_m, frame.cell_height_m);
  const int south = cell_before(frame.north_m - y_m + half_m, frame.cell_height_m) + 1;
  const int last_column = frame.columns - 1, last_row = frame.rows - 1;
  return {.first_column = std::clamp(west, 0, last_column),
          .last_column = std::clamp(east, 0, last_column),
          .first_row = std::clamp(north, 0, last_row),
          .last_row = std::clamp(south, 0, last_row),
          .at_edge = west < 0 || north < 0 || east > last_column || south > last_row};
}

/// Of every raster cell that a height in the square around a place can come from; nothing where one
/// that lies on the map is unknown. Any plane is sound; this one follows the square's corners.
/// Bilinear heights keep planes as they are; within half a cell of the map's edge they are held.
std::optional<SlopingGround> ground_around(const TerrainMap& map, double x_m, double y_m,
                                           double half_m) {
  const ElevationRaster& raster = map.elevation();
  const GridFrame& frame = raster.frame;
  const Window cells = window_around(frame, x_m, y_m, half_m);
  const auto height = [&](int column, int row) {
    return static_cast<double>(
        raster.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                        static_cast<std::size_t>(column)]);
  };
  SlopingGround ground;
  const int columns = cells.last_column - cells.first_column;
  const int rows = cells.last_row - cells.first_row;
  const double nw = height(cells.first_column, cells.first_row);
  const double ne = height(cells.last_column, cells.first_row);
  const double sw = height(cells.first_column, cells.last_row);
  const double se = height(cells.last_column, cells.last_row);
  if (columns > 0) ground.east = (ne + se - nw - sw) / (2 * columns * frame.cell_width_m);
  if (rows > 0) ground.north = (nw + ne - sw - se) / (2 * rows * frame.cell_height_m);
  for (int row = cells.first_row; row <= cells.last_row; ++row) {
    for (int column = cells.first_column; column <= cells.last_column; ++column) {
      const double east_m = frame.west_m + (column + 0.5) * frame.cell_width_m - x_m;
      const double north_m = frame.north_m - (row + 0.5) * frame.cell_height_m - y_m;
      const double above = height(column, row) - ground.east * east_m - ground.north * north_m;
      if (!std::isfinite(above)) return std::nullopt;
      ground.low_m = std::min(ground.low_m, above);
      ground.high_m = std::max(ground.high_m, above);
    }
  }
  if (cells.at_edge) {
    const double held_m = (std::abs(ground.east) * frame.cell_width_m +
                           std::abs(ground.north) * frame.cell_height_m) /
                          2;
    ground.low_m -= held_m;
    ground.high_m += held_m;
  }
  return ground;
}

}  // namespace

ClosedBoxes::ClosedBoxes(const PlanningProblem& problem)
    : problem_(problem), bounds_(problem.map.rocks().size()) {
  const Vehicle& vehicle = problem.vehicle;
  const auto count = static_cast<Eigen::Index>(vehicle.wheels.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> place(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const WheelMount& wheel = vehicle.wheels[static_cast<std::size_t>(i)];
    place.row(i) << 1, wheel.x_m, wheel.y_m;
    wheel_reach_m_ = std::max(wheel_reach_m_, std::hypot(wheel.x_m, wheel.y_m));
  }
  // The plane is the least-squares fit to the contacts. Each slope is a sum of heights with
  // coefficients that sum to zero: heights that stray by +-d turn it by d times their absolute sum
  // at most. Its height at a place of the body is such a sum too.
  const Eigen::Matrix3d gram = place.transpose() * place;
  const Eigen::Matrix<double, 3, Eigen::Dynamic> fit = gram.inverse() * place.transpose();
  slope_per_stray_1pm_ = std::hypot(fit.row(1).cwiseAbs().sum(), fit.row(2).cwiseAbs().sum());
  const BodyBox& body = vehicle.body;
  for (const double x : {body.x_min_m, body.x_max_m}) {
    for (const double y : {body.y_min_m, body.y_max_m}) {
      body_reach_m_ = std::max(body_reach_m_, std::hypot(x, y));
    }
  }
  // An underside that leans reaches out of its outline by what it stands above the contacts.
  const double out_m = body.clearance_m;
  for (const double x : {body.x_min_m - out_m, body.x_max_m + out_m}) {
    for (const double y : {body.y_min_m - out_m, body.y_max_m + out_m}) {
      height_per_stray_ =
          std::max(height_per_stray_, (Eigen::RowVector3d{1, x, y} * fit).cwiseAbs().sum());
    }
  }
}

bool ClosedBoxes::wheel_off_ground(const PoseBox& box) const {
  const TerrainMap& map = problem_.map;
  const GridFrame& heights = map.elevation().frame;
  double spacing = std::min(heights.cell_width_m, heights.cell_height_m);
  if (map.classes()) {
    const GridFrame& classes = map.classes()->frame;
    spacing = std::min({spacing, classes.cell_width_m, classes.cell_height_m});
  }
  const double c = std::cos(box.heading_rad), s = std::sin(box.heading_rad);
  for (const WheelMount& wheel : problem_.vehicle.wheels) {
    const double x = box.x_m + c * wheel.x_m - s * wheel.y_m;
    const double y = box.y_m + s * wheel.x_m + c * wheel.y_m;
    const double around_m = box.half_m + std::hypot(wheel.x_m, wheel.y_m) * box.half_rad;
    // Some place in every raster cell that the contact can be in. Heights between cells need all
    // of them: where the cell itself is known, a place in it may be.
    const bool unknown_everywhere =
        all_between(y - around_m, y + around_m, spacing / 2, [&](double at_y) {
          return all_between(x - around_m, x + around_m, spacing / 2, [&](double at_x) {
            return !map.inside(at_x, at_y) || std::isnan(map.height_m(at_x, at_y)) ||
                   !map.soil_index(at_x, at_y);
          });
        });
    if (unknown_everywhere) return true;
  }
  return false;
}

bool ClosedBoxes::too_steep(const PoseBox& box) const {
  const auto ground = ground_around(problem_.map, box.x_m, box.y_m,
                                    wheel_reach_m_ + std::numbers::sqrt2 * box.half_m);
  return ground && ground->steepness() - slope_per_stray_1pm_ * ground->stray_m() >
                       std::tan(steepest_held_rad(problem_.limits));
}

const ClosedBoxes::RockBound& ClosedBoxes::bound(const Rock& rock) const {
  RockBound& known = bounds_[static_cast<std::size_t>(&rock - problem_.map.rocks().data())];
  if (!known.asked) known = looked_at(rock);
  return known;
}

ClosedBoxes::RockBound ClosedBoxes::looked_at(const Rock& rock) const {
  const auto ground = ground_around(problem_.map, rock.x_m, rock.y_m,
                                    rock.radius_m + body_reach_m_ + wheel_reach_m_);
  const double base = problem_.map.height_m(rock.x_m, rock.y_m);
  if (!ground || std::isnan(base)) return {.asked = true};
  const double steepness = ground->steepness();
  const double turned = slope_per_stray_1pm_ * ground->stray_m();
  // Steeper poses than the limit are forbidden whatever they cover.
  const double tilt_rad =
      std::min(steepest_held_rad(problem_.limits), std::atan(steepness + turned));
  // Where the underside of a body over some of the rock can be, in the rock's disk.
  const double clearance_m = problem_.vehicle.body.clearance_m;
  const double around_m = steepness * rock.radius_m + height_per_stray_ * ground->stray_m();
  const double highest = ground->middle_m() + around_m + clearance_m / std::cos(tilt_rad);
  const double lowest = ground->middle_m() - around_m + clearance_m;
  const double downhill_m = clearance_m / std::hypot(1, steepness);
  return {.asked = true,
          .too_high = base + rock.height_m >= highest && base - rock.height_m <= lowest,
          .tilt_rad = tilt_rad,
          .aside_x_m = -downhill_m * ground->east,
          .aside_y_m = -downhill_m * ground->north,
          .aside_within_m = clearance_m * std::min(turned, 2.0)};
}

bool ClosedBoxes::covers_rock(const PoseBox& box) const {
  const BodyBox& body = problem_.vehicle.body;
  const double moved_m = std::numbers::sqrt2 * box.half_m + body_reach_m_ * box.half_rad;
  const double widest_m = std::max(-body.y_min_m, body.y_max_m);
  const double c = std::cos(box.heading_rad), s = std::sin(box.heading_rad);
  return problem_.map.any_rock(
      box.x_m - body_reach_m_, box.x_m + body_reach_m_, box.y_m - body_reach_m_,
      box.y_m + body_reach_m_, [&](const Rock& rock) {
        const RockBound& known = bound(rock);
        if (!known.too_high) return false;
        // What of the underside's outline every pose of the box covers, seen from the middle pose.
        // An outline that leans is seen shorter, and its sides askew.
        const double lean = std::cos(known.tilt_rad);
        const double within_m = moved_m + known.aside_within_m;
        const double askew_m =
            within_m + widest_m * std::tan(known.tilt_rad) * std::sin(known.tilt_rad) / 2;
        const double x_min = std::max(body.x_min_m, body.x_min_m * lean) + askew_m;
        const double x_max = std::min(body.x_max_m, body.x_max_m * lean) - askew_m;
        const double y_min = std::max(body.y_min_m, body.y_min_m * lean) + within_m;
        const double y_max = std::min(body.y_max_m, body.y_max_m * lean) - within_m;
        if (x_min > x_max || y_min > y_max) return false;
        const double dx = rock.x_m - box.x_m - known.aside_x_m;
        const double dy = rock.y_m - box.y_m - known.aside_y_m;
        const double ahead = c * dx + s * dy, left = c * dy - s * dx;
        const double beyond_x = ahead - std::clamp(ahead, x_min, x_max);
        const double beyond_y = left - std::clamp(left, y_min, y_max);
        return std::hypot(beyond_x, beyond_y) < rock.radius_m;
      });
}

bool ClosedBoxes::on_rock(const PoseBox& box) const {
  // The middle pose belongs to parts of the box however it is divided: where it is free, they are.
  if (!covers_rock({box.x_m, box.y_m, box.heading_rad, 0, 0})) return false;
  constexpr int kHalvings = 2;
  return closed_by_rocks(box, kHalvings);
}

bool ClosedBoxes::closed_by_rocks(const PoseBox& box, int halvings) const {
  if (covers_rock(box)) return true;
  if (halvings == 0) return false;
  const double half_m = box.half_m / 2, half_rad = box.half_rad / 2;
  for (const double x : {-half_m, half_m}) {
    for (const double y : {-half_m, half_m}) {
      for (const double turn : {-half_rad, half_rad}) {
        const PoseBox part{box.x_m + x, box.y_m + y, box.heading_rad + turn, half_m, half_rad};
        if (!closed_by_rocks(part, halvings - 1)) return false;
      }
    }
  }
  return true;
}

bool ClosedBoxes::far_from_rocks(const PoseBox& box) const {
  return !problem_.map.any_rock(box.x_m - body_reach_m_, box.x_m + body_reach_m_,
                                box.y_m - body_reach_m_, box.y_m + body_reach_m_,
                                [](const Rock&) { return true; });
}

ClosedBoxes::Reason ClosedBoxes::reason(const PoseBox& box) const {
  if (wheel_off_ground(box)) return Reason::kUnknownGround;
  return on_rock(box) ? Reason::kRock : Reason::kOpen;
}

}  // namespace regoplan
