#pragma once

#include <vector>

#include "planner/replay.h"

namespace regoplan {

/// What carries the feasibility of a candidate: the same path at twice its speeds, the same path on
/// soils with cohesion and tan(phi) halved, the same controls on those soils.
std::vector<WhatIf> what_ifs(const World& world, const Replay& verified,
                             const std::vector<ControlSegment>& controls);

/// A soil with cohesion and tan(friction angle) scaled.
Soil with_scaled_strength(Soil soil, double factor);

}  // namespace regoplan
