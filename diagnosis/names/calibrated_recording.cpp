#include "diagnosis/names/calibrated_recording.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/checks/stray_runs.h"
#include "diagnosis/fit/calibration.h"

namespace regoplan {
namespace {

/// The recording condensed, strays weighed down.
CondensedRecording prepared(const Recording& recording, const DiagnosisSetup& setup,
                            std::stop_token stop) {
  CondensedRecording condensed = condense(recording, setup, kFewestConditions, std::move(stop));
  const Calibration first = calibrate(condensed.bed, soil_coordinates(setup.soil));
  return strays_weighed_down(recording, std::move(condensed), first.prediction);
}

}  // namespace

CalibratedRecording::CalibratedRecording(const Recording& recording, const DiagnosisSetup& setup,
                                         std::stop_token stop)
    : CalibratedRecording(prepared(recording, setup, std::move(stop))) {}

CalibratedRecording::CalibratedRecording(CondensedRecording condensed)
    : recording_(std::move(condensed)),
      soil_(soil_coordinates(bed().setup.soil)),
      wide_soil_(soil_coordinates(bed().setup.soil, kWideSoil)),
      discrepancy_(bed()) {
  const Calibration calibration = calibrate(bed(), soil_);
  base_.x = calibration.x;
  base_.prediction = calibration.prediction;
  base_.jacobian = calibration.jacobian;
  base_.evidence.covariance = calibration.covariance;
  base_.evidence.settings.assign(bed().channels.size(), 0);
  soil_free_ = soil_directions(bed(), base_.jacobian);
}

Eigen::VectorXd CalibratedRecording::prediction_at_prior_means() const {
  return *predict(bed(), soil_, {}, Eigen::VectorXd::Zero(base_.x.size()));
}

FitRemainder CalibratedRecording::remainder_of(const CandidateFit& fit) const {
  return {.residual = bed().measured() - fit.prediction, .x = fit.x, .jacobian = fit.jacobian};
}

FitRemainder CalibratedRecording::off_soil_beside(const CandidateFit& fit) const {
  const Eigen::Index numbers = base_.x.size();
  const Eigen::VectorXd x = fit.x.head(numbers);
  const Eigen::MatrixXd covariance = fit.evidence.covariance.topLeftCorner(numbers, numbers);
  const Eigen::MatrixXd deviations = covariance.llt().matrixL();
  return {.residual = bed().measured() - predict(bed(), soil_, {}, x).value(),
          .x = Eigen::VectorXd(0),
          .jacobian = Eigen::MatrixXd(bed().size(), 0),
          .uncertain = fit.jacobian.leftCols(numbers) * deviations};
}

bool CalibratedRecording::soil_explains_something() const {
  const std::vector<std::size_t> noise_only(bed().channels.size(), 0);
  const auto misfit = [&](const Eigen::VectorXd& prediction) {
    return misfit_of(bed(), discrepancy_, bed().measured() - prediction, noise_only);
  };
  const double gain =
      misfit(prediction_at_prior_means()) - misfit(base_.prediction) - base_.x.squaredNorm();
  const double told = static_cast<double>(base_.x.size()) - base_.evidence.covariance.trace();
  return gain > told + 2 * std::sqrt(2 * std::max(told, 0.0));
}

Estimate CalibratedRecording::soil_estimate(const CandidateFit& fit, std::size_t number) const {
  const auto k = static_cast<Eigen::Index>(number);
  const Coordinate& c = soil_[number].coordinate;
  const SoilParameter& parameter = soil_parameters()[soil_[number].parameter];
  const double unit = parameter.file_unit;
  const Soil at = soil_at(bed().setup.soil, soil_, fit.x);
  return {at.*parameter.member / unit, c.spread * std::sqrt(fit.evidence.covariance(k, k)) / unit};
}

std::vector<SoilPull> CalibratedRecording::soil_pulls() const {
  std::vector<SoilPull> pulls;
  for (std::size_t i = 0; i < soil_.size(); ++i) {
    const double unit = soil_parameters()[soil_[i].parameter].file_unit;
    const Coordinate& c = soil_[i].coordinate;
    SoilPull pull{.parameter = c.name,
                  .prior = {c.centre / unit, c.spread / unit},
                  .pull = base_.x[static_cast<Eigen::Index>(i)]};
    pull.calibrated = soil_estimate(base_, i);
    pull.corrected = pull.calibrated;
    pull.corrected_pull = pull.pull;
    pulls.push_back(pull);
  }
  return pulls;
}

HeldOut CalibratedRecording::held_out(const CorrectedModel& corrected, int threads) const {
  return held_out(corrected, families_of(bed()), threads);
}

HeldOut CalibratedRecording::held_out(const CorrectedModel& corrected, const Families& families,
                                      int threads) const {
  return hold_out(recording_, soil_, base_, corrected, families, threads);
}

}  // namespace regoplan
