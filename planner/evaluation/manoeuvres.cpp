#include "planner/evaluation/manoeuvres.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "planner/evaluation/course_bounds.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

constexpr double kPointsApart_m = 0.2;
constexpr double kStraight_m = 2;  // before what matters

void require_above_0(std::string_view field, double value) {
  if (!(value > 0) || !std::isfinite(value)) throw ValueError(std::string(field), value, "above 0");
}

void require_bounded_length(double length_m) {
  if (!(length_m <= kCourseLengthMax_m)) {
    throw InputError(fmt::format("its way of {:.4g} m is too long (allowed: at most {} m)",
                                 length_m, kCourseLengthMax_m));
  }
}

/// How far apart the points of an arc are: nearer on a tight one, as near as a curve takes them.
double apart_on_arc_m(double radius_m) {
  constexpr double kARadius = 20, kNearest_m = 1.1 * PathCurve::kSpacingMin_m;
  return std::clamp(radius_m / kARadius, kNearest_m, kPointsApart_m);
}

/// A curve from the origin along +x with the given curvature.
std::vector<PathPoint> points_with_curvature(double length_m, double apart_m,
                                             const std::function<double(double)>& curvature_1pm) {
  require_bounded_length(length_m);
  std::vector<PathPoint> points{{}};
  const int pieces = std::max(4, static_cast<int>(std::ceil(length_m / apart_m)));
  constexpr int kSteps = 20;
  const double h = length_m / (pieces * kSteps);
  double x = 0, y = 0, heading = 0;
  for (int i = 0; i < pieces; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      const double curvature = curvature_1pm((i * kSteps + k + 0.5) * h);
      const double middle = heading + curvature * h / 2;
      x += h * std::cos(middle);
      y += h * std::sin(middle);
      heading += curvature * h;
    }
    points.push_back({x, y});
  }
  return points;
}

/// The curve through points of an arc is sharper than the arc, by a hundredth or two where the
/// curvature ceases to change and where it ends. Where that alone is beyond the vehicle's tightest
/// turn, the points are moved apart by as much.
std::vector<PathPoint> not_beyond_the_tightest(std::vector<PathPoint> points, const Manoeuvre& m) {
  constexpr double kSharperMost = 1.05;  // beyond, the points are too few to make the arc
  const double tightest_1pm = m.vehicle.curvature_max_1pm;
  constexpr double kRounding = 1e-9;
  if (m.radius_m * tightest_1pm < 1 - kRounding) return points;
  const PathCurve curve(points);
  const double sharpest_m = curve.sharpest_m(0, curve.length_m());
  const double sharper = std::abs(curve.at(sharpest_m).curvature_1pm) / tightest_1pm;
  if (!(sharper > 1 && sharper < kSharperMost)) return points;
  for (PathPoint& point : points) point = {point.x_m * sharper, point.y_m * sharper};
  return points;
}

/// A straight, a steady change of curvature as fast as the vehicle steers at its speed, an arc.
std::vector<PathPoint> turn_points(const Manoeuvre& m, double arc_m) {
  const double curvature = (m.to_the_right ? -1 : 1) / m.radius_m;
  const double entry_m =
      std::max(1.0, 2 * m.speed_mps / (m.radius_m * m.vehicle.curvature_rate_max_1pms));
  std::vector<PathPoint> points = points_with_curvature(
      kStraight_m + entry_m + arc_m, apart_on_arc_m(m.radius_m),
      [&](double s) { return curvature * std::clamp((s - kStraight_m) / entry_m, 0.0, 1.0); });
  return not_beyond_the_tightest(std::move(points), m);
}

/// y over x, from the origin along +x.
std::vector<PathPoint> points_over_x(double length_m, const std::function<double(double)>& y_m) {
  require_bounded_length(length_m);
  std::vector<PathPoint> points;
  const int pieces = std::max(4, static_cast<int>(std::ceil(length_m / kPointsApart_m)));
  for (int i = 0; i <= pieces; ++i) points.push_back({length_m * i / pieces, 0});
  for (PathPoint& point : points) point.y_m = y_m(point.x_m);
  return points;
}

/// 0 to 1 with two derivatives that vanish at both ends.
double smooth_step(double t) {
  const double u = std::clamp(t, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

/// A place of a curve y(x).
struct Bow {
  double y_m = 0;
  double slope = 0;     ///< dy/dx
  double bend_1pm = 0;  ///< its derivative
};

/// The quintic that begins straight along y = 0 and ends as a bow does. \param t from 0 to 1
double swung_in_m(double t, double length_m, const Bow& end) {
  return t * t * t *
         (end.y_m * (10 + t * (6 * t - 15)) + end.slope * length_m * (-4 + t * (7 - 3 * t)) +
          end.bend_1pm * length_m * length_m * (1 - t) * (1 - t) / 2);
}

/// Waves from the top of a bow on, and a wavelength each to swing in and out: so long, these are
/// nowhere sharper than the bows, in whichever phase the waves end.
std::vector<PathPoint> slalom_points(const Manoeuvre& m) {
  const double swing_m = m.wavelength_m, end_m = swing_m + m.waves * m.wavelength_m;
  const double per_m = 2 * std::numbers::pi / m.wavelength_m;
  const double amplitude_m = m.to_the_right ? -m.amplitude_m : m.amplitude_m;
  const auto wave = [&](double x_m) {
    const double c = std::cos(per_m * (x_m - swing_m)), s = std::sin(per_m * (x_m - swing_m));
    return Bow{.y_m = amplitude_m * c,
               .slope = -amplitude_m * per_m * s,
               .bend_1pm = -amplitude_m * per_m * per_m * c};
  };
  const Bow last = wave(end_m);
  return points_over_x(end_m + swing_m, [&](double x_m) {
    if (x_m < swing_m) return swung_in_m(x_m / swing_m, swing_m, wave(swing_m));
    if (x_m <= end_m) return wave(x_m).y_m;
    // Seen from the end of the path the way runs backwards.
    return swung_in_m((end_m + swing_m - x_m) / swing_m, swing_m,
                      {.y_m = last.y_m, .slope = -last.slope, .bend_1pm = last.bend_1pm});
  });
}

std::vector<PathPoint> points_of(const Manoeuvre& m) {
  const double side = m.to_the_right ? -1 : 1;
  switch (m.kind) {
    case ManoeuvreKind::kSteadyTurn:
      require_above_0("radius_m", m.radius_m);
      require_above_0("angle_deg", m.angle_rad);
      return turn_points(m, m.radius_m * m.angle_rad);
    case ManoeuvreKind::kBrakingInATurn:
      require_above_0("radius_m", m.radius_m);
      require_above_0("angle_deg", m.angle_rad);
      require_above_0("braking_mps2", m.braking_mps2);
      return turn_points(
          m, m.radius_m * m.angle_rad + m.speed_mps * m.speed_mps / (2 * m.braking_mps2));
    case ManoeuvreKind::kLaneChange:
      require_above_0("offset_m", m.offset_m);
      require_above_0("length_m", m.length_m);
      return points_over_x(m.length_m + 2 * kStraight_m, [&](double x) {
        return side * m.offset_m * smooth_step((x - kStraight_m) / m.length_m);
      });
    case ManoeuvreKind::kSlalom:
      require_above_0("amplitude_m", m.amplitude_m);
      require_above_0("wavelength_m", m.wavelength_m);
      require_above_0("waves", m.waves);
      return slalom_points(m);
    case ManoeuvreKind::kSlopeTraverse:
      require_above_0("length_m", m.length_m);
      return {{0, 0}, {m.length_m / 2, 0}, {m.length_m, 0}};
    case ManoeuvreKind::kPointTurn:
      return {{0, 0}};
  }
  return {};
}

SpeedProfile speed_of(const Manoeuvre& m, const PathCurve& curve) {
  const double length = curve.length_m();
  if (m.kind != ManoeuvreKind::kBrakingInATurn) {
    return SpeedProfile({{0, m.speed_mps}, {length, m.speed_mps}});
  }
  const double braking_m = m.speed_mps * m.speed_mps / (2 * m.braking_mps2);
  // Through points on much tighter a circle the curve cuts short.
  if (!(braking_m < length)) {
    throw InputError(
        fmt::format("radius_m: {} is too tight for {:.4g} m of braking: points {:.2g} m apart make "
                    "only {:.4g} m of it (a larger radius_m or braking_mps2)",
                    m.radius_m, braking_m, apart_on_arc_m(m.radius_m), length));
  }
  constexpr double kResolved = 1e-15;  // nearer to the end there is no place before it
  if (!(braking_m > kResolved * length)) {
    throw ValueError(
        "braking_mps2", m.braking_mps2,
        fmt::format("below {:.3g} at {} m/s, a stop within nothing",
                    m.speed_mps * m.speed_mps / (2 * kResolved * length), m.speed_mps));
  }
  return SpeedProfile({{0, m.speed_mps}, {length - braking_m, m.speed_mps}, {length, 0}});
}

/// \throws InputError saying what keeps the vehicle from it
void require_turn_on_the_spot(const Manoeuvre& m) {
  require_above_0("angle_deg", m.angle_rad);
  require_above_0("turn_rate_deg_s", m.turn_rate_rad_s);
  if (!can_turn_on_the_spot(m.vehicle)) {
    throw InputError(fmt::format(
        "point_turn: {} cannot turn on the spot: it takes drive_law kinematic, and every wheel "
        "that "
        "does not reach the angle for it, or does not steer, abreast of the turn centre (steering: "
        "skid drags them)",
        m.vehicle.name));
  }
  const double rate_max = m.vehicle.speed_max_mps / longest_arm_m(m.vehicle);
  if (m.turn_rate_rad_s > rate_max) {
    throw ValueError("turn_rate_deg_s", m.turn_rate_rad_s / kDegree,
                     fmt::format("above 0 to {:.4g}, where the outermost wheel of {} goes {} m/s",
                                 rate_max / kDegree, m.vehicle.name, m.vehicle.speed_max_mps));
  }
}

std::variant<ReferencePath, SpotTurn> course_of(const Manoeuvre& m,
                                                const std::vector<PathPoint>& points) {
  if (m.kind == ManoeuvreKind::kPointTurn) {
    return SpotTurn{.name = m.name,
                    .centre_x_m = m.vehicle.turn_centre_x_m,
                    .angle_rad = m.to_the_right ? -m.angle_rad : m.angle_rad,
                    .rate_rad_s = m.turn_rate_rad_s};
  }
  PathCurve curve(points);
  SpeedProfile speed = speed_of(m, curve);
  return ReferencePath{
      .name = m.name, .legs = {{std::move(curve), std::move(speed)}}, .goes_on = true};
}

/// Offsets and amplitudes count as well.
void require_bounded_way(const std::vector<PathPoint>& points) {
  double length_m = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    length_m += std::hypot(points[i].x_m - points[i - 1].x_m, points[i].y_m - points[i - 1].y_m);
  }
  require_bounded_length(length_m);
}

/// \throws ValueError where driving it would take more steps than an evaluation takes on
void require_bounded_drive(const Manoeuvre& m,
                           const std::variant<ReferencePath, SpotTurn>& course) {
  const bool turns = m.kind == ManoeuvreKind::kPointTurn;
  const double steps = turns ? drive_steps(std::get<SpotTurn>(course), m.vehicle)
                             : drive_steps(std::get<ReferencePath>(course));
  if (steps <= kDriveStepsMax) return;
  const double given = turns ? m.turn_rate_rad_s / kDegree : m.speed_mps;
  // So slow, all steps are equally long.
  throw ValueError(turns ? "turn_rate_deg_s" : "speed_mps", given,
                   fmt::format("at least {:.3g}, so that driving it takes at most {} steps",
                               given * steps / kDriveStepsMax, kDriveStepsMax));
}

/// The plane, wide enough for the vehicle around all of the path.
TerrainMap plane_under(const Manoeuvre& m, const std::vector<PathPoint>& points) {
  const BodyBox& body = m.vehicle.body;
  const double around_m = 3 + 2 * std::abs(m.vehicle.turn_centre_x_m) +
                          2 * std::max({body.x_max_m, -body.x_min_m, body.y_max_m, -body.y_min_m});
  const auto [west, east] =
      std::minmax_element(points.begin(), points.end(),
                          [](const PathPoint& a, const PathPoint& b) { return a.x_m < b.x_m; });
  const auto [south, north] =
      std::minmax_element(points.begin(), points.end(),
                          [](const PathPoint& a, const PathPoint& b) { return a.y_m < b.y_m; });
  // Few cells: heights are bilinear between their centres, hence exact on a plane.
  constexpr double kCellMin_m = 2, kCellsAcross = 2000;
  const double cell_m =
      std::max(kCellMin_m, std::max(east->x_m - west->x_m, north->y_m - south->y_m) / kCellsAcross);
  const auto cells = [&](double extent_m) {
    return static_cast<int>(std::ceil((extent_m + 2 * around_m) / cell_m)) + 2;
  };
  const GridFrame frame{.columns = cells(east->x_m - west->x_m),
                        .rows = cells(north->y_m - south->y_m),
                        .west_m = west->x_m - around_m - cell_m,
                        .north_m = north->y_m + around_m + cell_m,
                        .cell_width_m = cell_m,
                        .cell_height_m = cell_m,
                        .crs_wkt = {}};
  ElevationRaster elevation{.frame = frame, .height_m = {}};
  const double steep = std::tan(m.slope_rad);
  const double c = std::cos(m.slope_heading_rad), s = std::sin(m.slope_heading_rad);
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const double x = frame.west_m + (column + 0.5) * cell_m;
      const double y = frame.north_m - (row + 0.5) * cell_m;
      elevation.height_m.push_back(static_cast<float>(steep * (c * x + s * y)));
    }
  }
  return {
      std::move(elevation), std::nullopt, {.soils = {m.soil}, .classes = {}, .unmapped = 0}, {}};
}

}  // namespace

std::string_view name(ManoeuvreKind kind) {
  switch (kind) {
    case ManoeuvreKind::kSteadyTurn:
      return "steady_turn";
    case ManoeuvreKind::kLaneChange:
      return "lane_change";
    case ManoeuvreKind::kSlalom:
      return "slalom";
    case ManoeuvreKind::kSlopeTraverse:
      return "slope_traverse";
    case ManoeuvreKind::kBrakingInATurn:
      return "braking_in_a_turn";
    case ManoeuvreKind::kPointTurn:
      return "point_turn";
  }
  return "";
}

PreparedManoeuvre prepare(const Manoeuvre& manoeuvre, const Limits& limits,
                          const PlanningProblem& base) {
  const Vehicle& vehicle = manoeuvre.vehicle;
  const bool turns = manoeuvre.kind == ManoeuvreKind::kPointTurn;
  if (turns) {
    require_turn_on_the_spot(manoeuvre);
  } else if (!(manoeuvre.speed_mps > 0 && manoeuvre.speed_mps <= vehicle.speed_max_mps)) {
    throw ValueError(
        "speed_mps", manoeuvre.speed_mps,
        fmt::format("above 0 to {}, the largest of {}", vehicle.speed_max_mps, vehicle.name));
  }
  const double speed_mps =
      turns ? manoeuvre.turn_rate_rad_s * longest_arm_m(vehicle) : manoeuvre.speed_mps;
  const std::vector<PathPoint> points = points_of(manoeuvre);
  require_bounded_way(points);
  std::variant<ReferencePath, SpotTurn> course = course_of(manoeuvre, points);
  require_bounded_drive(manoeuvre, course);
  return {.problem = {.map = plane_under(manoeuvre, points),
                      .vehicle = vehicle,
                      .wheel_variant = base.wheel_variant,
                      .mechanisms = base.mechanisms,
                      .generic = base.generic,
                      .gravity_mps2 = base.gravity_mps2,
                      .start = {.speed_mps = turns ? 0 : speed_mps},
                      .goal = {.x_m = points.back().x_m,
                               .y_m = points.back().y_m,
                               .radius_m = 1,
                               .heading_rad = {}},
                      .speed_max_mps = speed_mps * kSpeedTolerance,
                      .limits = limits,
                      .search = base.search},
          .course = std::move(course)};
}

}  // namespace regoplan
