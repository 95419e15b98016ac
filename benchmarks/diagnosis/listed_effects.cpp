#include "benchmarks/diagnosis/truth_effect.h"

namespace regoplan::challenge {

const std::vector<TruthEffect>& listed_effects() {
  static const std::vector<TruthEffect> all = [] {
    std::vector<TruthEffect> effects;
    for (auto* part :
         {&effects_on_sinkage, &effects_on_shear, &effects_on_sides, &effects_on_carriage}) {
      const std::vector<TruthEffect> some = part();
      effects.insert(effects.end(), some.begin(), some.end());
    }
    return effects;
  }();
  return all;
}

std::optional<TruthChannels> channels_with(const std::vector<DrawnEffect>& effects,
                                           const TruthPhysics& base) {
  TruthPhysics p = base;
  for (const DrawnEffect& drawn : effects) {
    if (drawn.effect->act) p = drawn.effect->act(p, drawn.amplitude, drawn.shape);
  }
  if (!(p.at.load_n > 0)) return std::nullopt;
  std::optional<TruthChannels> c = truth_channels(p);
  if (!c) return c;
  for (const DrawnEffect& drawn : effects) {
    if (drawn.effect->after) c = drawn.effect->after(*c, p, drawn.amplitude, drawn.shape);
  }
  return c;
}

}  // namespace regoplan::challenge
