#include "drive_diagnosis/contest/slope_errors.h"

#include <cmath>

namespace regoplan {

Eigen::MatrixXd slope_error_columns(const SlopeErrors& errors, const std::vector<bool>& follows,
                                    double persistent) {
  const Eigen::Index channels = errors.channels, rows = errors.along.size();
  const Eigen::Index windows = rows / channels;
  std::vector<Eigen::VectorXd> columns;
  const auto column = [&]() -> Eigen::VectorXd& {
    return columns.emplace_back(Eigen::VectorXd::Zero(rows));
  };
  const auto set = [&](const Eigen::VectorXd& of, Eigen::Index window, double size,
                       Eigen::VectorXd& in) {
    in.segment(window * channels, channels) = size * of.segment(window * channels, channels);
  };
  for (Eigen::Index w = 0; w < windows; ++w) {
    set(errors.across, w, 1, column());
    if (persistent > 0) set(errors.along, w, std::sqrt(persistent), column());
  }
  const double by_height = std::sqrt((1 - persistent) / 2);
  for (Eigen::Index border = 0; border <= windows; ++border) {
    const bool ends = border > 0, begins = border < windows;
    const bool is_shared = ends && begins && follows[static_cast<std::size_t>(border)];
    if (ends) set(errors.along, border - 1, by_height, column());
    if (begins) {
      Eigen::VectorXd& height = is_shared ? columns.back() : column();
      set(errors.along, border, -by_height, height);
    }
  }
  Eigen::MatrixXd result(rows, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    result.col(k) = columns[static_cast<std::size_t>(k)];
  }
  return result;
}

Eigen::MatrixXd likely_slope_errors(const EffectContest& contest, const SlopeErrors& errors,
                                    std::optional<std::size_t> pitch) {
  constexpr double kNotTold = 1, kWorth_nats = 1;
  Eigen::MatrixXd most_likely = slope_error_columns(errors, contest.follows, kNotTold);
  if (!pitch) return most_likely;
  const auto of_pitch = Eigen::seq(static_cast<Eigen::Index>(*pitch), Eigen::last, errors.channels);
  EffectContest told{.data = contest.data(of_pitch)};
  told.parameters = contest.parameters(of_pitch, Eigen::all);
  told.faults_known = contest.faults_known;
  told.ground = most_likely(of_pitch, Eigen::all);
  double most = likelihood_nats(told);
  for (const double persistent : {0.3, 0.1}) {
    Eigen::MatrixXd columns = slope_error_columns(errors, contest.follows, persistent);
    told.ground = columns(of_pitch, Eigen::all);
    const double nats = likelihood_nats(told);
    if (nats <= most + kWorth_nats) continue;
    most = nats;
    most_likely = std::move(columns);
  }
  return most_likely;
}

}  // namespace regoplan
