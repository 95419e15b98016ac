#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/names/calibrated_recording.h"

namespace regoplan {

/// An id scored beside an unnamed remainder.
struct CappedName {
  std::string id;
  double gain_nats = 0;  ///< over the remainder alone, forms marginalised
  /// Of the likeliest form; where others are about as likely, of the one that predicts held-out
  /// conditions best. Its held-out share is then the best of a few, and that much too high.
  CandidateFit fit;
  bool refused = false;  ///< something speaks against it: it weighs nothing beside the others
};

/// What the best name makes of a world whose misfit has no name.
struct ByChance {
  double gain_nats = 0;
  double share = 0;  ///< of the excess misfit that the name alone explains, in sample
};

/// Every name against an unnamed remainder, a smooth Gaussian process on each channel. Without a
/// cap the remainder swallows every name; up to a third of the amplitude that the base model
/// alone needs, names compete fairly.
class CappedContest {
 public:
  explicit CappedContest(const CalibratedRecording& calibrated);
  CappedContest(const CappedContest&) = delete;
  CappedContest& operator=(const CappedContest&) = delete;

  /// Best first. \param beside effects that stand already; start from their fit
  std::vector<CappedName> score(const std::vector<Effect>& effects, const CandidateFit* beside,
                                int threads) const;

  /// What the best of the names reaches in worlds whose misfit has no name: draws of a remainder as
  /// large as the base model alone needs, as smooth and smoother, with noise, under the same cap.
  /// Names are linear in their numbers there. Sorted by gain.
  std::vector<ByChance> by_chance(const std::vector<CappedName>& names, int worlds,
                                  std::uint64_t seed, int threads) const;

  /// Of the remainder alone.
  double alone_nats() const { return alone_nats_; }
  const std::vector<std::size_t>& alone_settings() const { return alone_settings_; }
  const SettingWeights& weights() const { return weights_; }

 private:
  /// The cap that a residual calls for.
  struct Cap {
    std::vector<std::size_t> settings;  // uncapped, likeliest per channel
    SettingWeights weights;
  };
  CandidateFit best_predicting(const std::vector<CandidateFit>& forms,
                               const CandidateFit* beside) const;
  Cap cap_for(const Eigen::VectorXd& residual) const;
  ByChance best_in_world(const std::vector<CappedName>& names, const Eigen::VectorXd& world) const;

  const CalibratedRecording& calibrated_;
  std::vector<std::size_t> alone_settings_;
  SettingWeights weights_;
  double alone_nats_ = 0;
};

}  // namespace regoplan
