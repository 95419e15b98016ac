// A name is claimed only where held-out conditions bear it.
#include "diagnosis/names/name_contest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "diagnosis/fit/effect_list.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

/// Two ids scored against the plain models, the soil calibrated.
class NameContestOf : public testing::Test {
 protected:
  void hold(
      const TrueWheel& truth, const BedPlan& plan = {.conditions = 24},
      const std::set<std::string>& ids = {"slip_sinkage", "shear_hump"},
      const std::function<bool(const Effect&)>& is_left_out = [](const Effect&) { return false; }) {
    setup_ = simulant_setup();
    recording_ = record(truth, setup_, setup_.soil.mean, plan, 5);
    recording_.columns.time = std::ranges::any_of(
        recording_.runs, [](const WheelRun& run) { return run.conditions.time_s > 0; });
    calibrated_ = std::make_unique<CalibratedRecording>(recording_, setup_);
    std::vector<Effect> effects = effects_for(calibrated_->bed(), recording_);
    std::erase_if(effects, [&](const Effect& e) { return !ids.contains(e.id) || is_left_out(e); });
    scored_ = score_candidates(calibrated_->problem(), calibrated_->wide_problem(), effects, {});
  }

  static TrueWheel digging() {
    TrueWheel wheel;
    wheel.sinkage = [](const WheelRun& run, double h) {
      return h * (1 + 1.2 * (1 - std::exp(-2 * std::max(run.slip_ratio, 0.0))));
    };
    return wheel;
  }

  DiagnosisSetup setup_;
  Recording recording_;
  std::unique_ptr<CalibratedRecording> calibrated_;
  std::vector<ScoredId> scored_;
};

TEST_F(NameContestOf, AnEffectThatIsAtWorkIsClaimedWithItsProof) {
  hold(digging());
  weigh(scored_, PlainModel::kRefuted);
  NameContest contest(*calibrated_, scored_, PlainModel::kRefuted, 1, 1);
  const auto claim = contest.decide();
  ASSERT_TRUE(claim);
  ASSERT_FALSE(claim->names.empty());
  EXPECT_EQ(claim->names.front().ids.front(), "slip_sinkage");
  EXPECT_GT(claim->proof.share_explained, 1.0 / 3.0);
}

TEST_F(NameContestOf, ANameThatLeavesWhatIsWorthACorrectionIsHalfAsLikely) {
  // in a form that is not carried: what it leaves stands out of so little noise
  hold(digging(), {.conditions = 24}, {"slip_sinkage", "shear_hump"},
       [](const Effect& effect) { return effect.form == "power"; });
  weigh(scored_, PlainModel::kRefuted);
  NameContest contest(*calibrated_, scored_, PlainModel::kRefuted, 1, 1);
  const auto claim = contest.decide();
  ASSERT_TRUE(claim);
  EXPECT_NEAR(claim->names.front().probability, 0.5, 0.01);
  double sum = 0;
  for (const ScoredId& one : contest.scored()) sum += one.probability;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_NEAR(scored_as(Account::Kind::kUnexplained, contest.scored()).probability, 0.5, 0.01);
}

TEST_F(NameContestOf, AFaultThatIsKnownExactlyIsNotClaimedWhereItLeavesWhatIsWorthACorrection) {
  // What turns side force into traction comes and goes as the wheel slips: no crosstalk does.
  BedPlan plan{.conditions = 24, .noise = 3};
  plan.instruments = [](WheelRun& run) {
    run.measured[0] += 0.2 * run.measured[1] * (1 + std::sin(9 * run.slip_ratio));
  };
  hold({}, plan, {"sensor_crosstalk"});
  weigh(scored_, PlainModel::kRefuted);
  NameContest contest(*calibrated_, scored_, PlainModel::kRefuted, 1, 1);
  EXPECT_FALSE(contest.decide());
  ASSERT_FALSE(contest.notes().empty());
  EXPECT_NE(contest.notes().back().find("known exactly, and leaves"), std::string::npos)
      << contest.notes().back();
}

TEST_F(NameContestOf, NoInstrumentIsBlamedBesideMisfitThatNoRemainderTakes) {
  // Traction comes and goes three times in the series: no amplifier that drifts or settles does.
  BedPlan plan{.conditions = 24};
  plan.instruments = [time_s = 0.0](WheelRun& run) mutable {
    constexpr double kRun_s = 120, kPeriod_s = 24 * kRun_s;
    run.conditions.time_s = time_s;
    run.day = 0;
    run.measured[0] *= 1.2 + 0.5 * std::sin(2 * M_PI * time_s / kPeriod_s);
    time_s += kRun_s;
  };
  hold({}, plan, {"sensor_gain"}, has_one_form);
  for (ScoredId& one : scored_) {
    if (one.id() == "sensor_gain") one.score += 1e4;
  }
  weigh(scored_, PlainModel::kRefuted);
  ASSERT_EQ(scored_.front().id(), "sensor_gain");
  NameContest contest(*calibrated_, scored_, PlainModel::kRefuted, 1, 1);
  EXPECT_FALSE(contest.decide());
  ASSERT_FALSE(contest.notes().empty());
  EXPECT_NE(contest.notes().back().find("blames an instrument"), std::string::npos)
      << contest.notes().back();
}

TEST_F(NameContestOf, BesideANameThatWasGivenUpASecondMustDoItsPartAsWell) {
  // Only the hump whose modulus is free is kept: it spoils what is held out.
  hold(digging(), {.conditions = 24}, {"slip_sinkage", "shear_hump"},
       [](const Effect& effect) { return effect.form == "softening"; });
  for (ScoredId& one : scored_) {
    if (one.id() == "slip_sinkage") one.given_up = true;
    if (one.account.effects.size() == 2) one.score += 500;
  }
  weigh(scored_, PlainModel::kRefuted);
  ASSERT_EQ(scored_.front().id(), "shear_hump+slip_sinkage");
  NameContest contest(*calibrated_, scored_, PlainModel::kRefuted, 1, 1);
  const auto claim = contest.decide();
  ASSERT_FALSE(contest.notes().empty());
  EXPECT_NE(contest.notes().front().find("shear_hump adds"), std::string::npos)
      << contest.notes().front();
  EXPECT_TRUE(!claim || claim->names.size() == 1);
}

TEST_F(NameContestOf, ASecondNameMustGainMoreThanTheFormOfTheFirstMayLeave) {
  hold(digging());
  const double soil_nats = scored_as(Account::Kind::kParameters, scored_).score;
  // Of what the first gains 3 % and 5 nats are asked, 20 at most.
  const auto first_note = [&](double first_nats, double second_nats) {
    std::vector<ScoredId> scored = scored_;
    for (ScoredId& one : scored) {
      if (one.account.kind != Account::Kind::kEffects) continue;
      const bool pair = one.account.effects.size() == 2;
      one.score =
          soil_nats + (one.id() == "shear_hump" ? 0 : first_nats) + (pair ? second_nats : 0);
    }
    weigh(scored, PlainModel::kRefuted);
    EXPECT_EQ(scored.front().id(), "shear_hump+slip_sinkage");
    NameContest contest(*calibrated_, scored, PlainModel::kRefuted, 1, 1);
    contest.decide();
    return contest.notes().empty() ? "nothing" : contest.notes().front();
  };
  const std::string why = "may be left by the form of slip_sinkage";
  EXPECT_NE(first_note(400, 16).find(why), std::string::npos);
  EXPECT_EQ(first_note(400, 18).find(why), std::string::npos);
  EXPECT_NE(first_note(900, 19).find(why), std::string::npos);
  EXPECT_EQ(first_note(900, 21).find(why), std::string::npos);
}

TEST_F(NameContestOf, ANameThatOnlyScoresIsNotClaimedAndANoteSaysWhy) {
  hold({});
  // Whatever led to it, a score alone claims nothing: held out, the name explains nothing here.
  for (ScoredId& one : scored_) {
    if (one.id() == "slip_sinkage") one.score += 500;
  }
  weigh(scored_, PlainModel::kRefuted);
  ASSERT_EQ(scored_.front().id().substr(0, 12), "slip_sinkage");
  NameContest contest(*calibrated_, scored_, PlainModel::kRefuted, 1, 1);
  EXPECT_FALSE(contest.decide());
  ASSERT_FALSE(contest.notes().empty());
  EXPECT_NE(contest.notes().back().find("slip_sinkage scores best but is not claimed"),
            std::string::npos)
      << contest.notes().back();
}

}  // namespace
}  // namespace regoplan
