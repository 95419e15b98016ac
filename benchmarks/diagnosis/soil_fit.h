#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace regoplan::challenge {

/// One condition as a fit sees it; channels that were not measured are NaN.
struct FitRow {
  double load_n = 0, slip_ratio = 0, slip_angle_rad = 0;
  WheelConditions conditions;
  std::array<double, kChannelCount> value{}, sigma{};
};

/// A parameter of a mechanism that is fitted beside the soil numbers, within its usual range.
struct FittedMechanism {
  const MechanismForm* form = nullptr;  ///< none: the base model
};

struct SoilFit {
  Eigen::VectorXd x;   ///< soil numbers in prior standard deviations from the mean, then the
                       ///< mechanism's parameters in half ranges from their typical values
  double chi2 = 0;     ///< of the data
  double penalty = 0;  ///< of the soil numbers' priors
  std::vector<std::array<double, kChannelCount>> fitted;  ///< NaN where the wheel sinks in
};

/// Model values for rows at the given parameters.
std::vector<std::array<double, kChannelCount>> model_values(const std::vector<FitRow>& rows,
                                                            const DiagnosisSetup& setup,
                                                            const FittedMechanism& mechanism,
                                                            const Eigen::VectorXd& x);

/// Maximum a posteriori fit of the soil numbers by Levenberg and Marquardt from the prior means, or
/// from `start`.
SoilFit fit_soil(const std::vector<FitRow>& rows, const DiagnosisSetup& setup,
                 const FittedMechanism& mechanism = {}, const Eigen::VectorXd& start = {},
                 int iterations = 12);

}  // namespace regoplan::challenge
