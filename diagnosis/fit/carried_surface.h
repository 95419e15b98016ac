#pragma once

#include <string>
#include <vector>

#include "diagnosis/bed/discrepancy.h"

namespace regoplan {

/// Where a model file's correction, which knows slip, slip angle and load alone, stands along what
/// else may vary: the pass that most conditions have, the middle speed, the middle of the course.
struct CarriedAt {
  int pass = 1;
  double speed_mps = 0;  ///< 0: not told of all
  double when = 0;

  static CarriedAt of(const TestBed& bed);
  Condition at(Condition place) const;  ///< the same wheel there
};

/// Whether a condition of the bed lies elsewhere than a model file's correction stands.
bool varies_beyond_a_model_file(const TestBed& bed);

/// Where it stands, for a person; empty where no condition lies elsewhere.
std::string words_of_carried(const TestBed& bed);

/// The mean of one channel's discrepancy as a model file carries it: a sum of bumps over slip, slip
/// angle and load. As its kernel is a product, that is the mean itself at CarriedAt.
class CarriedSurface {
 public:
  /// \param left of the channel, one value a condition at which it was measured
  /// \param setting with an amplitude above 0
  CarriedSurface(const TestBed& bed, std::size_t channel, std::size_t setting,
                 const Discrepancy& discrepancy, const Eigen::VectorXd& left,
                 const CarriedAt& carried);

  Eigen::VectorXd heights() const;  ///< of the bumps, one a condition

  struct Predicted {
    Eigen::VectorXd mean, variance;
  };
  /// Whatever pass, speed and time the places have.
  Predicted at(const ConditionsAt& places) const;

 private:
  Channel channel_;
  DiscrepancySetting setting_;
  double variance_;
  CarriedAt carried_;
  ConditionsAt measured_;
  const Eigen::LLT<Eigen::MatrixXd>& factor_;
  Eigen::VectorXd weights_;
};

}  // namespace regoplan
