#pragma once

#include <string_view>
#include <vector>

#include "diagnosis/recording/recording.h"

namespace regoplan {

/// A channel that was measured with the other sign than the wheel's motion gives it.
struct TurnedChannel {
  Channel channel;
  std::string_view opposes;  ///< the convention, in words
};

/// Whether drawbar pull over load is smaller on driving wheels than on those that are held back,
/// which no soil and no sensor's zero does. Not so where either were not measured.
/// \param used indices of the runs that count
bool drawbar_falls_with_slip(const Recording& recording, const std::vector<std::size_t>& used);

/// Side force against the slip angle, torque against driving, drawbar pull against being held
/// back; drawbar pull must fall with slip as well.
/// \param used indices of the runs that count
std::vector<TurnedChannel> turned_channels(const Recording& recording,
                                           const std::vector<std::size_t>& used);

}  // namespace regoplan
