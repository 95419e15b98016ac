#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "drive_diagnosis/comparison/soil_deviation.h"
#include "maps/terrain_map.h"
#include "terramech/parameters/wheel.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// A wheel on soils that lie off those of a map, in fast accuracy. Each is made when it is first
/// asked for: its tables take half as long as the motions of a window, and all windows ask for the
/// same.
/// May be asked by several threads at once.
class DeviatingWheels {
 public:
  /// All must outlive it.
  DeviatingWheels(const std::vector<MapSoil>& soils, const Wheel& wheel, double gravity_mps2);

  /// \param soil index of the map \param off in deviations of its numbers
  std::shared_ptr<const WheelModel> on(std::size_t soil, const SoilNumbers& off) const;

 private:
  using OffSoil = std::pair<std::size_t, SoilNumbers>;

  const std::vector<MapSoil>& soils_;
  const Wheel& wheel_;
  double gravity_mps2_;
  mutable std::mutex mutex_;
  mutable std::map<OffSoil, std::shared_ptr<const WheelModel>> made_;
};

}  // namespace regoplan
