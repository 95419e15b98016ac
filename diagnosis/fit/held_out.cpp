#include "diagnosis/fit/held_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/bed/condition_axes.h"
#include "diagnosis/fit/carried_surface.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

constexpr std::size_t kFewestFamilies = 3, kMostBands = 6;

/// The conditions outside one family.
TestBed without(const TestBed& bed, const Families& families, std::size_t family) {
  TestBed rest{
      .setup = bed.setup, .base_model = bed.base_model, .accuracy = bed.accuracy, .stop = bed.stop};
  std::vector<std::size_t> new_index(bed.conditions.size());
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) {
    new_index[k] = rest.conditions.size();
    if (families.of_condition[k] != family) rest.conditions.push_back(bed.conditions[k]);
  }
  for (const ChannelData& data : bed.channels) {
    ChannelData& kept = rest.channels.emplace_back();
    kept.channel = data.channel;
    kept.scale = data.scale;
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      if (families.of_condition[data.conditions[i]] == family) continue;
      rows.push_back(static_cast<Eigen::Index>(i));
      kept.conditions.push_back(new_index[data.conditions[i]]);
    }
    kept.mean = data.mean(rows);
    if (data.shared.size() > 0) kept.shared = data.shared(rows);
    kept.noise = data.noise(rows, rows);
  }
  return rest;
}

struct Prediction {
  Eigen::VectorXd calibrated, named, remainder, variance;  // of the whole bed
  Eigen::MatrixXd spread;  // of the named: its columns' products are the covariance
};

/// Mean and variance of the discrepancy at all conditions, given what the rest left.
void add_remainder(const TestBed& bed, const TestBed& rest, const Discrepancy& discrepancy,
                   const Eigen::VectorXd& left, const std::vector<std::size_t>& settings,
                   Prediction& prediction) {
  const CarriedAt carried = CarriedAt::of(bed);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    if (discrepancy_settings()[settings[c]].amplitude == 0) continue;
    const ChannelData& all = bed.channels[c];
    const CarriedSurface surface(rest, c, settings[c], discrepancy,
                                 left.segment(rest.offset(c), rest.channels[c].mean.size()),
                                 carried);
    const auto [mean, variance] = surface.at(conditions_of(bed, all));
    prediction.remainder.segment(bed.offset(c), all.mean.size()) = mean;
    prediction.variance.segment(bed.offset(c), all.mean.size()) += variance;
  }
}

/// At most; most fits need two or three. What stops early predicts what is held out by itself.
constexpr int kSteps = 12;

/// A fit of the rest that begins where all conditions led. Where no step leads on from there it
/// begins anew with the soil that the rest tells.
std::optional<CandidateFit> fitted_to_rest(const FitProblem& as_told, const CandidateFit& whole,
                                           const CandidateFit* calibrated) {
  std::optional<TestBed> wide;
  std::optional<Discrepancy> of_wide;
  if (!whole.widened.empty()) {
    wide = with_noise_widened(as_told.bed, whole.widened);
    of_wide.emplace(*wide);
  }
  const FitProblem problem =
      wide ? FitProblem{*wide, as_told.soil, *of_wide, as_told.soil_free} : as_told;
  const auto from = [&](const Eigen::VectorXd& start) {
    return fit_under(problem, whole.candidate, whole.evidence.settings, start, kSteps,
                     whole.shape_spread);
  };
  auto fit = from(whole.x);
  if (calibrated == nullptr || (fit && fit->x != whole.x)) return fit;
  return from(start_of(problem, whole.candidate, calibrated));
}

Prediction predict_without(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                           const Families& families, std::size_t family, const CandidateFit& base,
                           const CorrectedModel& corrected) {
  const TestBed rest = without(bed, families, family);
  const Discrepancy discrepancy(rest);
  const Eigen::MatrixXd free(rest.size(), 0);
  const FitProblem problem{rest, soil, discrepancy, free};
  const std::vector<std::size_t> noise_only(bed.channels.size(), 0);
  Prediction prediction{.calibrated = base.prediction,
                        .remainder = Eigen::VectorXd::Zero(bed.size()),
                        .variance = Eigen::VectorXd::Zero(bed.size())};
  const auto calibrated = fit_under(problem, {}, noise_only, base.x, kSteps, 0);
  if (calibrated) {
    if (const auto all = predict(bed, soil, {}, calibrated->x)) prediction.calibrated = *all;
  }
  prediction.named = prediction.calibrated;
  std::optional<CandidateFit> named = calibrated;
  if (corrected.fit != nullptr) {
    named = fitted_to_rest(problem, *corrected.fit, calibrated ? &*calibrated : nullptr);
    prediction.named = corrected.fit->prediction;
    if (named) {
      if (const auto all = predict(bed, soil, corrected.fit->candidate, named->x)) {
        prediction.named = *all;
      }
    }
  }
  if (named) {
    const Posterior posterior =
        posterior_of(rest, discrepancy,
                     {.residual = rest.measured() - named->prediction, .jacobian = named->jacobian},
                     corrected.fit != nullptr ? corrected.fit->evidence.settings : noise_only);
    const Eigen::MatrixXd& j = corrected.fit != nullptr ? corrected.fit->jacobian : base.jacobian;
    prediction.spread = posterior.precision.llt().matrixL().solve(j.transpose());
    prediction.variance = prediction.spread.colwise().squaredNorm().transpose();
    if (!corrected.remainder.empty()) {
      add_remainder(bed, rest, discrepancy, rest.measured() - named->prediction,
                    corrected.remainder, prediction);
    }
  }
  return prediction;
}

Families by_axis(const TestBed& bed, const std::string& column) {
  for (const ConditionAxis& axis : condition_axes(bed)) {
    if (axis.column != column && axis.column != "abs_" + column) continue;
    return {.by = column, .of_condition = axis.level, .count = axis.levels};
  }
  return {};
}

/// Where every condition was run on one day only: else its own day would predict it.
Families by_day(const TestBed& bed) {
  Families days{.by = "day"};
  std::map<double, std::size_t> family;
  for (const Condition& at : bed.conditions) {
    if (!at.one_day) return {};
    days.of_condition.push_back(family.try_emplace(at.day, family.size()).first->second);
  }
  days.count = family.size();
  return days.count <= 2 * kMostBands ? days : Families{};
}

Families merged(Families families, std::size_t most) {
  if (families.count <= most) return families;
  for (std::size_t& family : families.of_condition) family = family * most / families.count;
  families.count = most;
  return families;
}

/// Appends the families of one column where there are enough of them.
void add_bands(const TestBed& bed, const std::string& column, const std::string& by,
               std::size_t most, std::vector<Families>& all) {
  Families families = merged(by_axis(bed, column), most);
  families.by = by;
  if (families.count >= kFewestFamilies) all.push_back(std::move(families));
}

/// By how much one prediction's misfit falls below another's, and what noise makes of it.
struct Fall {
  double misfit = 0, spread = 0;
  double in_errors() const { return misfit / (2 * std::sqrt(std::max(spread, 1e-12))); }
};

/// The offsets of days move many conditions at once: the noise of a fall is that of all together.
Fall fall_of(const TestBed& bed, std::size_t channel, const Eigen::VectorXd& better,
             const Eigen::VectorXd& worse) {
  const ChannelData& data = bed.channels[channel];
  const Eigen::Index from = bed.offset(channel), n = data.mean.size();
  const Eigen::LLT<Eigen::MatrixXd> noise(data.noise);
  const auto white = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    return noise.matrixL().solve(values);
  };
  const Eigen::VectorXd off = white(data.mean - better.segment(from, n)),
                        apart = white(better.segment(from, n) - worse.segment(from, n));
  return {.misfit = (off + apart).squaredNorm() - off.squaredNorm(), .spread = apart.squaredNorm()};
}

/// \param folds one a family
ExpectedExcess expected_excess(const TestBed& bed, const Families& families,
                               const std::vector<Prediction>& folds) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(bed.size(), bed.size());
  std::vector<std::vector<Eigen::Index>> rows(families.count);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    const Eigen::Index from = bed.offset(c), n = data.mean.size();
    covariance.block(from, from, n, n) = data.noise;
    for (Eigen::Index i = 0; i < n; ++i) {
      rows[families.of_condition[data.conditions[static_cast<std::size_t>(i)]]].push_back(from + i);
    }
  }
  const Eigen::VectorXd noise = covariance.diagonal();
  for (std::size_t family = 0; family < families.count; ++family) {
    if (folds[family].spread.size() == 0) continue;
    const Eigen::MatrixXd spread = folds[family].spread(Eigen::all, rows[family]);
    covariance(rows[family], rows[family]) += spread.transpose() * spread;
  }
  const Eigen::VectorXd per_noise = noise.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd white = per_noise.asDiagonal() * covariance * per_noise.asDiagonal();
  return {.mean = white.trace() - static_cast<double>(bed.size()),
          .standard_deviation = std::sqrt(2.0) * white.norm()};
}

}  // namespace

std::vector<Families> all_families(const TestBed& bed) {
  std::vector<Families> all;
  add_bands(bed, "slip_angle_deg", "slip angle", 2 * kMostBands, all);
  add_bands(bed, "slip_ratio", "slip band", kMostBands, all);
  add_bands(bed, "load_n", "load band", kMostBands, all);
  if (Families days = by_day(bed); days.count >= kFewestFamilies) all.push_back(std::move(days));
  if (all.empty()) all.push_back(families_of(bed));
  return all;
}

std::vector<Families> families_of_all_columns(const TestBed& bed) {
  std::vector<Families> all = all_families(bed);
  add_bands(bed, "speed_mps", "speed", kMostBands, all);
  add_bands(bed, "pass", "pass", kMostBands, all);
  add_bands(bed, "position_m", "stretch", kMostBands, all);
  return all;
}

Families families_of(const TestBed& bed) {
  Families angles = merged(by_axis(bed, "slip_angle_deg"), 2 * kMostBands);
  angles.by = "slip angle";
  if (angles.count > kFewestFamilies) return angles;
  Families slips = merged(by_axis(bed, "slip_ratio"), kMostBands);
  slips.by = "slip band";
  Families loads = merged(by_axis(bed, "load_n"), kMostBands);
  loads.by = "load band";
  Families best = slips;
  if (angles.count >= kFewestFamilies && angles.count >= best.count) best = angles;
  if (best.count < kFewestFamilies && loads.count > best.count) best = loads;
  if (best.count >= 2) return best;
  // nothing varies in levels: every fourth condition
  Families rest{.by = "every fourth condition", .count = 4};
  for (std::size_t k = 0; k < bed.conditions.size(); ++k) rest.of_condition.push_back(k % 4);
  return rest;
}

HeldOut hold_out(const CondensedRecording& recording, const std::vector<SoilCoordinate>& soil,
                 const CandidateFit& base, const CorrectedModel& corrected,
                 const Families& families, int threads) {
  const TestBed& bed = recording.bed;
  HeldOut result{.families = families};
  std::vector<Prediction> folds(result.families.count);
  parallel_for(folds.size(), threads, [&](std::size_t family) {
    folds[family] = predict_without(bed, soil, result.families, family, base, corrected);
  });
  const Eigen::VectorXd prior_means = *predict(bed, soil, {}, Eigen::VectorXd::Zero(base.x.size()));
  const Eigen::VectorXd measured = bed.measured();
  result.calibrated.resize(bed.size());
  result.corrected.resize(bed.size());
  result.corrected_deviation.resize(bed.size());
  Eigen::VectorXd remainder(bed.size());
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    double along = 0, square = 0;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const Eigen::Index row = bed.offset(c) + static_cast<Eigen::Index>(i);
      const Prediction& fold = folds[result.families.of_condition[data.conditions[i]]];
      result.calibrated[row] = fold.calibrated[row];
      result.corrected[row] = fold.named[row];
      remainder[row] = fold.remainder[row];
      result.corrected_deviation[row] = std::sqrt(fold.variance[row]);
      const double weight =
          1 / data.noise(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
      along += weight * remainder[row] * (measured[row] - fold.named[row]);
      square += weight * remainder[row] * remainder[row];
    }
    const double share = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
    result.remainder_share.push_back(share);
    const Eigen::Index from = bed.offset(c), n = data.mean.size();
    result.corrected.segment(from, n) += share * remainder.segment(from, n);
  }
  // rows against predictions: what a run would see
  double chi2_calibrated = 0, chi2_corrected = 0;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    const ChannelNoise& noise = recording.noise[c];
    ChannelFit fit{.channel = data.channel};
    double rows = 0;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const Eigen::Index row = bed.offset(c) + static_cast<Eigen::Index>(i);
      const double variance =
          data.noise(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i));
      const double before = std::pow(measured[row] - result.calibrated[row], 2) / variance;
      const double after = std::pow(measured[row] - result.corrected[row], 2) / variance;
      chi2_calibrated += before;
      chi2_corrected += after;
      for (const std::size_t run : bed.conditions[data.conditions[i]].runs) {
        const double y = recording.adjusted[c][run];
        if (!std::isfinite(y) || noise.weight[run] < 0.5) continue;
        ++rows;
        fit.noise_floor += std::pow(run_deviation(noise, y), 2) + std::pow(noise.day_offset, 2) +
                           std::pow(noise.day_gain * y, 2);
        fit.baseline_rmse += std::pow(y - prior_means[row], 2);
        fit.calibrated_rmse += std::pow(y - result.calibrated[row], 2);
        fit.corrected_rmse += std::pow(y - result.corrected[row], 2);
      }
    }
    for (double* value :
         {&fit.noise_floor, &fit.baseline_rmse, &fit.calibrated_rmse, &fit.corrected_rmse}) {
      *value = std::sqrt(*value / std::max(rows, 1.0));
    }
    result.fit.push_back(fit);
  }
  const auto dof = static_cast<double>(bed.size());
  const double excess = chi2_calibrated - dof;
  result.share_explained = excess > 0 ? 1 - (chi2_corrected - dof) / excess : 0;
  result.excess = excess;
  result.expected = expected_excess(bed, families, folds);
  return result;
}

double gain_in_errors(const TestBed& bed, const Eigen::VectorXd& better,
                      const Eigen::VectorXd& worse, double prior_gain) {
  Fall whole{prior_gain, prior_gain};
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const Fall fall = fall_of(bed, c, better, worse);
    whole.misfit += fall.misfit;
    whole.spread += fall.spread;
  }
  return whole.in_errors();
}

double gain_in_errors(const TestBed& bed, std::size_t channel, const Eigen::VectorXd& better,
                      const Eigen::VectorXd& worse) {
  return fall_of(bed, channel, better, worse).in_errors();
}

std::optional<ChannelLoss> clear_loss(const TestBed& bed, const Eigen::VectorXd& prediction,
                                      const Eigen::VectorXd& than) {
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const double errors = gain_in_errors(bed, c, than, prediction);
    if (errors > Thresholds::kClear_errors) return ChannelLoss{bed.channels[c].channel, errors};
  }
  return std::nullopt;
}

std::string no_better_than(const Eigen::VectorXd& plain, const TestBed& bed, const HeldOut& proof) {
  if (const auto loss = clear_loss(bed, proof.corrected, plain)) {
    return fmt::format("held out by {}, it predicts {} worse by {:.1f} standard errors",
                       proof.families.by, name(loss->channel), loss->errors);
  }
  const double gain = gain_in_errors(bed, proof.corrected, plain);
  if (gain > Thresholds::kClear_errors) return "";
  return fmt::format("held out by {}, it gains {:.1f} standard errors, and {:.0f} are asked for",
                     proof.families.by, gain, Thresholds::kClear_errors);
}

bool has_clear_excess(const TestBed& bed, const HeldOut& held_out) {
  return held_out.excess >
         Thresholds::kClear_errors * std::sqrt(2.0 * static_cast<double>(bed.size()));
}

HeldOut best_hold_out(const CondensedRecording& recording, const std::vector<SoilCoordinate>& soil,
                      const CandidateFit& base, const CorrectedModel& corrected, int threads) {
  const auto rank = [&](const HeldOut& out) {
    return std::pair(has_clear_excess(recording.bed, out), out.share_explained);
  };
  std::optional<HeldOut> best;
  for (const Families& families : all_families(recording.bed)) {
    HeldOut out = hold_out(recording, soil, base, corrected, families, threads);
    if (!best || rank(out) > rank(*best)) best = std::move(out);
  }
  return *best;
}

}  // namespace regoplan
