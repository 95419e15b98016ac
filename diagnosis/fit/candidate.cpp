#include "diagnosis/fit/candidate.h"

#include "diagnosis/fit/instrument_fault.h"

namespace regoplan {

Soil soil_of(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
             const Hypothesis& candidate, const Eigen::VectorXd& x) {
  Soil at = soil_at(bed.setup.soil, soil, x);
  auto next = static_cast<Eigen::Index>(soil.size());
  for (const Effect& effect : candidate.effects) {
    next += static_cast<Eigen::Index>(effect.coordinates.size());
    if (!effect.own_modulus) continue;
    const double factor = effect.coordinates.back().value(x[next - 1]);
    for (double* modulus : {&at.kx0_m, &at.kx1_m, &at.ky0_m, &at.ky1_m}) *modulus *= factor;
  }
  return at;
}

Mechanism mechanism_at(const Effect& effect, const Eigen::VectorXd& x) {
  Mechanism mechanism{.id = effect.id, .form = effect.form, .parameters = effect.fixed};
  for (std::size_t i = 0; i + (effect.own_modulus ? 1 : 0) < effect.coordinates.size(); ++i) {
    mechanism.parameters[effect.coordinates[i].name] =
        effect.coordinates[i].value(x[static_cast<Eigen::Index>(i)]);
  }
  return mechanism;
}

std::optional<Eigen::VectorXd> predict(const TestBed& bed, const std::vector<SoilCoordinate>& soil,
                                       const Hypothesis& candidate, const Eigen::VectorXd& x) {
  std::vector<Mechanism> mechanisms;
  auto next = static_cast<Eigen::Index>(soil.size());
  for (const Effect& effect : candidate.effects) {
    const auto size = static_cast<Eigen::Index>(effect.coordinates.size());
    if (effect.kind == EffectKind::kMechanism) {
      mechanisms.push_back(mechanism_at(effect, x.segment(next, size)));
    }
    next += size;
  }
  auto values = predict(bed, soil_of(bed, soil, candidate, x), mechanisms);
  if (!values) return values;
  next = static_cast<Eigen::Index>(soil.size());
  for (const Effect& effect : candidate.effects) {
    const auto size = static_cast<Eigen::Index>(effect.coordinates.size());
    if (effect.kind != EffectKind::kMechanism) {
      apply_fault(bed, effect, x.segment(next, size), *values);
    }
    next += size;
  }
  return values;
}

}  // namespace regoplan
