#include "diagnosis/checks/stray_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/bed/discrepancy.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// What all other conditions predict of each one's residual.
struct LeftOut {
  Eigen::VectorXd error;      // residual - prediction
  Eigen::VectorXd deviation;  // of the error
};

/// By how many nats an error is likely where a few may stray: Student's t of few degrees of
/// freedom. Of normal errors two strays would have the likeliest surface turn up and down to them.
double log_density(double error, double deviation) {
  constexpr double kDegrees = 4;
  const double z = error / deviation;
  return -std::log(deviation) - (kDegrees + 1) / 2 * std::log1p(z * z / kDegrees);
}

/// Under the smooth discrepancy by which conditions tell each other best.
LeftOut left_out(const Discrepancy& discrepancy, std::size_t channel, const ChannelData& data,
                 const Eigen::VectorXd& residual) {
  const Eigen::Index n = residual.size();
  LeftOut best;
  double top = -INFINITY;
  for (std::size_t k = 0; k < discrepancy_settings().size(); ++k) {
    Eigen::MatrixXd whole = data.noise;
    const Eigen::MatrixXd& smooth = discrepancy.at(channel, k).discrepancy;
    if (smooth.size() > 0) whole += smooth;
    const Eigen::LLT<Eigen::MatrixXd> factor(whole);
    const Eigen::VectorXd precision = factor.solve(Eigen::MatrixXd::Identity(n, n)).diagonal();
    LeftOut left{factor.solve(residual).cwiseQuotient(precision),
                 precision.cwiseSqrt().cwiseInverse()};
    double score = 0;
    for (Eigen::Index i = 0; i < n; ++i) score += log_density(left.error[i], left.deviation[i]);
    if (!(score > top)) continue;
    top = score;
    best = std::move(left);
  }
  return best;
}

std::vector<std::size_t> measured_runs(const Condition& condition,
                                       const std::vector<double>& adjusted) {
  std::vector<std::size_t> runs;
  for (const std::size_t run : condition.runs) {
    if (std::isfinite(adjusted[run])) runs.push_back(run);
  }
  return runs;
}

double scatter_of(const ChannelNoise& noise, double y) {
  return std::hypot(run_deviation(noise, y), noise.day_offset, noise.day_gain * y);
}

/// Whether more than two runs of a condition differ so much that some of them must stray, or those
/// that were not weighed down already do so much from what neighbours tell.
bool at_odds(const ChannelNoise& noise, const std::vector<std::size_t>& runs,
             const std::vector<double>& adjusted, double expected) {
  if (runs.size() <= 2) return false;
  const auto [low, high] =
      std::ranges::minmax(runs, {}, [&](std::size_t run) { return adjusted[run]; });
  const double middle = (adjusted[low] + adjusted[high]) / 2;
  if (adjusted[high] - adjusted[low] >
      Thresholds::kStray_deviations * std::sqrt(2.0) * scatter_of(noise, middle)) {
    return true;
  }
  const auto is_out = [&](std::size_t run) { return noise.weight[run] <= 0.5; };
  const double far = Thresholds::kStray_deviations * scatter_of(noise, expected);
  return std::ranges::any_of(runs, is_out) && std::ranges::all_of(runs, [&](std::size_t run) {
           return is_out(run) || std::abs(adjusted[run] - expected) > far;
         });
}

/// Weights of a condition's runs once its neighbours are heard. Of two the one farther from what
/// they tell strays; of more that are at odds those are right that agree with them, however few.
/// \param z of the condition's mean, in standard deviations
std::vector<double> weights_by_neighbours(const ChannelNoise& noise,
                                          const std::vector<std::size_t>& runs,
                                          const std::vector<double>& adjusted, double expected,
                                          double z) {
  const auto stray_weight = [](double far) { return std::min(0.1, std::pow(2 / far, 4)); };
  const auto away = [&](std::size_t run) { return std::abs(adjusted[run] - expected); };
  std::vector<double> weights;
  for (const std::size_t run : runs) weights.push_back(noise.weight[run]);
  if (runs.size() <= 2) {
    const auto farthest = std::ranges::max_element(runs, {}, away) - runs.begin();
    double& weight = weights[static_cast<std::size_t>(farthest)];
    weight = std::min(weight, stray_weight(z));
    return weights;
  }
  std::vector<double> sided;
  for (const std::size_t run : runs) {
    const double far = away(run) / scatter_of(noise, expected);
    sided.push_back(far < Thresholds::kStray_deviations ? 1 : stray_weight(far));
  }
  return std::ranges::count(sided, 1.0) > 0 ? sided : weights;
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
    std::set<std::size_t> settled;  // conditions whose neighbours have been heard
    for (Eigen::Index done = 0; done < model.size() / kShare; ++done) {
      throw_if_stopped(bed.stop);
      const ChannelData& data = bed.channels[c];
      const LeftOut left = left_out(discrepancy, c, data, data.mean - model);
      Eigen::Index worst = -1;
      double most = 0;
      for (Eigen::Index i = 0; i < model.size(); ++i) {
        const std::size_t at = data.conditions[static_cast<std::size_t>(i)];
        const double z = std::abs(left.error[i]) / left.deviation[i];
        if (z <= std::max(most, Thresholds::kDoubtfulStray_deviations) || settled.contains(at))
          continue;
        const std::vector<std::size_t> runs = measured_runs(bed.conditions[at], adjusted);
        const double told_by_others = data.mean[i] - left.error[i];
        if (runs.size() <= 2 ? z <= Thresholds::kStray_deviations
                             : !at_odds(noise, runs, adjusted, told_by_others)) {
          continue;
        }
        most = z;
        worst = i;
      }
      if (worst < 0) break;
      const double expected = data.mean[worst] - left.error[worst];
      const std::size_t at = data.conditions[static_cast<std::size_t>(worst)];
      settled.insert(at);
      const std::vector<std::size_t> runs = measured_runs(bed.conditions[at], adjusted);
      const auto weights = weights_by_neighbours(noise, runs, adjusted, expected, most);
      for (std::size_t i = 0; i < runs.size(); ++i) {
        noise.weight[runs[i]] = weights[i];
        const bool was_out = std::erase(noise.outliers, runs[i]) > 0;
        if (weights[i] > 0.5) continue;
        noise.outliers.push_back(runs[i]);
        if (!was_out) strays += " " + recording.runs[runs[i]].run_id;
      }
      bed.channels[c] = means_of(condensed.day, bed.conditions, noise, adjusted);
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
