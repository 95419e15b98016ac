#pragma once

#include <string>
#include <vector>

#include "diagnosis/names/nameless_misfit.h"

namespace regoplan {

/// An id scored beside an unnamed remainder.
struct CappedName {
  std::string id;
  double gain_nats = 0;  ///< over the capped remainder alone, forms marginalised
  /// Over a misfit without a name: that needs more remainder than the cap grants, and the best name
  /// of what has none stays below.
  double over_unexplained_nats = 0;
  /// Of the likeliest form; where others are about as likely, of the one that predicts held-out
  /// conditions best, first of all no channel worse than without it. Its held-out share is then the
  /// best of a few, and that much too high.
  CandidateFit fit;
  double prior_nats = 0;  ///< that it is at work, over the other names, as is told beforehand
  bool refused = false;   ///< something speaks against it: it weighs nothing beside the others
};

/// What the recording says of a name, and what is told of it beforehand.
inline double posterior_nats(const CappedName& name) {
  return name.gain_nats + name.prior_nats;
}

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

  const std::vector<std::size_t>& alone_settings() const { return cap_.settings; }
  const SettingWeights& weights() const { return cap_.weights; }
  const NamelessMisfit& nameless() const { return nameless_; }

 private:
  struct Cap {
    std::vector<std::size_t> settings;  // uncapped, likeliest per channel
    SettingWeights weights;
  };
  static Cap cap_for(const CalibratedRecording& calibrated);
  CandidateFit best_predicting(const std::vector<CandidateFit>& forms,
                               const CandidateFit* beside) const;

  const CalibratedRecording& calibrated_;
  Cap cap_;
  NamelessMisfit nameless_;
  double alone_nats_ = 0;  // of the capped remainder
  double nameless_nats_ = 0;
};

}  // namespace regoplan
