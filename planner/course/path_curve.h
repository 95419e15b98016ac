#pragma once

#include <vector>

namespace regoplan {

struct PathPoint {
  double x_m = 0;
  double y_m = 0;
};

/// A place on a curve.
struct CurvePlace {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;    ///< of the curve, from +x toward +y
  double curvature_1pm = 0;  ///< left positive
};

/// A twice continuously differentiable plane curve through points, by arc length: the cubic spline
/// over the chord length whose third derivative does not jump at the second and the last but one
/// point (not-a-knot), so that a circle keeps its curvature to its ends.
class PathCurve {
 public:
  /// Points nearer than this to the one before are left out, the last point excepted, which then
  /// takes the place of its neighbour.
  static constexpr double kSpacingMin_m = 0.1;

  /// \throws InputError for fewer than two points, a point that is not finite, or points that all
  /// lie within `kSpacingMin_m`
  explicit PathCurve(const std::vector<PathPoint>& points);

  double length_m() const { return arc_m_.back(); }

  /// \param s_m arc length from the start; before the start and beyond the end the place there
  /// The curvature is infinite where the curve turns back on itself.
  CurvePlace at(double s_m) const;

  /// Arc length of the place within a stretch where the curve bends most, to either side. Exact:
  /// the places where the curvature is stationary are roots of a polynomial on each piece of the
  /// spline. \pre 0 <= from_m <= to_m <= length_m()
  double sharpest_m(double from_m, double to_m) const;

  /// Arc length of each point that the curve was made of; of one left out, its neighbour's.
  const std::vector<double>& point_arc_m() const { return point_arc_m_; }
  /// How many points were left out.
  int thinned() const { return thinned_; }

 private:
  struct Knot {
    double chord_m = 0;
    double x_m = 0, y_m = 0;
    double x_second = 0, y_second = 0;  ///< second derivatives by the chord length
  };
  struct Derivatives {
    double x, y, dx, dy, ddx, ddy;
  };
  Derivatives derivatives(std::size_t interval, double chord_m) const;
  /// Where within an interval of the knots the curvature is stationary or the curve turns back.
  std::vector<double> stationary_m(std::size_t interval) const;
  double speed(std::size_t interval, double chord_m) const;
  double arc_within(std::size_t interval, double from_m, double to_m) const;

  std::vector<Knot> knots_;
  std::vector<double> arc_m_;  ///< at each knot
  std::vector<double> point_arc_m_;
  int thinned_ = 0;
};

}  // namespace regoplan
