#pragma once

#include <string>
#include <vector>

#include "diagnosis/names/name_share.h"

namespace regoplan {

/// A name fitted with nothing beside it but noise: a remainder that may be anything takes part of
/// what a name does, and the more, the larger it is.
struct NameAlone {
  std::string id;
  CandidateFit fit;  ///< of the form that explains most
  NameShare share;   ///< of the excess misfit; of what it adds where names stand beside it
  double reach = 0;  ///< the most that any of its forms explains in any way to hold out
};

/// What each name explains of held-out conditions, the most first by what it does in the least
/// favourable way to hold them out; without instruments and what explains nothing.
/// \param beside null, or names that are there already \param least share that is looked for
std::vector<NameAlone> names_alone(const CalibratedRecording& calibrated,
                                   const std::vector<Effect>& effects, const CandidateFit* beside,
                                   double least, int threads);

}  // namespace regoplan
