#pragma once

#include <cstdint>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/findings/findings.h"
#include "diagnosis/recording/thresholds.h"

namespace regoplan {

/// What a fit leaves, to be held against pure error.
struct FitRemainder {
  Eigen::VectorXd residual;  ///< measured - fitted
  Eigen::VectorXd x;         ///< fitted numbers, standard normal beforehand
  Eigen::MatrixXd jacobian;  ///< by x
  double truth_spread = 1;   ///< standard deviation of the true x (1/3 where priors were widened)
  /// What else is uncertain of what was fitted: columns, each times a standard normal factor that
  /// the numbers x do not take up.
  Eigen::MatrixXd uncertain = {};
};

/// How far noise goes beside its standard deviation.
enum class NoiseTails {
  kNormal,
  kHeavy,  ///< a run as Student's t with 5 degrees of freedom: sensors and beds have outliers
};

/// Replicates tell outliers from noise; where there are none, tails are heavy: outliers would pass
/// for a misfit.
NoiseTails tails_of(const CondensedRecording& recording);

/// Draws of noise that a probability is counted in.
inline constexpr int kNoiseDraws = 2000;

/// Lack of fit against pure error. The misfit (priors counted as data) of all channels together and
/// of each channel is compared with what noise alone makes of it in seeded draws, in which
/// the noise is known no better than from its degrees of freedom and channels scatter together as
/// replicates do. The worst of them counts; `critical` is at `significance` for all together.
LackOfFit lack_of_fit(const CondensedRecording& recording, const FitRemainder& fit,
                      std::uint64_t seed, double significance = Thresholds::kLackOfFit_p,
                      NoiseTails tails = NoiseTails::kNormal, int draw_count = kNoiseDraws);

/// One way in which a recording may differ from a model: what some effect would add.
struct Direction {
  Eigen::VectorXd values;
  bool either_sign = false;  ///< the effect may also act the other way round
};

/// Probability that noise alone makes some of the directions stand out as far as the residual does
/// after the fit: a sharper test than lack_of_fit() of what is looked for.
double p_value_along(const CondensedRecording& recording, const FitRemainder& fit,
                     const std::vector<Direction>& directions, std::uint64_t seed,
                     NoiseTails tails = NoiseTails::kNormal, int draw_count = kNoiseDraws);

/// Residuals that noise alone would leave after the fit, one column a draw, in the channels' units.
Eigen::MatrixXd residuals_of_noise(const CondensedRecording& recording, const FitRemainder& fit,
                                   std::uint64_t seed, int draws);

}  // namespace regoplan
