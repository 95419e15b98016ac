#include "diagnosis/fit/calibration.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "diagnosis/bed/whitening.h"
#include "diagnosis/fit/candidate_fit.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// What a step beyond the edge of valid soils means: no value, or that of the soil at the edge.
enum class AtEdge { kTurnsBack, kGoesAlong };

/// Whitened residuals of all channels, then x itself (the priors).
class SoilResiduals : public ceres::CostFunction {
 public:
  SoilResiduals(const TestBed& bed, const std::vector<SoilCoordinate>& soil, AtEdge at_edge)
      : bed_(bed), soil_(soil), at_edge_(at_edge), measured_(bed.measured()), factor_(bed) {
    set_num_residuals(static_cast<int>(bed.size()) + static_cast<int>(soil.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(soil.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    try {
      return evaluate(parameters[0], residuals, jacobians == nullptr ? nullptr : jacobians[0]);
    } catch (const Interrupted&) {
      // Not through the solver, which logs what it cannot evaluate. All zero ends it as converged,
      // and whoever called it throws.
      const int rows = num_residuals(), columns = parameter_block_sizes().front();
      std::fill_n(residuals, rows, 0.0);
      if (jacobians != nullptr && jacobians[0] != nullptr) {
        std::fill_n(jacobians[0], rows * columns, 0.0);
      }
      return true;
    }
  }

 private:
  bool evaluate(const double* parameters, double* residuals, double* jacobian) const {
    const auto p = static_cast<Eigen::Index>(soil_.size());
    const Eigen::VectorXd at = Eigen::Map<const Eigen::VectorXd>(parameters, p);
    const Eigen::VectorXd x =
        at_edge_ == AtEdge::kGoesAlong ? kept_inside(bed_.setup.soil, soil_, at) : at;
    const auto prediction = predict(bed_, soil_, {}, x);
    if (!prediction) return false;
    Eigen::Map<Eigen::VectorXd> r(residuals, bed_.size() + p);
    r.head(bed_.size()) = whitened(bed_, factor_, Eigen::VectorXd(*prediction - measured_));
    r.tail(p) = at;
    if (jacobian == nullptr) return true;
    const auto columns = jacobian_of(bed_, soil_, {}, x, *prediction, 0, true);
    if (!columns) return false;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> j(jacobian, bed_.size() + p, p);
    j.topRows(bed_.size()) = whitened(bed_, factor_, *columns);
    j.bottomRows(p).setIdentity();
    return true;
  }

  const TestBed& bed_;
  const std::vector<SoilCoordinate>& soil_;
  AtEdge at_edge_;
  Eigen::VectorXd measured_;
  NoiseFactors factor_;
};

/// Minimises them from x on. \return half of the sum of squares reached
double descend(const TestBed& bed, const std::vector<SoilCoordinate>& soil, AtEdge at_edge,
               Eigen::VectorXd& x) {
  SoilResiduals residuals(bed, soil, at_edge);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&residuals, nullptr, x.data());
  for (std::size_t i = 0; i < soil.size(); ++i) {
    const Coordinate& c = soil[i].coordinate;
    problem.SetParameterLowerBound(x.data(), static_cast<int>(i), c.at(c.min));
    problem.SetParameterUpperBound(x.data(), static_cast<int>(i), c.at(c.max));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 40;
  options.function_tolerance = 1e-8;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  throw_if_stopped(bed.stop);
  return summary.final_cost;
}

/// Whether the soil at x lies at the edge of valid soils.
bool is_at_edge(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                const Eigen::VectorXd& x) {
  return kept_inside(bed.setup.soil, soil, x) != x;
}

}  // namespace

Calibration calibrate(const TestBed& bed, const std::vector<SoilCoordinate>& soil) {
  const auto p = static_cast<Eigen::Index>(soil.size());
  Calibration result{.x = Eigen::VectorXd::Zero(p)};
  if (!predict(bed, soil, {}, result.x)) {
    throw InputError("soil: at the prior means the wheel has no forces under some condition");
  }
  if (p > 0) {
    const double reached = descend(bed, soil, AtEdge::kTurnsBack, result.x);
    if (is_at_edge(bed, soil, result.x) &&
        maximum_stress_pull(soil, result.x) < Thresholds::kUnsuspectPull) {
      // Where it first meets the edge a fit ends, with all other numbers as far as they came.
      Eigen::VectorXd along = result.x;
      if (descend(bed, soil, AtEdge::kGoesAlong, along) < reached) {
        result.x = kept_inside(bed.setup.soil, soil, along);
      }
    }
  }
  result.prediction = *predict(bed, soil, {}, result.x);
  result.jacobian.resize(bed.size(), p);
  if (const auto j = jacobian_of(bed, soil, {}, result.x, result.prediction, 0, true)) {
    result.jacobian = *j;
  } else {
    result.jacobian.setZero();
  }
  Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(p, p);
  const Eigen::MatrixXd columns = whitened(bed, NoiseFactors(bed), result.jacobian);
  precision += columns.transpose() * columns;
  result.covariance = precision.llt().solve(Eigen::MatrixXd::Identity(p, p));
  return result;
}

}  // namespace regoplan
