#include "diagnosis/recording/noise_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numeric>

#include "diagnosis/recording/median.h"
#include "diagnosis/recording/neighbour_scatter.h"
#include "diagnosis/recording/replicate_covariance.h"
#include "diagnosis/recording/replicates.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

constexpr int kFewest = 4;  // degrees of freedom to trust replicates

/// Contrasts that it takes to tell whether scatter grows with the signal: fewer, chosen, would take
/// a run near zero that happens to agree for all of them.
constexpr Eigen::Index kTellsGrowth = 12;

/// Shares of the constant part that the other parts are tried at. Nothing and even factors: weighed
/// alike, nearly a half-Cauchy prior about a run's scatter (Gelman 2006, Bayesian Analysis 1, 515).
constexpr std::array kSteps{0.0, 0.35, 0.7, 1.4, 2.8};

/// Robust scatter of one run from the differences of replicates.
double rough_deviation(const Replicates& replicates, const std::vector<double>& value) {
  std::vector<double> differences;
  for (const auto& group : replicates.groups) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        differences.push_back(std::abs(value[group[i]] - value[group[k]]));
      }
    }
  }
  const double middle = median(differences) / (kMedianOfNormal * std::sqrt(2.0));
  if (middle > 0) return middle;
  return std::accumulate(differences.begin(), differences.end(), 0.0) /
         (1.128 * static_cast<double>(differences.size()));
}

void weigh_outliers(const Replicates& replicates, const std::vector<double>& value,
                    const auto& deviation, std::vector<double>& weight) {
  for (const auto& group : replicates.groups) {
    double middle = centre(group, value);
    for (int pass = 0; pass < 10; ++pass) {
      double sum = 0, weights = 0;
      for (const std::size_t run : group) {
        const double n = static_cast<double>(group.size());
        const double z =
            std::abs(value[run] - middle) / (deviation(middle) * std::sqrt((n - 1) / n));
        weight[run] = z < Thresholds::kOutlier_deviations
                          ? 1
                          : std::pow(Thresholds::kOutlier_deviations / z, 4);
        sum += weight[run] * value[run];
        weights += weight[run];
      }
      if (group.size() == 2) break;  // neither of two can be called the outlier
      middle = sum / weights;
    }
  }
}

/// What scatter may come from besides each run itself.
struct Explained {
  bool days = false;
  const std::vector<double>& trend;  // empty: none
  const std::stop_token& stop;
};

/// A column for the offset of each day, then one for the share of the signal that it adds.
Eigen::MatrixXd shared_by_days(const ReplicateRows& rows, const Eigen::VectorXd& signal) {
  Eigen::MatrixXd shared(signal.size(), 2 * rows.of_day.cols());
  shared << rows.of_day, signal.asDiagonal() * rows.of_day;
  return shared;
}

/// Restricted maximum likelihood of the constant part, and of the others over it on a grid; beside
/// it the likelihood of each step of what days may differ by.
void fit_variances(const Recording& recording, const Replicates& replicates,
                   const std::vector<double>& value, const Explained& by, ChannelNoise& noise) {
  const ReplicateRows rows = rows_of(recording, replicates, value);
  const auto n = static_cast<double>(rows.runs.size());
  const double rms = std::max(std::sqrt(rows.signal.squaredNorm() / n), 1e-300);
  const Eigen::VectorXd signal = rows.signal / rms;
  const Eigen::VectorXd inverse_weight = rows.of(noise.weight).cwiseInverse();
  const auto contrasts = static_cast<double>(rows.contrasts());
  Eigen::MatrixXd known = Eigen::MatrixXd::Zero(signal.size(), 2);
  known.col(0) = rows.value;
  if (!by.trend.empty()) known.col(1) = rows.of(by.trend);
  const Eigen::MatrixXd shared =
      by.days ? shared_by_days(rows, signal) : Eigen::MatrixXd(signal.size(), 0);
  const Eigen::Index days = shared.cols() / 2;
  Eigen::VectorXd deviations(2 * days);
  double best = -INFINITY;
  const std::vector<double> grid(kSteps.begin(), kSteps.end());
  const std::vector<double> none{0};
  const bool may_grow = rows.contrasts() >= kTellsGrowth;
  const std::vector<double>& proportional_grid = may_grow ? grid : none;
  const std::vector<double>& day_grid = by.days ? grid : none;
  const std::vector<double>& day_gain_grid = by.days && may_grow ? grid : none;
  noise.day_log_likelihood.assign(by.days ? kSteps.size() : 0, -INFINITY);
  for (const double p : proportional_grid) {
    const Eigen::VectorXd variance =
        (inverse_weight.array() * (1 + p * p * signal.array().square())).matrix();
    ReplicateCovariance covariance(rows, variance, shared);
    const ReplicateCovariance::Differences differences = covariance.differences(known);
    for (std::size_t k = 0; k < day_grid.size(); ++k) {
      const double d = day_grid[k];
      for (const double g : day_gain_grid) {
        throw_if_stopped(by.stop);
        deviations.head(days).setConstant(d);
        deviations.tail(days).setConstant(g);
        covariance.share(deviations);
        const Eigen::MatrixXd products = covariance.products(differences);
        const double weight = products(1, 1), along = products(0, 1);
        const double factor_of_trend = weight > 0 ? along / weight : 0;
        const double s2 = (products(0, 0) - factor_of_trend * along) / contrasts;
        const double others =
            -0.5 * (contrasts * std::log(s2) + covariance.log_determinant() + (p > 0) + (g > 0));
        const double score = others - 0.5 * (d > 0);
        if (by.days) {
          noise.day_log_likelihood[k] = std::max(noise.day_log_likelihood[k], others);
        }
        if (!(score > best)) continue;
        best = score;
        noise.log_likelihood = score;
        noise.trend = factor_of_trend;
        noise.constant = std::sqrt(s2);
        noise.proportional = p * noise.constant / rms;
        noise.day_offset = d * noise.constant;
        noise.day_gain = g * noise.constant / rms;
        // What days and the other parts that were fitted take of the contrasts tells nothing of a
        // run's own scatter.
        noise.degrees_of_freedom = std::max(
            1, static_cast<int>(std::lround(covariance.own_share())) - (p > 0) - (weight > 0));
      }
    }
  }
}

ChannelNoise told_by_neighbours(Channel channel, const RunScatter& scatter, std::size_t runs) {
  return {.channel = channel,
          .source = NoiseSource::kNeighbours,
          .constant = scatter.deviation,
          .neighbour_degrees_of_freedom = scatter.degrees_of_freedom,
          .weight = std::vector<double>(runs, 1.0)};
}

/// The least share of its true variance that so few replicates show but once in a thousand.
double variance_share_of_few(int degrees_of_freedom) {
  const boost::math::chi_squared chi_squared(degrees_of_freedom);
  return boost::math::quantile(chi_squared, 1e-3) / degrees_of_freedom;
}

/// Whether neighbouring conditions scatter more than few replicates, and no more than these may by
/// chance tell too little.
bool is_uncontradicted(const RunScatter& scatter, const ChannelNoise& by_replicates,
                       const std::vector<double>& value) {
  const double told = usual_deviation(by_replicates, value);
  if (by_replicates.degrees_of_freedom < kFewest) return told < scatter.deviation;
  const double least =
      scatter.deviation * std::sqrt(variance_share_of_few(by_replicates.degrees_of_freedom));
  return told < scatter.deviation && told > least;
}

/// Contrasts of replicates that outliers leave.
int contrasts_without(const std::vector<std::size_t>& outliers, const Replicates& replicates) {
  int contrasts = 0;
  for (const auto& group : replicates.groups) {
    const auto good = std::ranges::count_if(
        group, [&](std::size_t run) { return std::ranges::find(outliers, run) == outliers.end(); });
    contrasts += static_cast<int>(std::max<std::ptrdiff_t>(good - 1, 0));
  }
  return contrasts;
}

int runs_on_two_days(const Recording& recording, const Replicates& replicates) {
  return static_cast<int>(std::ranges::count_if(replicates.groups, [&](const auto& group) {
    return std::ranges::any_of(group, [&](std::size_t run) {
      return recording.runs[run].day != recording.runs[group.front()].day;
    });
  }));
}

bool several_days(const Recording& recording) {
  return std::ranges::any_of(
      recording.runs, [&](const WheelRun& run) { return run.day != recording.runs.front().day; });
}

/// A bed prepared once may differ from the next by as much as days do elsewhere, seen or not.
void assume_a_day(ChannelNoise& noise) {
  noise.day_assumed = true;
  noise.day_offset = noise.constant / 2;
}

/// Days that are not told come and go with the rounds of replicates; what these differ by, the mean
/// of all of them is off by as well. Where only some conditions were run again, the others were not
/// in every round, and no mean over rounds is theirs.
void seek_untold_days(const Recording& recording, const std::vector<Condition>& conditions,
                      const std::vector<double>& value, const std::stop_token& stop,
                      ChannelNoise& noise) {
  if (recording.columns.time) return;  // time that is told leaves no days untold
  const auto rounds = rounds_as_days(recording, conditions);
  if (!rounds || rounds->share_repeated < Thresholds::kInRounds_share) return;
  const std::vector<double> no_trend;
  ChannelNoise of_rounds = noise;
  fit_variances(rounds->recording, replicates_of(conditions, value), value,
                {.days = true, .trend = no_trend, .stop = stop}, of_rounds);
  noise.day_log_likelihood = std::move(of_rounds.day_log_likelihood);
  noise.untold_days = rounds->count;
}

/// Mean square of what days differ by, over a run's scatter, that a channel and half of what every
/// other channel says leave likely.
double day_ratio_squared(const std::vector<ChannelNoise>& noise, std::size_t channel) {
  constexpr double kOthers = 0.5;
  std::vector<double> sums(kSteps.size(), 0.0);
  for (std::size_t c = 0; c < noise.size(); ++c) {
    if (noise[c].day_log_likelihood.empty()) continue;
    for (std::size_t k = 0; k < sums.size(); ++k) {
      sums[k] += (c == channel ? 1 : kOthers) * noise[c].day_log_likelihood[k];
    }
  }
  const double top = std::ranges::max(sums);
  double square = 0, whole = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) {
    square += std::exp(sums[k] - top) * kSteps[k] * kSteps[k];
    whole += std::exp(sums[k] - top);
  }
  return square / whole;
}

/// The setup's number, or else what neighbouring conditions tell.
/// \throws InputError where neither tells any
ChannelNoise without_replicates(const std::vector<Condition>& conditions, const ChannelRuns& runs,
                                const DiagnosisSetup& setup) {
  const std::size_t count = runs.adjusted.size();
  const auto given = setup.noise_standard_deviation.find(runs.channel);
  ChannelNoise noise =
      given != setup.noise_standard_deviation.end()
          ? ChannelNoise{.channel = runs.channel,
                         .source = NoiseSource::kSetup,
                         .constant = given->second,
                         .weight = std::vector<double>(count, 1.0)}
          : told_by_neighbours(runs.channel,
                               neighbour_scatter(conditions, runs.adjusted, runs.modelled), count);
  assume_a_day(noise);
  if (noise.constant > 0) return noise;
  throw InputError(
      fmt::format("{}: neither replicates nor setup tell its noise, and neighbouring conditions "
                  "do not scatter",
                  name(runs.channel)));
}

}  // namespace

double run_deviation(const ChannelNoise& noise, double y) {
  return std::hypot(noise.constant, noise.proportional * y);
}

double usual_deviation(const ChannelNoise& noise, const std::vector<double>& values) {
  double sum = 0;
  int count = 0;
  for (const double y : values) {
    if (!std::isfinite(y)) continue;
    sum += y * y;
    ++count;
  }
  return run_deviation(noise, count == 0 ? 0 : std::sqrt(sum / count));
}

ChannelNoise estimate_noise(const Recording& recording, const std::vector<Condition>& conditions,
                            const ChannelRuns& runs, const DiagnosisSetup& setup,
                            const std::vector<double>& trend, const std::stop_token& stop) {
  // Names of their own: clang 14 lets no lambda see what a structured binding names.
  const Channel channel = runs.channel;
  const std::vector<double>&adjusted = runs.adjusted, &model = runs.modelled;
  ChannelNoise noise{.channel = channel, .weight = std::vector<double>(adjusted.size(), 1.0)};
  const Replicates replicates = replicates_of(conditions, adjusted);
  if (replicates.contrasts < kFewest) return without_replicates(conditions, runs, setup);
  const bool identical = std::ranges::all_of(replicates.groups, [&](const auto& group) {
    return std::ranges::all_of(group, [&](std::size_t run) {
      return recording.runs[run].value(channel) == recording.runs[group.front()].value(channel);
    });
  });
  if (identical) {
    throw InputError(
        fmt::format("{}: all replicates are identical, so they tell nothing of its "
                    "noise (copied rows?)",
                    name(channel)));
  }
  const bool days_seen = runs_on_two_days(recording, replicates) >= 3;
  const Explained by{.days = several_days(recording) && days_seen, .trend = trend, .stop = stop};
  const auto fit = [&] { fit_variances(recording, replicates, adjusted, by, noise); };
  // An outlier is one beside the trend: what follows the trend lies far from its fellows and
  // belongs.
  std::vector<double> beside = adjusted;
  const auto take_trend_off = [&] {
    for (std::size_t run = 0; run < trend.size(); ++run) {
      beside[run] = adjusted[run] - noise.trend * trend[run];
    }
  };
  if (!trend.empty()) fit();
  take_trend_off();
  const double rough = rough_deviation(replicates, beside);
  weigh_outliers(
      replicates, beside, [&](double) { return 1.3 * rough; }, noise.weight);
  fit();
  take_trend_off();
  const auto whole_deviation = [&](double y) {
    return std::hypot(run_deviation(noise, y), noise.day_offset, noise.day_gain * y);
  };
  weigh_outliers(replicates, beside, whole_deviation, noise.weight);
  fit();
  for (std::size_t run = 0; run < noise.weight.size(); ++run) {
    if (noise.weight[run] < 0.5) noise.outliers.push_back(run);
  }
  noise.degrees_of_freedom = std::max(1, noise.degrees_of_freedom - replicates.contrasts +
                                             contrasts_without(noise.outliers, replicates));
  const bool few = noise.degrees_of_freedom < kEnoughReplicates && trend.empty();
  if (few && setup.noise_standard_deviation.contains(channel)) {
    if (noise.degrees_of_freedom < kFewest) return without_replicates(conditions, runs, setup);
  } else if (few) {
    const RunScatter scatter = neighbour_scatter(conditions, adjusted, model);
    if (is_uncontradicted(scatter, noise, adjusted)) {
      noise = told_by_neighbours(channel, scatter, adjusted.size());
      assume_a_day(noise);
      return noise;
    }
  }
  if (!days_seen) {
    assume_a_day(noise);
    seek_untold_days(recording, conditions, adjusted, stop, noise);
  }
  return noise;
}

void share_day_offsets(std::vector<ChannelNoise>& noise) {
  for (std::size_t c = 0; c < noise.size(); ++c) {
    ChannelNoise& one = noise[c];
    if (one.day_log_likelihood.empty()) continue;
    const double ratio_squared = day_ratio_squared(noise, c);
    if (one.day_assumed) {
      const auto days = static_cast<double>(one.untold_days);
      one.day_offset = std::hypot(one.day_offset, one.constant * std::sqrt(ratio_squared / days));
    } else {
      one.day_offset = one.constant * std::sqrt(ratio_squared);
    }
  }
}

Eigen::MatrixXd noise_correlation(const std::vector<ChannelNoise>& noise,
                                  const std::vector<Condition>& conditions,
                                  const std::vector<std::vector<double>>& adjusted) {
  const auto n = static_cast<Eigen::Index>(noise.size());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, n);
  for (const Condition& condition : conditions) {
    std::vector<Eigen::VectorXd> rows;
    for (const std::size_t run : condition.runs) {
      Eigen::VectorXd row(n);
      bool whole = true;
      for (std::size_t c = 0; c < noise.size(); ++c) {
        row[static_cast<Eigen::Index>(c)] = adjusted[c][run];
        whole = whole && std::isfinite(adjusted[c][run]) && noise[c].weight[run] == 1;
      }
      if (whole) rows.push_back(row);
    }
    if (rows.size() < 2) continue;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(n), deviation(n);
    for (const Eigen::VectorXd& row : rows) mean += row / static_cast<double>(rows.size());
    for (Eigen::Index c = 0; c < n; ++c) {
      deviation[c] = run_deviation(noise[static_cast<std::size_t>(c)], mean[c]);
    }
    for (const Eigen::VectorXd& row : rows) {
      const Eigen::VectorXd z = ((row - mean).array() / deviation.array()).matrix();
      sums += z * z.transpose();
    }
  }
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(n, n);
  constexpr double kShrink = 10;  // as many runs without correlation
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      if (a != b) correlation(a, b) = sums(a, b) / (std::sqrt(sums(a, a) * sums(b, b)) + kShrink);
    }
  }
  return correlation;
}

}  // namespace regoplan
