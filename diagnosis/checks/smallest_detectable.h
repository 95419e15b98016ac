#pragma once

#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/candidate_fit.h"

namespace regoplan {

/// Per mechanism the amplitude of its first parameter that the test for lack of fit would have
/// found with 80 % power, to first order: the effect at the typical value, less what soil numbers
/// can imitate, scaled. Mechanisms without parameters: the `share` of the whole effect. Of soil
/// that differs somewhere or for a time: the factor on its first number, weaker, on the stretch of
/// those tried that shows it least.
/// \param base the calibrated model
/// \param critical of the test (LackOfFit)
std::vector<SmallestDetectable> smallest_detectable(const FitProblem& problem,
                                                    const CandidateFit& base,
                                                    const std::vector<Effect>& effects,
                                                    double critical);

}  // namespace regoplan
