#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/names/name_share.h"
#include "diagnosis/names/partial_claim.h"

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

/// A class of names for a mismatch of which the best explains a third and more however conditions
/// are held out, but so might some name of a nameless one: no single name. In it are those
/// of which some form reaches the share of the best in some way to hold out, the best four. Further
/// classes follow as long as their best adds its part: at most three, the last taken back as long
/// as all together predict a channel worse than the calibrated model. \returns nothing where none
/// explains as much, where one stands alone, or where none is left
std::optional<PartialClaim> claim_by_shares(const CalibratedRecording& calibrated,
                                            const std::vector<Effect>& effects, int threads);

}  // namespace regoplan
