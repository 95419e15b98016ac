#include "diagnosis/recording/recording.h"

namespace regoplan {

std::string_view name(Channel channel) {
  constexpr std::array<std::string_view, kChannelCount> kNames{
      "fx_n", "fy_n", "torque_nm", "sinkage_m", "rut_left_m", "rut_right_m"};
  return kNames[static_cast<std::size_t>(channel)];
}

}  // namespace regoplan
