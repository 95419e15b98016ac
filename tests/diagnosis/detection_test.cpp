#include "diagnosis/checks/detection.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "diagnosis/bed/condition_axes.h"
#include "diagnosis/checks/location.h"
#include "diagnosis/fit/calibration.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

struct Calibrated {
  CondensedRecording recording;
  FitRemainder remainder;
};

Calibrated calibrated(const Recording& recording) {
  const DiagnosisSetup setup = simulant_setup();
  Calibrated made{condense(recording, setup), {}};
  const Calibration found = calibrate(made.recording.bed, soil_coordinates(setup.soil));
  made.remainder = {.residual = made.recording.bed.measured() - found.prediction,
                    .x = found.x,
                    .jacobian = found.jacobian};
  return made;
}

Recording recorded(const TrueWheel& truth, std::uint64_t seed, const BedPlan& plan = {}) {
  const DiagnosisSetup setup = simulant_setup();
  std::mt19937_64 random(seed);
  return record(truth, setup, draw(setup.soil, setup.wheel.width_m, random), plan, seed);
}

Calibrated calibrated(const TrueWheel& truth, std::uint64_t seed, const BedPlan& plan = {}) {
  return calibrated(recorded(truth, seed, plan));
}

TrueWheel deep_in_slip() {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h + 0.006 * std::max(run.slip_ratio, 0.0);
  };
  return wheel;
}

TEST(LackOfFit, StaysSilentOnNoiseWithDaysAndOutliers) {
  int rejected = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Calibrated made = calibrated({}, seed);
    const LackOfFit found = lack_of_fit(made.recording, made.remainder, seed);
    rejected += found.f > found.critical;
  }
  EXPECT_LE(rejected, 1);
}

TEST(LackOfFit, SeesSinkageThatGrowsWithSlip) {
  const Calibrated made = calibrated(deep_in_slip(), 3);
  const LackOfFit found = lack_of_fit(made.recording, made.remainder, 3);
  EXPECT_GT(found.f, found.critical);
  EXPECT_LT(found.p_value, 0.005);
}

/// What slip sinkage of a usual size would add to the calibrated model.
Direction along_slip(const Calibrated& made) {
  Direction direction{.values = Eigen::VectorXd(made.recording.bed.size())};
  const TestBed& bed = made.recording.bed;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    for (std::size_t i = 0; i < bed.channels[c].conditions.size(); ++i) {
      const double s = bed.conditions[bed.channels[c].conditions[i]].slip_ratio;
      direction.values[bed.offset(c) + static_cast<Eigen::Index>(i)] =
          bed.channels[c].channel == Channel::kSinkage ? 0.006 * std::max(s, 0.0) : 0.0;
    }
  }
  return direction;
}

TEST(Detection, AlongAnEffectNoiseStaysSilent) {
  int rejected = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Calibrated made = calibrated({}, 50 + seed);
    rejected += p_value_along(made.recording, made.remainder, {along_slip(made)}, seed) < 0.01;
  }
  EXPECT_LE(rejected, 1);
}

TEST(Detection, AlongAnEffectMoreIsSeenThanInTheWholeMisfit) {
  TrueWheel shallow;
  shallow.sinkage = [](const WheelRun& run, double h) {
    return h + 0.002 * std::max(run.slip_ratio, 0.0);
  };
  int along = 0, whole = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Calibrated made = calibrated(shallow, seed);
    along += p_value_along(made.recording, made.remainder, {along_slip(made)}, seed) < 0.005;
    whole += lack_of_fit(made.recording, made.remainder, seed).p_value < 0.005;
  }
  EXPECT_GE(along, 3);
  EXPECT_GT(along, whole);
}

/// Its residuals larger by the factor at which noise alone leaves as much with the probability `p`.
Calibrated left_by_noise_with(double p, Calibrated made, std::uint64_t seed) {
  const Eigen::VectorXd residual = made.remainder.residual;
  double low = 0.1, high = 10;
  for (int i = 0; i < 16; ++i) {
    const double factor = std::sqrt(low * high);
    made.remainder.residual = factor * residual;
    (lack_of_fit(made.recording, made.remainder, seed).p_value > p ? low : high) = factor;
  }
  return made;
}

TEST(LackOfFit, IsFoundWhereNoiseDoesAsMuchOnceInFiveHundredTimesAndNotOnceInAHundred) {
  const Calibrated made = calibrated({}, 4);
  for (const double p : {0.04, 0.02, 0.01}) {
    const Calibrated usual = left_by_noise_with(p, made, 9);
    const LackOfFit found = lack_of_fit(usual.recording, usual.remainder, 9);
    ASSERT_NEAR(found.p_value, p, 0.001);
    EXPECT_LT(found.f, found.critical) << "as much once in " << 1 / p;
  }
  for (const double p : {0.003, 0.002}) {
    const Calibrated rare = left_by_noise_with(p, made, 9);
    const LackOfFit found = lack_of_fit(rare.recording, rare.remainder, 9);
    ASSERT_NEAR(found.p_value, p, 0.001);
    EXPECT_GT(found.f, found.critical) << "as much once in " << 1 / p;
  }
}

TEST(LackOfFit, IsLikelierByNoiseWithHeavyTails) {
  const Calibrated made = left_by_noise_with(0.002, calibrated({}, 4), 9);
  const auto p_of = [&](NoiseTails tails) {
    return lack_of_fit(made.recording, made.remainder, 9, Thresholds::kBeyondDoubt_p, tails)
        .p_value;
  };
  EXPECT_GT(p_of(NoiseTails::kHeavy), 2 * p_of(NoiseTails::kNormal));
}

TEST(NoiseTails, AreHeavyWhereNoReplicatesTellOutliers) {
  BedPlan once;
  once.replicates = 1;
  EXPECT_EQ(tails_of(condense(recorded({}, 4), simulant_setup())), NoiseTails::kNormal);
  EXPECT_EQ(tails_of(condense(recorded({}, 4, once), simulant_setup())), NoiseTails::kHeavy);
}

TEST(LackOfFit, IsTheSameForTheSameSeed) {
  const Calibrated made = calibrated({}, 4);
  EXPECT_EQ(lack_of_fit(made.recording, made.remainder, 9).critical,
            lack_of_fit(made.recording, made.remainder, 9).critical);
}

TEST(Location, FindsTheChannelAndTheSlipAngles) {
  TrueWheel wheel;
  wheel.fy_n = [](const WheelRun& run, double) {
    return std::abs(run.slip_angle_rad) > 0.25 ? 6.0 : 0.0;
  };
  const Calibrated made = calibrated(wheel, 5);
  const auto found = locate(made.recording, made.remainder, 5);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().channel, Channel::kFy);
  ASSERT_TRUE(found.front().region.contains("slip_angle_deg"));
  EXPECT_GT(found.front().region.at("slip_angle_deg")[0], 12);
  EXPECT_GT(found.front().ci95[0], 0);
}

TEST(Location, ABedThatRemembersIsToldByTheRunBefore) {
  BedPlan plan;
  plan.instruments = [before = 0.0](WheelRun& run) mutable {
    if (before > 0.6) run.measured[0] -= 6;
    before = run.slip_ratio;
  };
  const Calibrated made = calibrated({}, 6, plan);
  const auto found = locate(made.recording, made.remainder, 6);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().channel, Channel::kFx);
  ASSERT_TRUE(found.front().region.contains("after_slip_ratio"));
  EXPECT_GT(found.front().region.at("after_slip_ratio")[0], 0.6);
  EXPECT_LT(found.front().effect, 0);
}

TEST(Location, WhereSlipRoseFromRunToRunTheRunItselfIsTold) {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return run.slip_ratio > 0.6 ? -6.0 : 0.0; };
  Recording recording = recorded(wheel, 7);
  // As sweeps go: each slip comes after the next lower one.
  std::ranges::stable_sort(recording.runs, [](const WheelRun& a, const WheelRun& b) {
    return std::tuple(a.day, a.slip_angle_rad, std::round(10 * a.slip_ratio)) <
           std::tuple(b.day, b.slip_angle_rad, std::round(10 * b.slip_ratio));
  });
  const Calibrated made = calibrated(recording);
  const auto found = locate(made.recording, made.remainder, 7);
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(found.front().region.contains("slip_ratio"));
  EXPECT_FALSE(found.front().region.contains("after_slip_ratio"));
}

TEST(Location, WhereEachSlipAlwaysFollowsTheSameSlipTheRunItselfIsTold) {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) {
    return run.slip_ratio > 0.6 || run.slip_ratio < -0.2 ? -6.0 : 0.0;
  };
  BedPlan plan;
  plan.conditions = 72;
  Recording recording = record(wheel, simulant_setup(), simulant_setup().soil.mean, plan, 8);
  // The slips that are off come after .3 and .5, always and alone: one box of the run before, but
  // two of the run itself.
  const auto place = [](const WheelRun& run) {
    static const std::vector<double> order{0.3, -0.3, 0.5, 0.8, 0, 0.15};
    return std::ranges::find_if(
               order, [&](double slip) { return std::abs(run.slip_ratio - slip) < 0.02; }) -
           order.begin();
  };
  std::ranges::stable_sort(recording.runs, {}, [&](const WheelRun& run) {
    return std::tuple(run.day, run.slip_angle_rad, std::round(run.load_n / 25), place(run));
  });
  const Calibrated made = calibrated(recording);
  const auto found = locate(made.recording, made.remainder, 8);
  ASSERT_FALSE(found.empty());
  EXPECT_FALSE(found.front().region.contains("after_slip_ratio"));
}

TEST(Location, ReplicatesThatFollowedDifferentSlipsAreNoPlaceBehindARun) {
  Recording recording;
  for (const double slip : {0.1, 0.5, 0.3, 0.5}) {
    WheelRun& run = recording.runs.emplace_back();
    run.run_id = fmt::format("{}", recording.runs.size());
    run.load_n = 40;
    run.slip_ratio = slip;
  }
  // Runs at .5 came after .1 and after .3: at .2 in the mean, which nothing came after.
  const std::vector<Condition> groups = group_conditions(recording, {0, 1, 2, 3});
  ASSERT_EQ(groups.size(), 3u);
  for (const Condition& group : groups) {
    EXPECT_EQ(follows_one_slip(group), group.slip_ratio < 0.4) << group.slip_ratio;
  }
}

TEST(Location, IsSilentWhereNothingDiffers) {
  int shown = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Calibrated made = calibrated({}, 100 + seed);
    shown += !locate(made.recording, made.remainder, seed).empty();
  }
  EXPECT_LE(shown, 2);
}

}  // namespace
}  // namespace regoplan
