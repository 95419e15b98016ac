#include "planner/course/path_smoothing.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/problem/obstacles.h"

namespace regoplan {
namespace {

// Weights of residuals in units of the knots' spacing.
constexpr double kLength = 1, kBending = 2, kRock = 50, kSteepness = 10, kStay = 0.05;

template <class T>
T above_zero(const T& value) {
  return value > T(0) ? value : T(0);
}

/// Two knots: the way between them.
struct Length {
  double spacing_m;

  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    for (int i = 0; i < 2; ++i) residual[i] = kLength * (b[i] - a[i]) / spacing_m;
    return true;
  }
};

/// Three knots: how much the way bends, and how much more than it may.
struct Bending {
  double spacing_m, curvature_max_1pm, sharpness;

  template <class T>
  bool operator()(const T* a, const T* b, const T* c, T* residual) const {
    const T x = (a[0] - 2.0 * b[0] + c[0]) / spacing_m;
    const T y = (a[1] - 2.0 * b[1] + c[1]) / spacing_m;
    residual[0] = kBending * x;
    residual[1] = kBending * y;
    const T curvature = sqrt(x * x + y * y + 1e-12) / spacing_m;
    residual[2] = sharpness * above_zero(curvature / curvature_max_1pm - 1.0);
    return true;
  }
};

struct OffRock {
  double spacing_m, x_m, y_m, reach_m;

  template <class T>
  bool operator()(const T* at, T* residual) const {
    const T dx = at[0] - x_m, dy = at[1] - y_m;
    residual[0] = kRock * above_zero((reach_m - sqrt(dx * dx + dy * dy + 1e-9)) / spacing_m);
    return true;
  }
};

struct WithinGoal {
  double spacing_m, x_m, y_m, radius_m;

  template <class T>
  bool operator()(const T* at, T* residual) const {
    const T dx = at[0] - x_m, dy = at[1] - y_m;
    residual[0] = kRock * above_zero((sqrt(dx * dx + dy * dy + 1e-9) - radius_m) / spacing_m);
    return true;
  }
};

struct Stay {
  double spacing_m;
  PathPoint place;

  template <class T>
  bool operator()(const T* at, T* residual) const {
    residual[0] = kStay * (at[0] - place.x_m) / spacing_m;
    residual[1] = kStay * (at[1] - place.y_m) / spacing_m;
    return true;
  }
};

/// The ground's slope across about a vehicle.
struct Steepness {
  const TerrainMap* map;
  double reach_m, slope_max;

  bool operator()(const double* at, double* residual) const {
    const auto rise = [&](double dx, double dy) {
      return (map->height_m(at[0] + dx, at[1] + dy) - map->height_m(at[0] - dx, at[1] - dy)) /
             (2 * reach_m);
    };
    const double slope = std::hypot(rise(reach_m, 0), rise(0, reach_m));
    // Unknown ground pulls nowhere: driving over it will be rejected.
    residual[0] = std::isfinite(slope) ? kSteepness * std::max(0.0, slope / slope_max - 1) : 0;
    return true;
  }
};

/// \param from where the knots are to begin with \param sharpness weight of the curvature's limit
std::vector<PathPoint> settled(const PlanningProblem& problem, const std::vector<PathPoint>& knots,
                               const std::vector<PathPoint>& from, double curvature_max_1pm,
                               double sharpness) {
  std::vector<std::array<double, 2>> places;
  double length_m = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    places.push_back({from[i].x_m, from[i].y_m});
    if (i > 0) {
      length_m += std::hypot(knots[i].x_m - knots[i - 1].x_m, knots[i].y_m - knots[i - 1].y_m);
    }
  }
  const double spacing_m = length_m / static_cast<double>(knots.size() - 1);
  const BodyBox& body = problem.vehicle.body;
  const double half_width_m = std::max(body.y_max_m, -body.y_min_m);
  constexpr double kClear_m = 0.6, kShareOfSlope = 0.85, kShareOfGoal = 0.6;

  ceres::Problem squares;
  const std::size_t count = places.size();
  for (std::size_t i = 0; i < count; ++i) {
    double* at = places[i].data();
    squares.AddParameterBlock(at, 2);
    squares.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Stay, 2, 2>(new Stay{spacing_m, knots[i]}), nullptr, at);
    squares.AddResidualBlock(
        new ceres::NumericDiffCostFunction<Steepness, ceres::CENTRAL, 1, 2>(new Steepness{
            &problem.map, half_width_m, kShareOfSlope * std::tan(problem.limits.slope_max_rad)}),
        nullptr, at);
    const double near_m = 4 * spacing_m;
    problem.map.any_rock(
        from[i].x_m - near_m, from[i].x_m + near_m, from[i].y_m - near_m, from[i].y_m + near_m,
        [&](const Rock& rock) {
          if (!in_the_way(problem.map, problem.vehicle, rock)) return false;
          squares.AddResidualBlock(
              new ceres::AutoDiffCostFunction<OffRock, 1, 2>(new OffRock{
                  spacing_m, rock.x_m, rock.y_m, rock.radius_m + half_width_m + kClear_m}),
              nullptr, at);
          return false;
        });
    if (i + 1 < count) {
      squares.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Length, 2, 2, 2>(new Length{spacing_m}), nullptr, at,
          places[i + 1].data());
    }
    if (i + 2 < count) {
      squares.AddResidualBlock(new ceres::AutoDiffCostFunction<Bending, 3, 2, 2, 2>(
                                   new Bending{spacing_m, curvature_max_1pm, sharpness}),
                               nullptr, at, places[i + 1].data(), places[i + 2].data());
    }
  }
  squares.SetParameterBlockConstant(places[0].data());
  squares.SetParameterBlockConstant(places[1].data());
  if (problem.goal.heading_rad) {
    squares.SetParameterBlockConstant(places[count - 2].data());
    squares.SetParameterBlockConstant(places[count - 1].data());
  } else {
    squares.AddResidualBlock(
        new ceres::AutoDiffCostFunction<WithinGoal, 1, 2>(new WithinGoal{
            spacing_m, problem.goal.x_m, problem.goal.y_m, kShareOfGoal * problem.goal.radius_m}),
        nullptr, places[count - 1].data());
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.max_num_iterations = 100;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &squares, &summary);
  std::vector<PathPoint> moved;
  for (const auto& place : places) moved.push_back({place[0], place[1]});
  return moved;
}

}  // namespace

std::vector<PathPoint> smoothed(const PlanningProblem& problem, const std::vector<PathPoint>& knots,
                                double curvature_max_1pm) {
  // From the start on the limit would hold the solver back wherever the path is sharper.
  constexpr double kSharpness = 2;
  const std::vector<PathPoint> free = settled(problem, knots, knots, curvature_max_1pm, 0);
  return settled(problem, knots, free, curvature_max_1pm, kSharpness);
}

}  // namespace regoplan
