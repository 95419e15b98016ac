// Where a claim is said to act, against what the truth adds there.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "diagnosis/diagnosis.h"
#include "synthetic_bed.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

bool lies_in(const std::map<std::string, std::array<double, 2>>& region, const WheelRun& run) {
  constexpr double kRounding = 1e-3;  // of the recorded conditions
  const auto within = [&](const char* column, double value) {
    const auto found = region.find(column);
    return found == region.end() || (value >= found->second[0] * (1 - kRounding) - kRounding &&
                                     value <= found->second[1] * (1 + kRounding) + kRounding);
  };
  const double angle_deg = run.slip_angle_rad / kDegree;
  return within("slip_ratio", run.slip_ratio) && within("load_n", run.load_n) &&
         within("slip_angle_deg", angle_deg) && within("abs_slip_angle_deg", std::abs(angle_deg));
}

struct Located {
  Diagnosis found;
  double truly_added = 0;  ///< mean over the runs of the first region, in its channel
};

Located located(const TrueWheel& truth, std::uint64_t seed) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(seed);
  const Soil soil = draw(setup.soil, setup.wheel.width_m, random);
  const Recording recording = record(truth, setup, soil, {}, seed);
  Located result{.found = diagnose(recording, setup)};
  if (result.found.where.empty()) return result;
  const MismatchRegion& at = result.found.where.front();
  const auto channel = static_cast<std::size_t>(at.channel);
  int runs = 0;
  for (const WheelRun& run : recording.runs) {
    if (!lies_in(at.region, run)) continue;
    result.truly_added += true_channels(truth, setup, soil, run).at(channel) -
                          true_channels({}, setup, soil, run).at(channel);
    ++runs;
  }
  result.truly_added /= std::max(runs, 1);
  return result;
}

/// Soil calibrated alone takes up a part of what a claim does, and is off by what is left of it.
void expect_whole_effect_is_told(const Located& located) {
  const Diagnosis& found = located.found;
  ASSERT_FALSE(found.claims.empty()) << found.sentence;
  ASSERT_EQ(found.where_off, WhereOff::kSoilBesideClaim) << found.sentence;
  const double told = found.where.front().effect / located.truly_added;
  EXPECT_GT(told, 0.7) << found.sentence << " truly " << located.truly_added;
  EXPECT_LT(told, 1.4) << found.sentence << " truly " << located.truly_added;
}

TEST(ClaimedLocation, TellsAllThatSlipDigs) {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 0.8 * (1 - std::exp(-2.5 * std::max(run.slip_ratio, 0.0))));
  };
  for (const std::uint64_t seed : {4, 5}) expect_whole_effect_is_told(located(wheel, seed));
}

TEST(ClaimedLocation, TellsAllThatAWheelAcrossItsWayDigs) {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 1.2 * std::pow(std::sin(std::abs(run.slip_angle_rad)), 0.8));
  };
  for (const std::uint64_t seed : {6, 7}) expect_whole_effect_is_told(located(wheel, seed));
}

}  // namespace
}  // namespace regoplan
