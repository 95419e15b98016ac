#pragma once

#include <array>

#include "planner/driving/replay.h"
#include "planner/runtime/plain_bytes.h"

namespace regoplan {

/// Other circumstances for a candidate, which show what carries its feasibility.
enum class Circumstance {
  kTwiceTheSpeed,  ///< the same path
  kWeakerSoil,     ///< the same path and speeds, cohesion and tan(phi) of all soils halved
  kSameControlsOnWeakerSoil  ///< driven out until the vehicle stands
};
inline constexpr std::array kCircumstances{Circumstance::kTwiceTheSpeed, Circumstance::kWeakerSoil,
                                           Circumstance::kSameControlsOnWeakerSoil};

/// The best candidate under other circumstances.
WhatIf what_if(Circumstance circumstance, const World& world, const Replay& verified,
               const std::vector<ControlSegment>& controls);

/// The best candidate slowed down by tenths, to half its speeds at most, until so large a share of
/// the draws of the soils holds as is asked; where none does, at half its speeds.
/// \pre the soils are drawn: draws is at least 1
WhatIf slow_enough(const World& world, const Replay& verified, int draws, double asked);

/// A soil with cohesion and tan(friction angle) scaled.
Soil with_scaled_strength(Soil soil, double factor);

/// Hands every field to an archive (`bytes_of`).
template <class Archive, FieldsOf<WhatIf> Answer>
void each_field(Archive& archive, Answer& answer) {
  archive(answer.question);
  archive(answer.feasible);
  archive(answer.reason);
  archive(answer.x_m);
  archive(answer.y_m);
  archive(answer.time_s);
  archive(answer.margin_min);
  archive(answer.end_shift_m);
  archive(answer.driven);
  archive(answer.probability);
}

}  // namespace regoplan
