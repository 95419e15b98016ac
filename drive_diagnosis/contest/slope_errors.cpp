#include "drive_diagnosis/contest/slope_errors.h"

#include <algorithm>
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

double likely_persistence(const EffectContest& contest, const SlopeErrors& errors,
                          const std::vector<Eigen::Index>& channels) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < contest.data.size(); ++row) {
    if (std::ranges::find(channels, row % errors.channels) != channels.end()) rows.push_back(row);
  }
  EffectContest told{.data = contest.data(rows)};
  told.parameters = contest.parameters(rows, Eigen::all);
  told.faults_known = contest.faults_known;
  told.soil_numbers = contest.soil_numbers;
  told.wide_directions = contest.wide_directions;
  for (const KnownZone& zone : contest.zones_known) {
    told.zones_known.push_back({.share = zone.share, .columns = zone.columns(rows, Eigen::all)});
  }
  const auto nats = [&](double persistent) {
    told.ground = slope_error_columns(errors, contest.follows, persistent)(rows, Eigen::all);
    return likelihood_nats(told);
  };
  constexpr double kNotTold = 1, kWorth_nats = 1;
  double likeliest = kNotTold, most = nats(kNotTold);
  for (const double persistent : {0.3, 0.1}) {
    const double there = nats(persistent);
    if (there <= most + kWorth_nats) continue;
    most = there;
    likeliest = persistent;
  }
  return likeliest;
}

}  // namespace regoplan
