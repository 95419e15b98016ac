// What a contest makes likeliest, with all that varies in it.
#include <Eigen/Dense>

#include "drive_diagnosis/contest/effect_contest.h"
#include "drive_diagnosis/contest/free_columns.h"

namespace regoplan {
namespace {

/// Deviations of a known zone's numbers, in those of the map's soil, for what does not go along the
/// ways in which soils differ: where the largest stress lies (a0 of .2 to .45 in Wong & Reece 1967)
/// says little of a soil, and would else take the place of its bearing.
constexpr double kOwn = 1.5;

/// What deviations of 1 stand for in a known zone: each number varies by itself, and along the
/// directions in which they go together.
Eigen::MatrixXd zone_factor(const EffectContest& contest) {
  const auto q = static_cast<Eigen::Index>(contest.soil_numbers);
  Eigen::MatrixXd covariance = kOwn * kOwn * Eigen::MatrixXd::Identity(q, q);
  for (const Eigen::VectorXd& wide : contest.wide_directions) covariance += wide * wide.transpose();
  return covariance.llt().matrixL();
}

}  // namespace

Eigen::MatrixXd free_columns(const EffectContest& contest) {
  const auto q = static_cast<Eigen::Index>(contest.soil_numbers);
  const auto zones = static_cast<Eigen::Index>(contest.zones_known.size());
  const Eigen::Index parameters = contest.parameters.cols();
  const Eigen::Index ground = contest.ground.cols();
  Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(contest.data.size(), parameters + zones * q + ground);
  columns.leftCols(parameters) = contest.parameters;
  if (ground > 0) columns.rightCols(ground) = contest.ground;
  for (const std::size_t fault : contest.faults_known) {
    columns.col(static_cast<Eigen::Index>(fault)) *= kClaimedFault;
  }
  if (zones == 0) return columns;
  const Eigen::MatrixXd factor = zone_factor(contest);
  for (Eigen::Index z = 0; z < zones; ++z) {
    columns.middleCols(parameters + z * q, q) =
        contest.zones_known[static_cast<std::size_t>(z)].columns * factor;
  }
  return columns;
}

ContestFit fit_contest(const EffectContest& contest) {
  const Eigen::MatrixXd columns = free_columns(contest);
  const Eigen::Index p = columns.cols();
  const Eigen::MatrixXd covariance =
      (columns.transpose() * columns + Eigen::MatrixXd::Identity(p, p)).inverse();
  const Eigen::VectorXd x = covariance * (columns.transpose() * contest.data);
  const Eigen::VectorXd std = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::Index parameters = contest.parameters.cols();
  ContestFit fit{.parameters = x.head(parameters), .parameters_std = std.head(parameters)};
  for (const std::size_t fault : contest.faults_known) {
    fit.parameters[static_cast<Eigen::Index>(fault)] *= kClaimedFault;
    fit.parameters_std[static_cast<Eigen::Index>(fault)] *= kClaimedFault;
  }
  const auto q = static_cast<Eigen::Index>(contest.soil_numbers);
  if (contest.zones_known.empty()) return fit;
  const Eigen::MatrixXd factor = zone_factor(contest);
  for (std::size_t z = 0; z < contest.zones_known.size(); ++z) {
    const Eigen::Index at = parameters + static_cast<Eigen::Index>(z) * q;
    fit.zones.emplace_back(factor * x.segment(at, q));
    fit.zones_covariance.emplace_back(factor * covariance.block(at, at, q, q) * factor.transpose());
  }
  return fit;
}

double likelihood_nats(const EffectContest& contest) {
  const Eigen::MatrixXd columns = free_columns(contest);
  const Eigen::Index p = columns.cols();
  const Eigen::LLT<Eigen::MatrixXd> factor(columns.transpose() * columns +
                                           Eigen::MatrixXd::Identity(p, p));
  const double log_det = 2 * factor.matrixLLT().diagonal().array().log().sum();
  const double explained = factor.matrixL().solve(columns.transpose() * contest.data).squaredNorm();
  return -(contest.data.squaredNorm() - explained + log_det) / 2;
}

double prior_nats(const EffectContest& contest, const ContestFit& fit) {
  Eigen::VectorXd parameters = fit.parameters;
  for (const std::size_t fault : contest.faults_known) {
    parameters[static_cast<Eigen::Index>(fault)] /= kClaimedFault;
  }
  double squares = parameters.squaredNorm();
  if (!fit.zones.empty()) {
    const Eigen::MatrixXd factor = zone_factor(contest);
    for (const Eigen::VectorXd& zone : fit.zones) {
      squares += factor.triangularView<Eigen::Lower>().solve(zone).squaredNorm();
    }
  }
  return squares / 2;
}

}  // namespace regoplan
