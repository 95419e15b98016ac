#include "benchmarks/diagnosis/baselines.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "benchmarks/diagnosis/condition_means.h"
#include "benchmarks/diagnosis/residual_models.h"

namespace regoplan::challenge {
namespace {

using Values = std::vector<std::array<double, kChannelCount>>;

constexpr double kSignificance = 0.01, kEvidence_nats = 3;

double whitened_squares(const FitRow& row, const std::array<double, kChannelCount>& fitted,
                        std::size_t c) {
  return std::pow((row.value[c] - fitted[c]) / row.sigma[c], 2);
}

int values_in(const std::vector<FitRow>& rows) {
  int count = 0;
  for (const FitRow& row : rows) {
    count +=
        static_cast<int>(std::ranges::count_if(row.value, [](double v) { return !std::isnan(v); }));
  }
  return count;
}

/// Which rows are left out together: a slip angle, or a band of slip.
std::vector<int> families(const std::vector<FitRow>& rows) {
  std::map<long, int> angles;
  std::vector<int> family;
  for (const FitRow& row : rows) {
    const long degrees = std::lround(std::abs(row.slip_angle_rad) * 180 / std::numbers::pi);
    family.push_back(angles.try_emplace(degrees, static_cast<int>(angles.size())).first->second);
  }
  if (angles.size() >= 3) return family;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    family[i] = std::clamp(static_cast<int>(std::floor((rows[i].slip_ratio + 1) * 5)), 0, 9);
  }
  return family;
}

/// Fits on some rows, predicts others.
using Method = std::function<Values(const std::vector<FitRow>&, const std::vector<FitRow>&)>;

/// Root mean square error over the noise of one run, on left-out families; NaN where not measured.
std::array<double, kChannelCount> held_out_ratio(const ConditionMeans& means,
                                                 const Method& method) {
  const std::vector<int> family = families(means.rows);
  std::array<double, kChannelCount> squares{}, count{};
  for (int left_out = 0; left_out <= *std::ranges::max_element(family); ++left_out) {
    std::vector<FitRow> kept, out;
    std::vector<double> replicates;
    for (std::size_t i = 0; i < family.size(); ++i) {
      if (family[i] != left_out) {
        kept.push_back(means.rows[i]);
      } else {
        out.push_back(means.rows[i]);
        replicates.push_back(means.replicates[i]);
      }
    }
    if (out.empty() || kept.empty()) continue;
    const Values predicted = method(kept, out);
    for (std::size_t i = 0; i < out.size(); ++i) {
      for (std::size_t c = 0; c < kChannelCount; ++c) {
        if (std::isnan(out[i].value[c]) || std::isnan(predicted[i][c])) continue;
        // of a mean, turned into that of its runs
        const double z2 = whitened_squares(out[i], predicted[i], c);
        squares[c] += replicates[i] * std::max(0.0, 1 + (z2 - 1) / replicates[i]);
        count[c] += replicates[i];
      }
    }
  }
  std::array<double, kChannelCount> ratio{};
  for (std::size_t c = 0; c < kChannelCount; ++c) ratio[c] = std::sqrt(squares[c] / count[c]);
  return ratio;
}

std::vector<OutcomeFit> fit_table(const ConditionMeans& means,
                                  const std::array<double, kChannelCount>& calibrated,
                                  const std::array<double, kChannelCount>& corrected) {
  std::vector<OutcomeFit> table;
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    if (std::isnan(calibrated[c])) continue;
    const double noise = means.noise[c];
    table.push_back({std::string(name(static_cast<Channel>(c))), noise, noise * calibrated[c],
                     noise * corrected[c]});
  }
  return table;
}

/// Adds to the calibrated model what a residual model learned in every channel.
struct ResidualStudy {
  Values predicted;
  double gain_nats = 0;
  int terms = 0;
};

using ResidualModel = ResidualPrediction (*)(const ResidualSample&, const std::vector<FitRow>&);

ResidualStudy with_residuals(const std::vector<FitRow>& rows, const std::vector<FitRow>& where,
                             const DiagnosisSetup& setup, const SoilFit& fit, ResidualModel model) {
  ResidualStudy study{.predicted = model_values(where, setup, {}, fit.x)};
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    ResidualSample sample{.odd = c == static_cast<std::size_t>(Channel::kFy)};
    std::vector<double> value, sigma;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double off = rows[i].value[c] - fit.fitted[i][c];
      if (std::isnan(off)) continue;
      sample.at.push_back(rows[i]);
      value.push_back(off);
      sigma.push_back(rows[i].sigma[c]);
    }
    if (value.empty()) continue;
    const auto n = static_cast<Eigen::Index>(value.size());
    sample.value = Eigen::Map<Eigen::VectorXd>(value.data(), n);
    sample.sigma = Eigen::Map<Eigen::VectorXd>(sigma.data(), n);
    const ResidualPrediction learned = model(sample, where);
    study.gain_nats = std::max(study.gain_nats, learned.gain_nats);
    study.terms += learned.terms;
    for (std::size_t i = 0; i < where.size(); ++i) {
      study.predicted[i][c] += learned.value[static_cast<Eigen::Index>(i)];
    }
  }
  return study;
}

bool lacks_fit(const ConditionMeans& means, const SoilFit& fit) {
  double noise_dof = 0;
  for (std::size_t c = 0; c < kChannelCount; ++c) noise_dof += means.noise_dof[c];
  // every soil number brings its prior as one more value: as many degrees of freedom as values
  const int dof = values_in(means.rows);
  const double f = (fit.chi2 + fit.penalty) / dof;
  if (!std::isfinite(f)) return true;
  const boost::math::fisher_f_distribution<double> law(dof, std::max(noise_dof, 1.0));
  return boost::math::cdf(boost::math::complement(law, f)) < kSignificance;
}

struct BicChoice {
  const MechanismForm* form = nullptr;
  SoilFit fit;
  double probability = 0;
};

/// The columns a mechanism acts on stand in the recording.
bool can_bear(const MechanismForm& form, const RecordedColumns& columns) {
  if (form.id == "multi_pass") return columns.pass;
  if (form.id == "rate_dependence") return columns.speed;
  if (form.id == "soil_zone") return columns.position;
  if (form.id == "cohesion_drift" || form.form == "drifting") return columns.time;
  return true;
}

BicChoice lowest_bic(const ConditionMeans& means, const Recording& recording,
                     const DiagnosisSetup& setup, const SoilFit& base) {
  const double n = values_in(means.rows);
  std::map<std::string, double> by_id{{"", base.chi2 + base.penalty}};
  BicChoice best{.fit = base};
  double lowest = base.chi2 + base.penalty;
  for (const MechanismForm& form : mechanism_forms()) {
    if (!can_bear(form, recording.columns)) continue;
    const SoilFit fit = fit_soil(means.rows, setup, {&form}, base.x, 5);
    const double bic =
        fit.chi2 + fit.penalty + static_cast<double>(form.parameters.size() + 1) * std::log(n);
    if (!std::isfinite(bic)) continue;
    auto& of_id = by_id.try_emplace(std::string(form.id), bic).first->second;
    of_id = std::min(of_id, bic);
    if (bic < lowest) {
      lowest = bic;
      best = {.form = &form, .fit = fit};
    }
  }
  double sum = 0;
  for (const auto& entry : by_id) sum += std::exp((lowest - entry.second) / 2);
  best.probability = 1 / sum;
  return best;
}

}  // namespace

std::vector<Outcome> baseline_outcomes(const Recording& recording, const DiagnosisSetup& setup) {
  const ConditionMeans means = condition_means(recording, setup);
  const SoilFit base = fit_soil(means.rows, setup);
  const Method calibration = [&](const auto& kept, const auto& out) {
    return model_values(out, setup, {}, fit_soil(kept, setup, {}, base.x, 4).x);
  };
  const auto calibrated = held_out_ratio(means, calibration);
  const auto outcome = [&](std::string method, bool found,
                           const std::array<double, kChannelCount>& corrected) {
    return Outcome{.method = std::move(method),
                   .verdict = found ? "unexplained" : "parameters",
                   .fit = fit_table(means, calibrated, corrected),
                   .rows = recording.runs.size()};
  };

  std::vector<Outcome> all{outcome("calibration_only", lacks_fit(means, base), calibrated)};

  const BicChoice chosen = lowest_bic(means, recording, setup, base);
  const Method named = [&](const auto& kept, const auto& out) {
    const FittedMechanism mechanism{chosen.form};
    return model_values(out, setup, mechanism, fit_soil(kept, setup, mechanism, chosen.fit.x, 4).x);
  };
  all.push_back(outcome("bic", false, chosen.form ? held_out_ratio(means, named) : calibrated));
  if (chosen.form) {
    all.back().verdict = "named";
    all.back().claims = {{{std::string(chosen.form->id)}, chosen.probability}};
  }

  const auto residual_method = [&](ResidualModel model) {
    return Method([&setup, &base, model](const auto& kept, const auto& out) {
      const SoilFit fit = fit_soil(kept, setup, {}, base.x, 4);
      return with_residuals(kept, out, setup, fit, model).predicted;
    });
  };
  const ResidualStudy gp = with_residuals(means.rows, {}, setup, base, gaussian_process);
  all.push_back(outcome("residual_gp", gp.gain_nats > kEvidence_nats,
                        held_out_ratio(means, residual_method(gaussian_process))));
  const ResidualStudy sparse = with_residuals(means.rows, {}, setup, base, sparse_regression);
  all.push_back(outcome("sparse_regression", sparse.terms > 0,
                        held_out_ratio(means, residual_method(sparse_regression))));
  return all;
}

}  // namespace regoplan::challenge
