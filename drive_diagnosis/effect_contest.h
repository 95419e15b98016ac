#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace regoplan {

/// Something that may be otherwise: what it does to all that was measured, to first order.
struct EffectColumn {
  std::string id;         ///< of the effect, `soil_zone`
  std::string parameter;  ///< what it is measured in, `weaker_sd`
  double unit = 1;        ///< size of the parameter that `column` stands for
  double prior_std = 0;   ///< in units of `column`: how far a sound vehicle is off; 0: not at all
  Eigen::VectorXd column;
};

/// An effect that stands out.
struct EffectFound {
  std::size_t effect = 0;    ///< index of its column
  double size = 0, std = 0;  ///< in the parameter's unit
  double sigmas = 0;
  double p_value = 1;  ///< of the largest that chance gives over all that was looked at
  std::vector<std::size_t>
      alike;  ///< columns that explain as much, to within 5 nats; `effect` first
};

/// Finds which effects the data need, the strongest first. The data are white with deviation 1, but
/// for what the priors of all effects together let vary. An effect counts where it is farther from
/// nothing than `kToSpare` times what all but one in a thousand of null draws of the whole contest
/// come by chance. Null draws are normal; what is spared is for what real residuals are beyond that
/// (tails, noise that is estimated from some fifty windows): simulated drives without any effect
/// reached 1.4 times.
inline constexpr double kToSpare = 1.6;
std::vector<EffectFound> find_effects(const Eigen::VectorXd& data,
                                      const std::vector<EffectColumn>& effects, int effects_max,
                                      std::uint64_t seed);

}  // namespace regoplan
