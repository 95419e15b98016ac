#include "planner/course/path_curve.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <boost/math/tools/polynomial.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

double apart_m(const PathPoint& a, const PathPoint& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

/// Second derivatives at the knots of the splines through both columns of `values`.
Eigen::MatrixX2d second_derivatives(const std::vector<double>& t, const Eigen::MatrixX2d& values) {
  const auto n = static_cast<Eigen::Index>(t.size());
  if (n == 2) return Eigen::MatrixX2d::Zero(2, 2);
  const auto h = [&](Eigen::Index i) {
    const auto k = static_cast<std::size_t>(i);
    return t[k + 1] - t[k];
  };
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    entries.emplace_back(i, i - 1, h(i - 1));
    entries.emplace_back(i, i, 2 * (h(i - 1) + h(i)));
    entries.emplace_back(i, i + 1, h(i));
    right.row(i) = 6 * ((values.row(i + 1) - values.row(i)) / h(i) -
                        (values.row(i) - values.row(i - 1)) / h(i - 1));
  }
  const auto end = [&](Eigen::Index row, Eigen::Index outer, Eigen::Index middle,
                       Eigen::Index inner, double near_m, double far_m) {
    if (n == 3) {  // a parabola
      entries.emplace_back(row, outer, 1);
      entries.emplace_back(row, middle, -1);
      return;
    }
    entries.emplace_back(row, outer, far_m);
    entries.emplace_back(row, middle, -(near_m + far_m));
    entries.emplace_back(row, inner, near_m);
  };
  end(0, 0, 1, 2, h(0), h(1));
  end(n - 1, n - 1, n - 2, n - 3, h(n - 2), h(n - 3));
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  return solver.solve(right);
}

using Polynomial = boost::math::tools::polynomial<double>;

/// Where a polynomial changes its sign between 0 and 1, in ascending order: at most once between
/// neighbouring places where its derivative does.
std::vector<double> sign_changes(const Polynomial& p) {
  std::vector<double> changes;
  if (p.size() < 2) return changes;
  std::vector<double> ends = sign_changes(p.prime());
  ends.insert(ends.begin(), 0);
  ends.push_back(1);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double low = p(ends[i - 1]), high = p(ends[i]);
    if (low == 0) changes.push_back(ends[i - 1]);
    if (low == 0 || high == 0 || (low < 0) == (high < 0)) continue;
    constexpr int kBits = 52;
    const auto [from, to] = boost::math::tools::bisect(
        p, ends[i - 1], ends[i], boost::math::tools::eps_tolerance<double>(kBits));
    changes.push_back((from + to) / 2);
  }
  return changes;
}

}  // namespace

PathCurve::PathCurve(const std::vector<PathPoint>& points) {
  if (points.size() < 2) throw InputError("a path needs at least two points");
  std::vector<PathPoint> kept;
  std::vector<std::size_t> knot_of;
  for (const PathPoint& point : points) {
    if (!std::isfinite(point.x_m) || !std::isfinite(point.y_m)) {
      throw InputError("a point of the path is not finite");
    }
    if (kept.empty() || apart_m(kept.back(), point) >= kSpacingMin_m) {
      kept.push_back(point);
    } else {
      ++thinned_;
    }
    knot_of.push_back(kept.size() - 1);
  }
  // The path ends at its last point; what was kept too near before it goes.
  if (kept.size() >= 2) {
    kept.back() = points.back();
    while (kept.size() >= 2 && apart_m(kept[kept.size() - 2], kept.back()) < kSpacingMin_m) {
      kept.erase(kept.end() - 2);
      ++thinned_;
    }
  }
  if (kept.size() < 2) {
    throw InputError("the path has no length: all its points lie within 0.1 m");
  }
  for (std::size_t& knot : knot_of) knot = std::min(knot, kept.size() - 1);

  std::vector<double> chord{0};
  for (std::size_t i = 1; i < kept.size(); ++i) {
    chord.push_back(chord.back() + apart_m(kept[i - 1], kept[i]));
  }
  Eigen::MatrixX2d values(static_cast<Eigen::Index>(kept.size()), 2);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    values.row(static_cast<Eigen::Index>(i)) << kept[i].x_m, kept[i].y_m;
  }
  const Eigen::MatrixX2d second = second_derivatives(chord, values);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    knots_.push_back({.chord_m = chord[i],
                      .x_m = kept[i].x_m,
                      .y_m = kept[i].y_m,
                      .x_second = second(row, 0),
                      .y_second = second(row, 1)});
  }
  arc_m_.push_back(0);
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    arc_m_.push_back(arc_m_.back() + arc_within(i, chord[i], chord[i + 1]));
  }
  for (const std::size_t knot : knot_of) point_arc_m_.push_back(arc_m_[knot]);
}

PathCurve::Derivatives PathCurve::derivatives(std::size_t interval, double chord_m) const {
  const Knot &a = knots_[interval], &b = knots_[interval + 1];
  const double h = b.chord_m - a.chord_m;
  const double v = (chord_m - a.chord_m) / h, u = 1 - v;
  const double cu = (u * u * u - u) * h * h / 6, cv = (v * v * v - v) * h * h / 6;
  const double du = -(3 * u * u - 1) * h / 6, dv = (3 * v * v - 1) * h / 6;
  return {.x = u * a.x_m + v * b.x_m + cu * a.x_second + cv * b.x_second,
          .y = u * a.y_m + v * b.y_m + cu * a.y_second + cv * b.y_second,
          .dx = (b.x_m - a.x_m) / h + du * a.x_second + dv * b.x_second,
          .dy = (b.y_m - a.y_m) / h + du * a.y_second + dv * b.y_second,
          .ddx = u * a.x_second + v * b.x_second,
          .ddy = u * a.y_second + v * b.y_second};
}

double PathCurve::speed(std::size_t interval, double chord_m) const {
  const Derivatives d = derivatives(interval, chord_m);
  return std::hypot(d.dx, d.dy);
}

/// Gauss's rule with five points.
double PathCurve::arc_within(std::size_t interval, double from_m, double to_m) const {
  constexpr std::array<double, 5> kAt{0, -0.5384693101056831, 0.5384693101056831,
                                      -0.9061798459386640, 0.9061798459386640};
  constexpr std::array<double, 5> kWeight{0.5688888888888889, 0.4786286704993665,
                                          0.4786286704993665, 0.2369268850561891,
                                          0.2369268850561891};
  // Few points far apart make a curve that is far from its chord: in pieces.
  constexpr int kPieces = 4;
  const double half = (to_m - from_m) / (2 * kPieces);
  double sum = 0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double middle = from_m + (2 * piece + 1) * half;
    for (std::size_t i = 0; i < kAt.size(); ++i) {
      sum += kWeight.at(i) * speed(interval, middle + half * kAt.at(i));
    }
  }
  return half * sum;
}

std::vector<double> PathCurve::stationary_m(std::size_t interval) const {
  const Knot &a = knots_[interval], &b = knots_[interval + 1];
  const double h = b.chord_m - a.chord_m;
  // First derivatives by the chord length, as polynomials of the share v of the interval.
  const auto first = [h](double from, double to, double second_from, double second_to) {
    return Polynomial{(to - from) / h - h * (2 * second_from + second_to) / 6, h * second_from,
                      h * (second_to - second_from) / 2};
  };
  const Polynomial dx = first(a.x_m, b.x_m, a.x_second, b.x_second);
  const Polynomial dy = first(a.y_m, b.y_m, a.y_second, b.y_second);
  // With the curvature n / d^(3/2) / h, it is stationary where 2 n' d = 3 n d'.
  const Polynomial n = dx * dy.prime() - dy * dx.prime();
  const Polynomial d = dx * dx + dy * dy;
  std::vector<double> places = sign_changes(2.0 * n.prime() * d - 3.0 * n * d.prime());
  // Where a curve turns back along its own line, n vanishes everywhere; the slowest place tells.
  const std::vector<double> slowest = sign_changes(d.prime());
  places.insert(places.end(), slowest.begin(), slowest.end());
  for (double& place : places)
    place = arc_m_[interval] + arc_within(interval, a.chord_m, a.chord_m + place * h);
  return places;
}

double PathCurve::sharpest_m(double from_m, double to_m) const {
  double sharpest_m = from_m, largest_1pm = std::abs(at(from_m).curvature_1pm);
  const auto look_at = [&](double s_m) {
    if (s_m < from_m || s_m > to_m) return;
    const double curvature_1pm = std::abs(at(s_m).curvature_1pm);
    if (!(curvature_1pm > largest_1pm)) return;
    sharpest_m = s_m;
    largest_1pm = curvature_1pm;
  };
  look_at(to_m);
  const auto above = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, from_m);
  auto interval = static_cast<std::size_t>(above - arc_m_.begin()) - 1;
  for (; interval + 1 < arc_m_.size() && arc_m_[interval] <= to_m; ++interval) {
    look_at(arc_m_[interval]);
    for (const double s_m : stationary_m(interval)) look_at(s_m);
  }
  return sharpest_m;
}

CurvePlace PathCurve::at(double s_m) const {
  const double s = std::clamp(s_m, 0.0, length_m());
  const auto above = std::upper_bound(arc_m_.begin() + 1, arc_m_.end() - 1, s);
  const auto i = static_cast<std::size_t>(above - arc_m_.begin()) - 1;
  const double start = knots_[i].chord_m, h = knots_[i + 1].chord_m - start;
  const double arc = arc_m_[i + 1] - arc_m_[i];
  double t = start + h * (s - arc_m_[i]) / arc;
  for (int step = 0; step < 4; ++step) {
    const double missing = s - arc_m_[i] - arc_within(i, start, t);
    const double slope = speed(i, t);
    if (std::abs(missing) < 1e-12 * arc || !(slope > 1e-9)) break;
    t = std::clamp(t + missing / slope, start, start + h);
  }
  const Derivatives d = derivatives(i, t);
  const double length = std::hypot(d.dx, d.dy);
  constexpr double kTurnsBack = 1e-6;  // elsewhere it is about 1
  return {.x_m = d.x,
          .y_m = d.y,
          .heading_rad = std::atan2(d.dy, d.dx),
          .curvature_1pm = length > kTurnsBack
                               ? (d.dx * d.ddy - d.dy * d.ddx) / (length * length * length)
                               : std::numeric_limits<double>::infinity()};
}

}  // namespace regoplan
