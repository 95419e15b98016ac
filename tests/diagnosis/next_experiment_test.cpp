#include "diagnosis/names/next_experiment.h"

#include <gtest/gtest.h>

#include "calibrated_bed.h"
#include "diagnosis/fit/effect_list.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

ScoredId fitted(const CalibratedBed& bed, const Recording& raw, const std::string& id) {
  for (const Effect& effect : effects_for(bed.recording.bed, raw)) {
    if (effect.id != id) continue;
    Eigen::VectorXd start(bed.fit.x.size() + static_cast<Eigen::Index>(effect.coordinates.size()));
    start.setZero();
    start.head(bed.fit.x.size()) = bed.fit.x;
    const auto fit = fit_candidate(bed.problem(), {{effect}}, SettingWeights::of_named(), start);
    return {.account = {.effects = {id}}, .probability = 0.5, .fit = *fit};
  }
  throw std::logic_error(id);
}

/// How far one run at a condition parts two fits: half the square of what they differ by, over the
/// noise and what either leaves uncertain.
double parted_nats(const CalibratedBed& bed, const ScoredId& a, const ScoredId& b,
                   const Condition& at) {
  TestBed one{.setup = bed.recording.bed.setup, .conditions = {at}};
  for (const ChannelData& data : bed.recording.bed.channels) {
    one.channels.push_back({.channel = data.channel,
                            .conditions = {0},
                            .mean = Eigen::VectorXd::Zero(1),
                            .noise = Eigen::MatrixXd::Constant(1, 1, data.scale * data.scale / 3),
                            .scale = data.scale});
  }
  Eigen::ArrayXd variance(one.size());
  for (std::size_t c = 0; c < one.channels.size(); ++c) {
    variance[static_cast<Eigen::Index>(c)] = one.channels[c].noise(0, 0);
  }
  Eigen::ArrayXd apart = Eigen::ArrayXd::Zero(one.size());
  double sign = 1;
  for (const ScoredId* id : {&a, &b}) {
    const CandidateFit& fit = id->fit;
    const auto mean = predict(one, bed.soil, fit.candidate, fit.x);
    if (!mean) return 0;
    const Eigen::MatrixXd j = *jacobian_of(one, bed.soil, fit.candidate, fit.x, *mean);
    const Eigen::MatrixXd covariance =
        fit.evidence.covariance.topLeftCorner(fit.x.size(), fit.x.size());
    variance += (j * covariance).cwiseProduct(j).rowwise().sum().array();
    apart += sign * mean->array();
    sign = -1;
  }
  return (apart.square() / variance / 2).sum();
}

TEST(NextExperiment, NoOtherAllowedConditionPartsTheNamesBetter) {
  TrueWheel wheel;
  wheel.sinkage = [](const WheelRun& run, double h) {
    return h * (1 + 0.5 * std::max(run.slip_ratio, 0.0));
  };
  const DiagnosisSetup setup = simulant_setup();
  const Recording raw = record(wheel, setup, setup.soil.mean, {}, 1);
  const CalibratedBed bed(raw);
  const std::vector<ScoredId> rivals{fitted(bed, raw, "slip_sinkage"),
                                     fitted(bed, raw, "rear_contact")};
  const std::vector<Experiment> proposed = next_experiments(bed.problem(), rivals);
  ASSERT_FALSE(proposed.empty());
  for (std::size_t i = 1; i < proposed.size(); ++i) {
    EXPECT_GE(proposed[i - 1].expected_gain_nats, proposed[i].expected_gain_nats);
  }
  const auto best = std::ranges::find_if(proposed, [](const auto& e) { return !e.further_sensor; });
  ASSERT_NE(best, proposed.end());
  const Condition at{.load_n = best->conditions.at("load_n"),
                     .slip_ratio = best->conditions.at("slip_ratio"),
                     .slip_angle_rad = best->conditions.at("slip_angle_deg") * kDegree,
                     .conditions = bed.recording.bed.conditions.front().conditions};
  const double gain = parted_nats(bed, rivals[0], rivals[1], at);
  EXPECT_NEAR(best->expected_gain_nats, gain, 0.02 * gain);
  for (const Condition& other : bed.recording.bed.conditions) {
    EXPECT_GE(gain, parted_nats(bed, rivals[0], rivals[1], other))
        << "slip " << other.slip_ratio << ", slip angle " << other.slip_angle_rad / kDegree
        << ", load " << other.load_n;
  }
}

TEST(NextExperiment, AZoneIsToldFromOtherNamesWhereThesePartMost) {
  TrueWheel wheel;
  constexpr double kFrom_m = 0.55, kTo_m = 0.75;
  wheel.stiffness = [](const WheelRun& run) {
    const double at_m = run.conditions.position_m;
    return at_m >= kFrom_m && at_m <= kTo_m ? 0.5 : 1;
  };
  const DiagnosisSetup setup = simulant_setup();
  const Recording raw = record(wheel, setup, setup.soil.mean, {.positions = true}, 1);
  const CalibratedBed bed(raw);
  std::vector<ScoredId> rivals{fitted(bed, raw, "layered_soil")};
  for (const Effect& effect : effects_for(bed.recording.bed, raw)) {
    if (effect.id != "soil_zone" || effect.fixed.at("from_m") > kFrom_m ||
        effect.fixed.at("to_m") < kFrom_m + 0.1)
      continue;
    Eigen::VectorXd start = Eigen::VectorXd::Zero(
        bed.fit.x.size() + static_cast<Eigen::Index>(effect.coordinates.size()));
    start.head(bed.fit.x.size()) = bed.fit.x;
    rivals.push_back(
        {.account = {.effects = {effect.id}},
         .probability = 0.5,
         .fit = *fit_candidate(bed.problem(), {{effect}}, SettingWeights::of_named(), start)});
    break;
  }
  ASSERT_EQ(rivals.size(), 2);
  const std::vector<Experiment> proposed = next_experiments(bed.problem(), rivals);
  const auto best = std::ranges::find_if(proposed, [](const auto& e) { return !e.further_sensor; });
  ASSERT_NE(best, proposed.end());
  Condition at{.load_n = best->conditions.at("load_n"),
               .slip_ratio = best->conditions.at("slip_ratio"),
               .slip_angle_rad = best->conditions.at("slip_angle_deg") * kDegree,
               .conditions = bed.recording.bed.conditions.front().conditions};
  for (const double at_m : {0.1, 0.35, 0.65, 0.9}) {
    at.conditions.position_m = at_m;
    EXPECT_GE(best->expected_gain_nats, 0.98 * parted_nats(bed, rivals[0], rivals[1], at)) << at_m;
  }
  at.conditions.position_m = best->conditions.at("position_m");
  EXPECT_NEAR(best->expected_gain_nats, parted_nats(bed, rivals[0], rivals[1], at),
              0.02 * best->expected_gain_nats);
}

TEST(NextExperiment, NothingIsProposedThatPartsNoNames) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording raw = record({}, setup, setup.soil.mean, {.conditions = 20}, 2);
  const CalibratedBed bed(raw);
  const ScoredId one = fitted(bed, raw, "slip_sinkage");
  EXPECT_TRUE(next_experiments(bed.problem(), {one, one}).empty());
}

TEST(NextExperiment, OneNameAloneNeedsNone) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording raw = record({}, setup, setup.soil.mean, {.conditions = 20}, 2);
  const CalibratedBed bed(raw);
  EXPECT_TRUE(next_experiments(bed.problem(), {fitted(bed, raw, "slip_sinkage")}).empty());
}

}  // namespace
}  // namespace regoplan
