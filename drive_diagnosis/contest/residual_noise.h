#pragma once

#include <Eigen/Core>
#include <vector>

namespace regoplan {

/// What residuals are made of, by window and channel.
struct ResidualParts {
  Eigen::MatrixXd residuals;
  /// What each global parameter changes, by the size that a sound vehicle is off.
  std::vector<Eigen::MatrixXd> columns;
  std::vector<bool> may_be_wrong;  ///< of each: a fault takes it far beyond that size
  /// What an input of a window that is measured with scatter changes in it, by that scatter.
  std::vector<Eigen::MatrixXd> inputs;
  std::vector<bool> scatters_unknown;  ///< of each input: how far it scatters is estimated
  std::vector<bool> follows;           ///< whether a window follows the one before
  /// Of each window and channel whose scatter goes with its size, that size; 0 of other channels.
  Eigen::MatrixXd sizes;
  /// What neighbouring samples say of the scatter of a window's measurement, of each channel of
  /// which they say any.
  std::vector<double> sampled_std;
  /// By window and channel, what a window's measurement is known to scatter besides that of most.
  Eigen::MatrixXd more_std;
};

/// Those of some windows. \param windows indices, increasing
ResidualParts parts_of(const ResidualParts& all, const std::vector<Eigen::Index>& windows);

/// How far each source of scatter goes.
struct ScatterSources {
  std::vector<double> floor;    ///< of each channel
  std::vector<double> widened;  ///< of each channel, by what goes on from window to window
  double share = 0;             ///< of their size, by which channels scatter that do
  std::vector<double> inputs;   ///< of each input, in what it was given by
};

/// How residuals scatter: each channel by a floor of its own, some by a share of their size as well
/// (floor and share are common to them), and all by what the inputs' scatter does to them. Makes
/// them white but for what inputs of unknown scatter do: those may go together from window to
/// window.
class ResidualNoise {
 public:
  /// Estimates floors, share and inputs together by what is left when everything global is fitted,
  /// less what that fit takes (restricted maximum likelihood), robustly: a zone of the map, or a
  /// stray window, does not widen them. Residuals that go on from window to window widen theirs.
  explicit ResidualNoise(ResidualParts parts);
  /// As far as is told.
  ResidualNoise(ResidualParts parts, ScatterSources sources);

  /// Window by window, its channels one behind the other.
  Eigen::VectorXd whitened(const Eigen::MatrixXd& by_window) const;
  /// The inputs that residuals make most likely, by window and input, in deviations of each: what
  /// the inputs' scatter has done to the residuals, and not what parameters do.
  Eigen::MatrixXd inputs_given(const Eigen::MatrixXd& residuals) const;
  /// By how many nats residuals are unlikely as such noise, but for what all have in common; far
  /// ones count less.
  double nats(const Eigen::MatrixXd& residuals) const;
  /// Of each channel, the scatter of its own in the median window: some windows may be told to say
  /// nothing.
  std::vector<double> scales() const;
  const ScatterSources& sources() const { return sources_; }

 private:
  static Eigen::VectorXd whitened(const Eigen::MatrixXd& by_window,
                                  const std::vector<Eigen::MatrixXd>& roots);
  /// What is left of residuals when everything global is fitted.
  struct Fitted {
    Eigen::MatrixXd left;
    /// Of each window: the covariance of what is left, seen through the inverse of the noise's.
    std::vector<Eigen::MatrixXd> known;
  };
  void start();
  void factor();
  Fitted fitted() const;
  double update(const Fitted& fitted);
  void widen_what_goes_on(const Eigen::MatrixXd& left);
  Eigen::VectorXd variances(Eigen::Index window) const;
  double least_floor(Eigen::Index channel) const;
  /// Whether a channel has floor and share in common with the others that go with their size.
  bool is_alike(Eigen::Index channel) const { return !parts_.sizes.col(channel).isZero(); }

  ResidualParts parts_;
  ScatterSources sources_;
  std::vector<Eigen::MatrixXd> root_;        ///< of each window: inverse of its Cholesky factor
  std::vector<Eigen::MatrixXd> known_root_;  ///< the same without inputs of unknown scatter
  std::vector<Eigen::MatrixXd> covariance_;
};

}  // namespace regoplan
