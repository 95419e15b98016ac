#include "benchmarks/diagnosis/condition_means.h"

#include <cmath>
#include <numbers>

namespace regoplan::challenge {
namespace {

bool are_replicates(const WheelRun& a, const WheelRun& b) {
  constexpr double kSlip = 0.01, kAngle_rad = 0.5 * std::numbers::pi / 180, kLoad = 0.15;
  const WheelConditions &x = a.conditions, &y = b.conditions;
  return std::abs(a.slip_ratio - b.slip_ratio) <= kSlip &&
         std::abs(a.slip_angle_rad - b.slip_angle_rad) <= kAngle_rad &&
         std::abs(a.load_n - b.load_n) <= kLoad * a.load_n && x.pass == y.pass &&
         x.speed_mps == y.speed_mps && x.position_m == y.position_m && x.time_s == y.time_s;
}

}  // namespace

ConditionMeans condition_means(const Recording& recording, const DiagnosisSetup& setup) {
  std::vector<std::vector<const WheelRun*>> groups;
  for (const WheelRun& run : recording.runs) {
    bool placed = false;
    for (auto& group : groups) {
      if (!are_replicates(*group.front(), run)) continue;
      group.push_back(&run);
      placed = true;
      break;
    }
    if (!placed) groups.push_back({&run});
  }
  // the load's own effect within a group, from the model at the prior means
  std::vector<FitRow> runs;
  for (const auto& group : groups) {
    for (const WheelRun* run : group) {
      runs.push_back({.load_n = run->load_n,
                      .slip_ratio = run->slip_ratio,
                      .slip_angle_rad = run->slip_angle_rad,
                      .conditions = run->conditions,
                      .value = run->measured});
    }
  }
  const auto modelled = fit_soil(runs, setup, {}, {}, 0).fitted;

  ConditionMeans means;
  std::array<double, kChannelCount> squares{};
  std::size_t first = 0;
  for (const auto& group : groups) {
    const auto n = static_cast<double>(group.size());
    FitRow mean{.conditions = group.front()->conditions};
    for (const WheelRun* run : group) {
      mean.load_n += run->load_n / n;
      mean.slip_ratio += run->slip_ratio / n;
      mean.slip_angle_rad += run->slip_angle_rad / n;
      for (std::size_t c = 0; c < kChannelCount; ++c) mean.value[c] += run->measured[c] / n;
    }
    for (std::size_t c = 0; c < kChannelCount; ++c) {
      double modelled_mean = 0;
      for (std::size_t i = 0; i < group.size(); ++i) modelled_mean += modelled[first + i][c] / n;
      for (std::size_t i = 0; i < group.size(); ++i) {
        const double off =
            runs[first + i].value[c] - mean.value[c] - (modelled[first + i][c] - modelled_mean);
        if (!std::isnan(off)) squares[c] += off * off;
      }
      if (!std::isnan(mean.value[c])) means.noise_dof[c] += n - 1;
    }
    first += group.size();
    means.rows.push_back(mean);
    means.replicates.push_back(n);
  }
  for (std::size_t c = 0; c < kChannelCount; ++c) {
    const auto stated = setup.noise_standard_deviation.find(static_cast<Channel>(c));
    if (stated != setup.noise_standard_deviation.end()) {
      means.noise[c] = stated->second;
      means.noise_dof[c] = 200;
    } else {
      means.noise[c] = means.noise_dof[c] > 0 ? std::sqrt(squares[c] / means.noise_dof[c]) : 1;
    }
    for (std::size_t i = 0; i < means.rows.size(); ++i) {
      means.rows[i].sigma[c] = means.noise[c] / std::sqrt(means.replicates[i]);
    }
  }
  return means;
}

}  // namespace regoplan::challenge
