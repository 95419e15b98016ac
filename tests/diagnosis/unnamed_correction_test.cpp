#include "diagnosis/fit/unnamed_correction.h"

#include <gtest/gtest.h>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/fit/calibration.h"
#include "synthetic_bed.h"

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

}  // namespace
}  // namespace regoplan
