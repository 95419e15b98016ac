#include "planner/ompl/map_decomposition.h"

#include <ompl/control/planners/syclop/SyclopEST.h>
#include <ompl/control/planners/syclop/SyclopRRT.h>

#include <algorithm>
#include <cmath>

#include "planner/ompl/vehicle_space.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr int kRegionsAcross = 32;

ob::RealVectorBounds bounds_of(const GridFrame& frame) {
  ob::RealVectorBounds bounds(2);
  bounds.low = {frame.west_m, frame.south_m()};
  bounds.high = {frame.east_m(), frame.north_m};
  return bounds;
}

class MapDecomposition : public oc::GridDecomposition {
 public:
  explicit MapDecomposition(const GridFrame& frame)
      : oc::GridDecomposition(kRegionsAcross, 2, bounds_of(frame)) {}

  void project(const ob::State* state, std::vector<double>& place) const override {
    const VehicleState& vehicle = VehicleSpace::vehicle(state);
    place = {vehicle.x_m, vehicle.y_m};
  }
  void sampleFullState(const ob::StateSamplerPtr& sampler, const std::vector<double>& place,
                       ob::State* state) const override {
    sampler->sampleUniform(state);
    VehicleState& vehicle = state->as<VehicleSpace::StateType>()->vehicle;
    vehicle.x_m = place[0];
    vehicle.y_m = place[1];
  }
  /// The middle of a region.
  CostToGo::Place centre(int region) const {
    const ob::RealVectorBounds& bounds = getRegionBounds(region);
    return {(bounds.low[0] + bounds.high[0]) / 2, (bounds.low[1] + bounds.high[1]) / 2};
  }
};

/// Cost of a step between neighbouring regions.
double step_cost(const OmplProblem& problem, const MapDecomposition& regions, int from, int to) {
  const CostToGo::Place a = regions.centre(from), b = regions.centre(to);
  const double before = problem.way().cost_m(a.x_m, a.y_m);
  const double after = problem.way().cost_m(b.x_m, b.y_m);
  const double length_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  constexpr double kNoWay = 100;  // times the length
  if (!std::isfinite(after) || !std::isfinite(before)) return kNoWay * length_m;
  // Along the way the costs differ by what the step takes; a step back is dear by its length.
  return std::max(length_m, length_m + after - before);
}

template <class Syclop>
class GuidedSyclop : public Syclop {
 public:
  explicit GuidedSyclop(const OmplProblem& problem)
      : Syclop(problem.space(), decomposition_of(problem)), problem_(problem) {
    // OMPL's 100000 judged states would take longer than the search.
    this->setNumFreeVolumeSamples(4 * kRegionsAcross * kRegionsAcross);
    guide();
  }
  void clear() override {
    Syclop::clear();
    this->clearEdgeCostFactors();
    guide();
  }

 private:
  void guide() {
    const auto& regions = static_cast<const MapDecomposition&>(*this->decomp_);
    this->addEdgeCostFactor(
        [this, &regions](int from, int to) { return step_cost(problem_, regions, from, to); });
  }

  const OmplProblem& problem_;
};

}  // namespace

std::shared_ptr<oc::GridDecomposition> decomposition_of(const OmplProblem& problem) {
  return std::make_shared<MapDecomposition>(problem.world().problem().map.elevation().frame);
}

ob::PlannerPtr make_syclop_rrt(const OmplProblem& problem) {
  return std::make_shared<GuidedSyclop<oc::SyclopRRT>>(problem);
}

ob::PlannerPtr make_syclop_est(const OmplProblem& problem) {
  return std::make_shared<GuidedSyclop<oc::SyclopEST>>(problem);
}

}  // namespace regoplan
