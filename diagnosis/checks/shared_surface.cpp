#include "diagnosis/checks/shared_surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// Squared error of a point predicted by all others, over what it is told to be: 1 in the mean of a
/// surface that errs as it says.
double left_out_misfit(const Eigen::LLT<Eigen::MatrixXd>& factor, const Eigen::VectorXd& residual) {
  const Eigen::MatrixXd precision =
      factor.solve(Eigen::MatrixXd::Identity(residual.size(), residual.size()));
  const Eigen::VectorXd weighed = precision * residual;
  return (weighed.array().square() / precision.diagonal().array()).mean();
}

/// One setting of the discrepancy, and how the points bear it out.
struct Member {
  DiscrepancyScales scales;
  Sides sides = Sides::kMirrored;
  double variance = 0, log_weight = 0;
};

/// Every setting by its likelihood. Where points are predicted by all others worse than is told,
/// what lies between points varies by as much more; what is measured is known as well as before.
std::vector<Member> members_of(const ShortcomingPoints& points, Channel channel,
                               const std::stop_token& stop) {
  std::vector<Member> members;
  for (const DiscrepancyScales& scales : discrepancy_scales()) {
    for (const Sides sides : {Sides::kMirrored, Sides::kApart}) {
      const Eigen::MatrixXd kernel =
          discrepancy_kernels(scales, channel, points.at, points.at, sides);
      for (const double amplitude : {0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
        throw_if_stopped(stop);
        const double variance = std::pow(amplitude * points.scale, 2);
        const Eigen::LLT<Eigen::MatrixXd> factor(points.noise + variance * kernel);
        const double fit = factor.matrixL().solve(points.residual).squaredNorm();
        const double log_det = 2 * factor.matrixLLT().diagonal().array().log().sum();
        members.push_back(
            {.scales = scales,
             .sides = sides,
             .variance = variance * std::max(1.0, left_out_misfit(factor, points.residual)),
             .log_weight =
                 -0.5 * (fit + log_det) + (sides == Sides::kApart ? kApart_log_prior : 0.0)});
      }
    }
  }
  return members;
}

SharedSurface surface_of(const Member& member, const ShortcomingPoints& points, Channel channel,
                         const ConditionsAt& wanted) {
  const auto kernels = [&](const ConditionsAt& a, const ConditionsAt& b) -> Eigen::MatrixXd {
    return member.variance * discrepancy_kernels(member.scales, channel, a, b, member.sides);
  };
  const Eigen::LLT<Eigen::MatrixXd> factor(points.noise + kernels(points.at, points.at));
  const Eigen::MatrixXd cross = kernels(wanted, points.at);
  const Eigen::MatrixXd half = factor.matrixL().solve(cross.transpose());
  return {cross * factor.solve(points.residual), kernels(wanted, wanted) - half.transpose() * half};
}

}  // namespace

SharedSurface surface_through(const ShortcomingPoints& points, Channel channel,
                              const ConditionsAt& wanted, const std::stop_token& stop) {
  const auto n = static_cast<Eigen::Index>(wanted.size());
  SharedSurface sum{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  if (points.at.empty()) return sum;
  constexpr double kNoWeight_nats = 15;  // of the likeliest: 3e-7
  std::vector<Member> members = members_of(points, channel, stop);
  const double top = std::ranges::max_element(members, {}, &Member::log_weight)->log_weight;
  std::erase_if(members, [&](const Member& m) { return m.log_weight < top - kNoWeight_nats; });
  double whole = 0;
  for (const Member& m : members) whole += std::exp(m.log_weight - top);
  std::vector<SharedSurface> surfaces;
  for (const Member& m : members) {
    throw_if_stopped(stop);
    surfaces.push_back(surface_of(m, points, channel, wanted));
    sum.mean += std::exp(m.log_weight - top) / whole * surfaces.back().mean;
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Eigen::VectorXd off = surfaces[i].mean - sum.mean;
    sum.covariance += std::exp(members[i].log_weight - top) / whole *
                      (surfaces[i].covariance + off * off.transpose());
  }
  return sum;
}

}  // namespace regoplan
