#pragma once

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/findings/findings.h"
#include "diagnosis/fit/candidate_fit.h"

namespace regoplan {

/// Conditions that are left out together, one family after the other.
struct Families {
  std::string by;  ///< `slip_angle`, `slip band`, `load`, `day`
  std::vector<std::size_t> of_condition;
  std::size_t count = 0;
};

/// The kind of families of which there are most (slip angles where they are at least 4; never fewer
/// than 3 unless nothing else is there; slips in at most 6 bands).
Families families_of(const TestBed& bed);

/// Every kind of families of which there are at least 3, days too where no condition was run on two
/// of them; families_of() where there is none.
std::vector<Families> all_families(const TestBed& bed);

/// These, and speeds, passes and stretches of the bed: what acts along one of them is seen only
/// where it is held out; elsewhere a remainder carries it from neighbour to neighbour.
std::vector<Families> families_of_all_columns(const TestBed& bed);

/// The model that is to prove itself.
struct CorrectedModel {
  const CandidateFit* fit = nullptr;  ///< with the claim's effects; null: the calibrated base
  /// Settings of the discrepancy whose mean is added to the model, per channel; empty: none.
  std::vector<std::size_t> remainder;
};

/// Misfit over the degrees of freedom that predictions of held-out conditions have by noise and by
/// what the rest leaves open of soil and effects: many conditions of a family err together, as
/// those of a day do.
struct ExpectedExcess {
  double mean = 0, standard_deviation = 0;
};

/// How models do on conditions that they were not fitted to.
struct HeldOut {
  Families families;
  std::vector<ChannelFit> fit;
  Eigen::VectorXd calibrated;  ///< predictions without the condition's own family
  Eigen::VectorXd corrected;
  Eigen::VectorXd corrected_deviation;
  double share_explained = 0;
  double excess = 0;                    ///< of the calibrated misfit over the degrees of freedom
  ExpectedExcess expected;              ///< of a corrected model without a remainder that is true
  std::vector<double> remainder_share;  ///< per channel: of the remainder that proves itself
};

/// Whether what the calibrated model misses on held-out conditions is so clear of noise, by two
/// standard deviations of chi squared, that a share of it says anything.
bool has_clear_excess(const TestBed& bed, const HeldOut& held_out);

/// \param base soil calibrated without any effect, its problem and settings without discrepancy
HeldOut hold_out(const CondensedRecording& recording, const std::vector<SoilCoordinate>& soil,
                 const CandidateFit& base, const CorrectedModel& corrected,
                 const Families& families, int threads);

/// Standard errors by which one prediction's misfit falls below another's: the sum of the falls
/// over what noise makes of it, 2 sqrt(sum of (difference/noise)^2). \param prior_gain fall of the
/// misfit to the soil tests, which counts as data
double gain_in_errors(const TestBed& bed, const Eigen::VectorXd& better,
                      const Eigen::VectorXd& worse, double prior_gain = 0);

/// The rows of one channel alone.
double gain_in_errors(const TestBed& bed, std::size_t channel, const Eigen::VectorXd& better,
                      const Eigen::VectorXd& worse);

/// A channel that is predicted worse, and by how many standard errors.
struct ChannelLoss {
  Channel channel = Channel::kFx;
  double errors = 0;
};

/// The first channel that a prediction makes worse by more than two standard errors, if any.
std::optional<ChannelLoss> clear_loss(const TestBed& bed, const Eigen::VectorXd& prediction,
                                      const Eigen::VectorXd& than);

/// Why a corrected model is not handed out in place of a plain one; empty where it is: on held-out
/// conditions it is not better by more than two standard errors, or worse by more than two in some
/// channel. \param plain what that predicts there
std::string no_better_than(const Eigen::VectorXd& plain, const TestBed& bed, const HeldOut& proof);

/// Held out by the kind of families in which the correction does best: a form that holds between
/// conditions need not hold beyond them.
HeldOut best_hold_out(const CondensedRecording& recording, const std::vector<SoilCoordinate>& soil,
                      const CandidateFit& base, const CorrectedModel& corrected, int threads);

}  // namespace regoplan
