#pragma once

#include <cstdint>
#include <optional>

#include "planner/ompl/vehicle_space.h"
#include "planner/problem/rejection_log.h"
#include "planner/problem/world.h"

namespace regoplan {

/// What a step of a search led to, and what it took.
struct SearchStep {
  VehicleSpace::Values values;
  double drive_energy_j = 0;
};

/// The steps of one search: driven by the world's dynamics, judged by its limits, counted.
class SearchSteps {
 public:
  /// \param world must outlive it \param margin_min that every state keeps \param seed of the
  /// sample of rejected states
  SearchSteps(const World& world, double margin_min, std::uint64_t seed)
      : world_(world), margin_min_(margin_min), rejections_(seed) {}

  /// Off the known ground there are no dynamics: the state then rolls on straight to where the
  /// ground ends, so that `allowed` sees why.
  SearchStep next(const VehicleSpace::Values& from, const VehicleControl& control,
                  double duration_s);

  /// Why a state may not be; nothing where it keeps every limit.
  std::optional<Rejection> rejected(const VehicleSpace::Values& values);
  bool allowed(const VehicleSpace::Values& values) { return !rejected(values); }

  const World& world() const { return world_; }
  double margin_min() const { return margin_min_; }
  std::int64_t count() const { return count_; }
  const RejectionLog& rejections() const { return rejections_; }

 private:
  const World& world_;
  double margin_min_;
  std::int64_t count_ = 0;
  RejectionLog rejections_;
};

}  // namespace regoplan
