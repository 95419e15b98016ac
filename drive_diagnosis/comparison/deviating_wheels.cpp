#include "drive_diagnosis/comparison/deviating_wheels.h"

namespace regoplan {

DeviatingWheels::DeviatingWheels(const std::vector<MapSoil>& soils, const Wheel& wheel,
                                 double gravity_mps2)
    : soils_(soils), wheel_(wheel), gravity_mps2_(gravity_mps2) {}

std::shared_ptr<const WheelModel> DeviatingWheels::on(std::size_t soil,
                                                      const SoilNumbers& off) const {
  const OffSoil asked{soil, off};
  {
    const std::scoped_lock lock(mutex_);
    const auto known = made_.find(asked);
    if (known != made_.end()) return known->second;
  }
  auto made =
      std::make_shared<const WheelModel>(WheelModelSpec{.wheel = wheel_,
                                                        .soil = deviating(soils_[soil].soil, off),
                                                        .gravity_mps2 = gravity_mps2_},
                                         WheelAccuracy::kFast);
  constexpr std::size_t kKeptMost = 1000;  // of some 5 kB; a fit asks for a hundred at a time
  const std::scoped_lock lock(mutex_);
  if (made_.size() >= kKeptMost) made_.clear();
  return made_.try_emplace(asked, std::move(made)).first->second;
}

}  // namespace regoplan
