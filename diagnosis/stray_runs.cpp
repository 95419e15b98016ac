#include "diagnosis/stray_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/discrepancy.h"

namespace regoplan {
namespace {

constexpr double kStray = 4;  // standard deviations of the prediction from the others

/// What all other conditions predict of each one's residual.
struct LeftOut {
  Eigen::VectorXd error;      // residual - prediction
  Eigen::VectorXd deviation;  // of the error
};

/// Under the smooth discrepancy that the residuals make likeliest.
LeftOut left_out(const Discrepancy& discrepancy, std::size_t channel, const ChannelData& data,
                 const Eigen::VectorXd& residual) {
  const Eigen::Index n = residual.size();
  Eigen::LLT<Eigen::MatrixXd> best;
  double top = -INFINITY;
  for (std::size_t k = 0; k < discrepancy_settings().size(); ++k) {
    Eigen::MatrixXd whole = data.noise;
    const Eigen::MatrixXd& smooth = discrepancy.at(channel, k).discrepancy;
    if (smooth.size() > 0) whole += smooth;
    const Eigen::LLT<Eigen::MatrixXd> factor(whole);
    const double score = -0.5 * factor.matrixL().solve(residual).squaredNorm() -
                         factor.matrixLLT().diagonal().array().log().sum();
    if (!(score > top)) continue;
    top = score;
    best = factor;
  }
  const Eigen::VectorXd precision = best.solve(Eigen::MatrixXd::Identity(n, n)).diagonal();
  return {best.solve(residual).cwiseQuotient(precision), precision.cwiseSqrt().cwiseInverse()};
}

std::vector<std::size_t> measured_runs(const Condition& condition,
                                       const std::vector<double>& adjusted) {
  std::vector<std::size_t> runs;
  for (const std::size_t run : condition.runs) {
    if (std::isfinite(adjusted[run])) runs.push_back(run);
  }
  return runs;
}

}  // namespace

CondensedRecording strays_weighed_down(const Recording& recording, CondensedRecording condensed,
                                       const Eigen::VectorXd& prediction) {
  constexpr Eigen::Index kShare = 12;
  TestBed& bed = condensed.bed;
  const Discrepancy discrepancy(bed);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    ChannelNoise& noise = condensed.noise[c];
    const std::vector<double>& adjusted = condensed.adjusted[c];
    const Eigen::VectorXd model = prediction.segment(bed.offset(c), bed.channels[c].mean.size());
    std::string strays;
    for (Eigen::Index done = 0; done < model.size() / kShare; ++done) {
      const ChannelData& data = bed.channels[c];
      const LeftOut left = left_out(discrepancy, c, data, data.mean - model);
      Eigen::Index worst = -1;
      double most = kStray;
      for (Eigen::Index i = 0; i < model.size(); ++i) {
        const std::size_t at = data.conditions[static_cast<std::size_t>(i)];
        const double z = std::abs(left.error[i]) / left.deviation[i];
        if (z > most && measured_runs(bed.conditions[at], adjusted).size() <= 2) {
          most = z;
          worst = i;
        }
      }
      if (worst < 0) break;
      const double expected = data.mean[worst] - left.error[worst];
      const std::vector<std::size_t> runs =
          measured_runs(bed.conditions[data.conditions[static_cast<std::size_t>(worst)]], adjusted);
      const std::size_t stray = *std::ranges::max_element(
          runs, {}, [&](std::size_t run) { return std::abs(adjusted[run] - expected); });
      if (noise.weight[stray] < 0.1) break;
      noise.weight[stray] = std::min(0.1, std::pow(2 / most, 4));
      noise.outliers.push_back(stray);
      strays += " " + recording.runs[stray].run_id;
      bed.channels[c] = means_of(recording, bed.conditions, noise, adjusted);
    }
    if (!strays.empty()) {
      condensed.notes.push_back(
          fmt::format("{}: weighed down, far from what neighbouring conditions tell:{}",
                      name(noise.channel), strays));
    }
  }
  return condensed;
}

}  // namespace regoplan
