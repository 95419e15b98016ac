#include "diagnosis/fit/calibration.h"

#include <gtest/gtest.h>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/fit/candidate_fit.h"
#include "synthetic_bed.h"

namespace regoplan {
namespace {

TEST(Calibration, DerivativesAgreeWithRichardsonExtrapolation) {
  const DiagnosisSetup setup = simulant_setup();
  const Recording recording = record({}, setup, setup.soil.mean, {.conditions = 12}, 1);
  TestBed bed = condense(recording, setup).bed;
  bed.accuracy = WheelAccuracy::kExact;
  const auto soil = soil_coordinates(setup.soil);
  const Eigen::VectorXd x = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(soil.size()), 0.3);
  const Eigen::VectorXd at = *predict(bed, soil, {}, x);
  const Eigen::MatrixXd used = *jacobian_of(bed, soil, {}, x, at, 0, true);
  const Eigen::MatrixXd wide = *jacobian_of(bed, soil, {}, x, at, 0, true, 0.1);
  const Eigen::MatrixXd narrow = *jacobian_of(bed, soil, {}, x, at, 0, true, 0.05);
  const Eigen::MatrixXd extrapolated = (4 * narrow - wide) / 3;
  for (Eigen::Index i = 0; i < used.cols(); ++i) {
    EXPECT_LT((used.col(i) - extrapolated.col(i)).norm(), 2e-3 * extrapolated.col(i).norm() + 1e-6)
        << soil[static_cast<std::size_t>(i)].coordinate.name;
  }
}

TEST(Calibration, FindsTheSoilWithinItsOwnUncertainty) {
  const DiagnosisSetup setup = simulant_setup();
  Soil truth = setup.soil.mean;
  truth.friction_angle_rad += 2 * setup.soil.standard_deviation.friction_angle_rad;
  truth.ky0_m -= 2 * setup.soil.standard_deviation.ky0_m;
  const Recording recording = record({}, setup, truth, {.noise = 0.3, .day = 0, .outliers = 0}, 2);
  const CondensedRecording condensed = condense(recording, setup);
  const auto soil = soil_coordinates(setup.soil);
  const Calibration found = calibrate(condensed.bed, soil);
  for (std::size_t i = 0; i < soil.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double x = soil[i].coordinate.at(truth.*soil_parameters()[soil[i].parameter].member);
    EXPECT_LT(std::abs(found.x[k] - x), 4 * std::sqrt(found.covariance(k, k)) + 0.1)
        << soil[i].coordinate.name;
  }
}

TEST(Calibration, AStepBeyondTheEdgeAtWhichTheMaximumStressLeavesTheContactIsCutThere) {
  DiagnosisSetup setup = simulant_setup();
  setup.soil.mean.a0 = 0.283;
  setup.soil.mean.a1 = 0.273;
  const TestBed bed =
      condense(record({}, setup, setup.soil.mean, {.conditions = 12}, 1), setup).bed;
  const auto soil = soil_coordinates(setup.soil);
  for (const double pull : {-4.0, 4.0}) {
    const auto size = static_cast<Eigen::Index>(soil.size());
    for (Eigen::Index i = 0; i < size; ++i) {
      const Eigen::VectorXd x =
          kept_inside(setup.soil, soil, pull * Eigen::VectorXd::Unit(size, i));
      EXPECT_NO_THROW(validate(soil_at(setup.soil, soil, x)));
      EXPECT_TRUE(predict(bed, soil, {}, x)) << soil[static_cast<std::size_t>(i)].coordinate.name;
    }
  }
}

TEST(Calibration, NumbersThatAreKnownStayAsTheyAre) {
  DiagnosisSetup setup = simulant_setup();
  setup.soil.standard_deviation.n = 0;
  for (const SoilCoordinate& coordinate : soil_coordinates(setup.soil)) {
    EXPECT_NE(coordinate.coordinate.name, "n");
  }
}

}  // namespace
}  // namespace regoplan
