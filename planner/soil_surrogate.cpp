#include "planner/soil_surrogate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <set>

namespace regoplan {
namespace {

Eigen::RowVectorXd terms_of(const Eigen::RowVectorXd& z) {
  const Eigen::Index n = z.size();
  Eigen::RowVectorXd terms(1 + n + n * (n + 1) / 2);
  terms[0] = 1;
  terms.segment(1, n) = z;
  Eigen::Index next = 1 + n;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index k = i; k < n; ++k) terms[next++] = z[i] * z[k];
  }
  return terms;
}

/// Solves least squares with a pull toward 0 of all but the constant.
Eigen::MatrixXd ridge(const Eigen::MatrixXd& terms, const Eigen::MatrixXd& values, double pull) {
  Eigen::MatrixXd normal = terms.transpose() * terms;
  normal.diagonal().tail(normal.rows() - 1).array() += pull;
  return normal.ldlt().solve(terms.transpose() * values);
}

}  // namespace

SoilNumbers uncertain_numbers(const PlanningProblem& problem,
                              const std::vector<VehicleState>& states) {
  const GroundFinder ground(problem.map, problem.vehicle);
  std::set<std::size_t> soils;
  for (const VehicleState& state : states) {
    const GroundPatch patch = ground.at(state.x_m, state.y_m, state.yaw_rad);
    for (std::size_t i = 0; i < problem.vehicle.wheels.size(); ++i) {
      soils.insert(static_cast<std::size_t>(patch.soil.at(i)));
    }
  }
  SoilNumbers numbers;
  for (const std::size_t soil : soils) {
    const UncertainSoil& known = problem.map.soils()[soil].soil;
    for (std::size_t k = 0; k < soil_parameters().size(); ++k) {
      if (known.standard_deviation.*soil_parameters()[k].member > 0) numbers.push_back({soil, k});
    }
  }
  return numbers;
}

std::vector<Eigen::Index> columns_under(const PlanningProblem& problem, const SoilNumbers& numbers,
                                        const VehicleState& state) {
  const SoilNumbers here = uncertain_numbers(problem, {state});
  std::vector<Eigen::Index> columns;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (std::find(here.begin(), here.end(), numbers[k]) != here.end()) {
      columns.push_back(static_cast<Eigen::Index>(k));
    }
  }
  return columns;
}

Eigen::MatrixXd standard_deviations(const std::vector<MapSoil>& soils, const SoilNumbers& numbers,
                                    const std::vector<SoilDraw>& draws) {
  Eigen::MatrixXd deviations(static_cast<Eigen::Index>(draws.size()),
                             static_cast<Eigen::Index>(numbers.size()));
  for (std::size_t i = 0; i < draws.size(); ++i) {
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const auto member = soil_parameters()[numbers[k].parameter].member;
      const UncertainSoil& known = soils[numbers[k].soil].soil;
      deviations(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          (draws[i][numbers[k].soil].*member - known.mean.*member) /
          known.standard_deviation.*member;
    }
  }
  return deviations;
}

std::size_t training_draws(std::size_t numbers) {
  const std::size_t terms = 1 + numbers + numbers * (numbers + 1) / 2;
  return std::min<std::size_t>(30 + terms + terms / 2, 170);
}

SoilSurrogate::SoilSurrogate(const Eigen::MatrixXd& deviations,
                             const std::vector<std::vector<PathMargins>>& judged, std::size_t draws,
                             std::vector<Columns> columns)
    : columns_(std::move(columns)) {
  constexpr double kPull = 0.3;
  const auto rows = static_cast<Eigen::Index>(draws);
  for (std::size_t place = 0; place < columns_.size(); ++place) {
    const Eigen::MatrixXd here = deviations(Eigen::all, columns_[place]);
    Eigen::MatrixXd terms(rows, terms_of(here.row(0)).size()), values(rows, 3);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const PathMargins& margins = judged[static_cast<std::size_t>(i)][place];
      terms.row(i) = terms_of(here.row(i));
      values.row(i) << margins.cornering, margins.tip_over, margins.traction;
    }
    coefficients_.push_back(ridge(terms, values, kPull));
  }
}

PathMargins SoilSurrogate::smallest(const Eigen::RowVectorXd& deviations) const {
  PathMargins smallest;
  for (std::size_t place = 0; place < columns_.size(); ++place) {
    const Eigen::RowVector3d said = terms_of(deviations(columns_[place])) * coefficients_[place];
    smallest = {.cornering = std::min(smallest.cornering, said[0]),
                .tip_over = std::min(smallest.tip_over, said[1]),
                .traction = std::min(smallest.traction, said[2])};
  }
  return smallest;
}

LinearInfluence linear_influence(const Eigen::MatrixXd& deviations, const Eigen::VectorXd& values) {
  const Eigen::MatrixXd centred = deviations.rowwise() - deviations.colwise().mean();
  const Eigen::VectorXd spread = values.array() - values.mean();
  const Eigen::Index n = deviations.cols();
  LinearInfluence influence{.slope = Eigen::VectorXd::Zero(n), .share = Eigen::VectorXd::Zero(n)};
  const double variance = spread.squaredNorm();
  if (!(variance > 0)) return influence;
  influence.slope = centred.colPivHouseholderQr().solve(spread);
  for (Eigen::Index k = 0; k < n; ++k) {
    influence.share[k] =
        influence.slope[k] * influence.slope[k] * centred.col(k).squaredNorm() / variance;
  }
  influence.explained = 1 - (spread - centred * influence.slope).squaredNorm() / variance;
  return influence;
}

}  // namespace regoplan
