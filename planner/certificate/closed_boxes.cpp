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

struct HeightRange {
  double low = INFINITY, high = -INFINITY;
};

/// Of every raster cell that a height in the square can come from; nothing where one that lies on
/// the map is unknown.
std::optional<HeightRange> heights_around(const TerrainMap& map, double x_m, double y_m,
                                          double half_m) {
  const ElevationRaster& raster = map.elevation();
  const GridFrame& frame = raster.frame;
  const auto column_of = [&](double x) {
    return std::clamp(static_cast<int>(std::floor((x - frame.west_m) / frame.cell_width_m - 0.5)),
                      0, frame.columns - 1);
  };
  const auto row_of = [&](double y) {
    return std::clamp(static_cast<int>(std::floor((frame.north_m - y) / frame.cell_height_m - 0.5)),
                      0, frame.rows - 1);
  };
  const int last_column = std::min(column_of(x_m + half_m) + 1, frame.columns - 1);
  const int last_row = std::min(row_of(y_m - half_m) + 1, frame.rows - 1);
  HeightRange range;
  for (int row = row_of(y_m + half_m); row <= last_row; ++row) {
    for (int column = column_of(x_m - half_m); column <= last_column; ++column) {
      const double height =
          raster.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                          static_cast<std::size_t>(column)];
      if (std::isnan(height)) return std::nullopt;
      range.low = std::min(range.low, height);
      range.high = std::max(range.high, height);
    }
  }
  return range;
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
  // coefficients that sum to zero: heights within +-d turn it by d times their absolute sum at
  // most.
  const Eigen::Matrix3d gram = place.transpose() * place;
  const Eigen::Matrix<double, 3, Eigen::Dynamic> fit = gram.inverse() * place.transpose();
  slope_per_deviation_1pm_ = std::hypot(fit.row(1).cwiseAbs().sum(), fit.row(2).cwiseAbs().sum());
  const BodyBox& body = vehicle.body;
  for (const double x : {body.x_min_m, body.x_max_m}) {
    for (const double y : {body.y_min_m, body.y_max_m}) {
      body_reach_m_ = std::max(body_reach_m_, std::hypot(x, y));
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
  const ElevationRaster& raster = problem_.map.elevation();
  const GridFrame& frame = raster.frame;
  // Every raster cell that the height under a contact can come from.
  const double reach_m = wheel_reach_m_ + std::numbers::sqrt2 * box.half_m;
  const auto first_column =
      static_cast<int>(std::floor((box.x_m - reach_m - frame.west_m) / frame.cell_width_m - 0.5));
  const auto last_column =
      static_cast<int>(std::ceil((box.x_m + reach_m - frame.west_m) / frame.cell_width_m - 0.5));
  const auto first_row =
      static_cast<int>(std::floor((frame.north_m - box.y_m - reach_m) / frame.cell_height_m - 0.5));
  const auto last_row =
      static_cast<int>(std::ceil((frame.north_m - box.y_m + reach_m) / frame.cell_height_m - 0.5));
  // At the edge heights are held, not sloped: let it be open.
  if (first_column < 0 || first_row < 0 || last_column >= frame.columns || last_row >= frame.rows) {
    return false;
  }
  const auto height = [&](int column, int row) {
    return static_cast<double>(
        raster.height_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
                        static_cast<std::size_t>(column)]);
  };
  const double width = (last_column - first_column) * frame.cell_width_m;
  const double depth = (last_row - first_row) * frame.cell_height_m;
  const double nw = height(first_column, first_row), ne = height(last_column, first_row);
  const double sw = height(first_column, last_row), se = height(last_column, last_row);
  // Any plane is sound; this one follows the corners. Bilinear heights keep planes as they are.
  const double east = (ne + se - nw - sw) / (2 * width);
  const double north = (nw + ne - sw - se) / (2 * depth);
  HeightRange deviation;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const double above = height(column, row) -
                           east * (column - first_column) * frame.cell_width_m +
                           north * (row - first_row) * frame.cell_height_m;
      if (!std::isfinite(above)) return false;
      deviation.low = std::min(deviation.low, above);
      deviation.high = std::max(deviation.high, above);
    }
  }
  const double turned = slope_per_deviation_1pm_ * (deviation.high - deviation.low) / 2;
  return std::hypot(east, north) - turned > std::tan(steepest_held_rad(problem_.limits));
}

const ClosedBoxes::RockBound& ClosedBoxes::bound(const Rock& rock) const {
  RockBound& known = bounds_[static_cast<std::size_t>(&rock - problem_.map.rocks().data())];
  if (!known.asked) known = looked_at(rock);
  return known;
}

ClosedBoxes::RockBound ClosedBoxes::looked_at(const Rock& rock) const {
  const double reach_m = rock.radius_m + body_reach_m_ + wheel_reach_m_;
  const auto ground = heights_around(problem_.map, rock.x_m, rock.y_m, reach_m);
  const double base = problem_.map.height_m(rock.x_m, rock.y_m);
  if (!ground || std::isnan(base)) return {.asked = true};
  // The body stands on the plane through its contacts, which lies nowhere below the body higher
  // than the highest ground around by more than that ground's relief.
  const BodyBox& body = problem_.vehicle.body;
  const double relief = ground->high - ground->low;
  const double underside = ground->high + 2 * relief + body.clearance_m;
  const double top = ground->low - 2 * relief + body.clearance_m + body.height_m;
  // Steeper poses than the limit are forbidden whatever they cover.
  return {.asked = true,
          .too_high = base + rock.height_m >= underside && base - rock.height_m <= top,
          .tilt_rad = std::min(steepest_held_rad(problem_.limits),
                               std::atan(slope_per_deviation_1pm_ * relief / 2))};
}

bool ClosedBoxes::covers_rock(const PoseBox& box) const {
  const BodyBox& body = problem_.vehicle.body;
  const double moved_m = std::numbers::sqrt2 * box.half_m + body_reach_m_ * box.half_rad;
  const double c = std::cos(box.heading_rad), s = std::sin(box.heading_rad);
  return problem_.map.any_rock(
      box.x_m - body_reach_m_, box.x_m + body_reach_m_, box.y_m - body_reach_m_,
      box.y_m + body_reach_m_, [&](const Rock& rock) {
        const RockBound& known = bound(rock);
        if (!known.too_high) return false;
        // What of the underside's outline every pose of the box covers, seen from the middle pose.
        // An underside that leans is seen shorter, and aside by what it stands above the contacts.
        const double lean = std::cos(known.tilt_rad);
        const double shrink_m = moved_m + body.clearance_m * std::sin(known.tilt_rad);
        const double x_min = body.x_min_m * lean + shrink_m, x_max = body.x_max_m * lean - shrink_m;
        const double y_min = body.y_min_m * lean + shrink_m, y_max = body.y_max_m * lean - shrink_m;
        if (x_min > x_max || y_min > y_max) return false;
        const double dx = rock.x_m - box.x_m, dy = rock.y_m - box.y_m;
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
