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
/// nothing than all but one in a thousand of null draws of the whole contest come by chance, and
/// scatter that the model does not explain widens every deviation.
/// \param scatter how much wider than 1 the data scatter at least
std::vector<EffectFound> find_effects(const Eigen::VectorXd& data,
                                      const std::vector<EffectColumn>& effects, double scatter,
                                      int effects_max, std::uint64_t seed);

}  // namespace regoplan
