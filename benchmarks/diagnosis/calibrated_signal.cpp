#include "benchmarks/diagnosis/calibrated_signal.h"

#include <cmath>

#include "benchmarks/diagnosis/soil_fit.h"

namespace regoplan::challenge {
namespace {

std::optional<std::vector<FitRow>> noise_free_rows(const Rig& rig, const MeasurementNoise& noise,
                                                   const std::vector<DrawnEffect>& effects,
                                                   const std::vector<InstrumentFault>& faults) {
  // Replicates that share their time are alike, so that their mean stands for them.
  const int apart = rig.own_times ? rig.replicates : 1;
  const double alike = static_cast<double>(rig.replicates) / apart;
  std::vector<FitRow> rows;
  for (int k = 0; k < apart; ++k) {
    for (const RigCondition& condition : rig.conditions) {
      const auto values = ideal_values(rig, rig.at_run(condition, k, rows.size()), effects, faults);
      if (!values) return std::nullopt;
      FitRow row{.load_n = condition.load_n,
                 .slip_ratio = condition.slip_ratio,
                 .slip_angle_rad = condition.slip_angle_rad,
                 .value = *values};
      for (std::size_t c = 0; c < kChannelCount; ++c) {
        row.sigma[c] = noise_sigma(noise, static_cast<Channel>(c), (*values)[c]) / std::sqrt(alike);
      }
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace

std::optional<Signal> signal_of(const Rig& rig, const MeasurementNoise& noise,
                                const std::vector<DrawnEffect>& effects,
                                const std::vector<InstrumentFault>& faults) {
  const auto rows = noise_free_rows(rig, noise, effects, faults);
  if (!rows) return std::nullopt;
  const SoilFit at_mean = fit_soil(*rows, rig.setup, {}, {}, 0);
  const SoilFit calibrated = fit_soil(*rows, rig.setup);
  return Signal{std::sqrt(at_mean.chi2), std::sqrt(calibrated.chi2)};
}

std::optional<double> share_of_signal(const Rig& rig, const MeasurementNoise& noise,
                                      const DrawnEffect& effect,
                                      const std::vector<DrawnEffect>& others) {
  std::vector<DrawnEffect> all = others;
  all.push_back(effect);
  auto rows = noise_free_rows(rig, noise, all, {});
  const auto without = noise_free_rows(rig, noise, others, {});
  const auto base = noise_free_rows(rig, noise, {}, {});
  if (!rows || !without || !base) return std::nullopt;
  // what the effect adds, on the base model
  for (std::size_t i = 0; i < rows->size(); ++i) {
    for (std::size_t c = 0; c < kChannelCount; ++c) {
      (*rows)[i].value[c] += (*base)[i].value[c] - (*without)[i].value[c];
    }
  }
  return std::sqrt(fit_soil(*rows, rig.setup).chi2);
}

}  // namespace regoplan::challenge
