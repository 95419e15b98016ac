#include "diagnosis/fit/unnamed_correction.h"

#include <gtest/gtest.h>

#include "calibrated_bed.h"
#include "diagnosis/fit/carried_surface.h"

namespace regoplan {
namespace {

TEST(UnnamedCorrection, GivesWhatTheDiscrepancySaysAtEveryCondition) {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return 8 * std::sin(7 * run.slip_ratio); };
  wheel.fy_n = [](const WheelRun& run, double) { return 20 * std::abs(run.slip_angle_rad); };
  const DiagnosisSetup setup = simulant_setup();
  const TestBed bed =
      condense(record(wheel, setup, setup.soil.mean, {.angles_deg = {-16, -8, 0, 8, 16}}, 1), setup)
          .bed;
  const auto soil = soil_coordinates(setup.soil);
  const Discrepancy discrepancy(bed);
  const Eigen::MatrixXd free(bed.size(), 0);
  const FitProblem problem{bed, soil, discrepancy, free};
  CandidateFit fit;
  fit.prediction = calibrate(bed, soil).prediction;
  const auto settings = remainder_settings(problem, fit);
  const GenericCorrection correction =
      unnamed_correction(problem, fit, settings, std::vector<double>(bed.channels.size(), 1.0));
  validate(correction);
  for (std::size_t c = 0; c < 2; ++c) {  // fx, fy
    const ChannelData& data = bed.channels[c];
    const ChannelCovariance& covariance = discrepancy.at(c, settings[c]);
    ASSERT_GT(covariance.discrepancy.size(), 0);
    const Eigen::VectorXd left =
        (bed.measured() - fit.prediction).segment(bed.offset(c), data.mean.size());
    const Eigen::VectorXd mean = covariance.discrepancy * covariance.factor.solve(left);
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
      const Condition& at = bed.conditions[data.conditions[i]];
      const CorrectionValue value =
          correction_at(correction, {.slip_ratio = at.slip_ratio,
                                     .slip_angle_rad = std::abs(at.slip_angle_rad),
                                     .load_n = at.load_n})
              .value;
      const double side = at.slip_angle_rad < -0.01 ? -1 : at.slip_angle_rad > 0.01 ? 1 : 0;
      EXPECT_NEAR(c == 0 ? value.fx_n : side * value.fy_n, mean[static_cast<Eigen::Index>(i)],
                  0.02);
    }
  }
}

TEST(UnnamedCorrection, IsThatOfTheCommonPassWhereALaterOneMeasuresSomethingElse) {
  TrueWheel wheel;
  wheel.fx_n = [](const WheelRun& run, double) { return 8 * std::sin(7 * run.slip_ratio); };
  const DiagnosisSetup setup = simulant_setup();
  Recording recording = record(wheel, setup, setup.soil.mean, {.conditions = 36}, 1);
  constexpr double kInOldRut_n = 30;
  std::size_t later = 0;
  for (WheelRun& run : recording.runs) {
    if (std::abs(run.slip_ratio - 0.3) > 0.05) continue;
    run.conditions.pass = 2;
    run.measured[0] += kInOldRut_n;
    ++later;
  }
  recording.columns.pass = true;
  ASSERT_GT(later, 0u);
  const CalibratedBed calibrated(recording);
  const TestBed& bed = calibrated.recording.bed;
  const FitProblem problem = calibrated.problem();
  const auto settings = remainder_settings(problem, calibrated.fit);
  ASSERT_GT(discrepancy_settings()[settings[0]].amplitude, 0);
  const GenericCorrection correction = unnamed_correction(
      problem, calibrated.fit, settings, std::vector<double>(bed.channels.size(), 1.0));
  const CarriedAt carried = CarriedAt::of(bed);
  EXPECT_EQ(carried.pass, 1);
  EXPECT_NE(words_of_carried(bed).find("it is that of pass 1"), std::string::npos);
  const ChannelData& fx = bed.channels[0];
  const Eigen::VectorXd left =
      (bed.measured() - calibrated.fit.prediction).segment(bed.offset(0), fx.mean.size());
  const ConditionsAt places = conditions_of(bed, fx);
  const Eigen::VectorXd mean =
      CarriedSurface(bed, 0, settings[0], calibrated.discrepancy, left, carried).at(places).mean;
  double square = 0, count = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const CorrectionPoint point{.slip_ratio = places[i]->slip_ratio,
                                .slip_angle_rad = std::abs(places[i]->slip_angle_rad),
                                .load_n = places[i]->load_n};
    EXPECT_NEAR(correction_at(correction, point).value.fx_n, mean[k], 1e-6);
    if (places[i]->conditions.pass != 1) continue;
    square += std::pow(mean[k] - left[k], 2);
    ++count;
  }
  constexpr double kNoise_n = 1;
  EXPECT_LT(std::sqrt(square / count), 2 * kNoise_n);
}

}  // namespace
}  // namespace regoplan
