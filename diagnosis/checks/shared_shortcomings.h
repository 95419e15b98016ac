#pragma once

#include <string>
#include <vector>

#include "diagnosis/bed/condensed_recording.h"

namespace regoplan {

/// How the base model is set before test and reference are compared. Names of a difference must
/// hold under each: none of them is true, and each errs elsewhere.
enum class SharedBase {
  kPriorMeans,      ///< soil at the prior means
  kCalibrated,      ///< soil fitted to the reference
  kSinkageImposed,  ///< soil at the prior means, the sinkage as the reference measured it
};

/// `prior means`, `calibrated on the reference`, `the reference's sinkage imposed`.
std::string_view name(SharedBase base);

/// A test as it was measured, and what was taken off it to compare it; rows as those of its bed.
struct MeasuredTest {
  Eigen::VectorXd mean;            ///< of the test, nothing taken off
  Eigen::VectorXd shared;          ///< what was taken off
  Eigen::VectorXd noise_variance;  ///< of the test's means alone
  UncertainSoil tested_soil;       ///< as independent tests tell it
  UncertainSoil soil;              ///< as the base model has it, and what is then known of it
};

/// The test recording less what the base model lacks on the reference too: the mean of a Gaussian
/// process through the reference's residuals is taken off each channel, its covariance joins the
/// noise. Soil numbers are fixed there: a difference has none of its own. When a run was made is no
/// place that two recordings have in common; what replicates follow in the course of one counts as
/// noise along it. What the two recordings differ in is left.
struct DifferenceBed {
  SharedBase base = SharedBase::kPriorMeans;
  CondensedRecording test;  ///< of its bed, means and noise as said above
  MeasuredTest measured;
};

/// \throws InputError as condense(), naming the reference where it is at fault
DifferenceBed difference_bed(const CondensedRecording& test,
                             const std::vector<CondensedRecording>& references, SharedBase base);

}  // namespace regoplan
