// The command `benchmark` with a planner of one's own beside regoplan's: a suite asks for it as
// `Shooting`, as own_planner_suite.yaml does.
#include <app/app.h>
#include <ompl/control/PathControl.h>

namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// Drives from the start under random controls until it reaches the goal, or begins anew.
class Shooting : public ob::Planner {
 public:
  explicit Shooting(const oc::SpaceInformationPtr& space)
      : ob::Planner(space, "Shooting"), space_(space), sampler_(space->allocControlSampler()) {
    declareParam<int>("drives", this, &Shooting::set_drives);
  }
  void set_drives(int drives) { drives_ = drives; }
  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& stop) override {
    const ob::State* start = pdef_->getStartState(0);
    while (!stop) {
      auto path = std::make_shared<oc::PathControl>(space_);
      path->append(start);
      if (!shoot(*path)) continue;
      pdef_->addSolutionPath(path, /*approximate=*/false, 0, getName());
      return ob::PlannerStatus::EXACT_SOLUTION;
    }
    return ob::PlannerStatus::TIMEOUT;
  }

 private:
  bool shoot(oc::PathControl& path) {
    const std::shared_ptr<oc::Control> control(
        space_->allocControl(), [this](oc::Control* gone) { space_->freeControl(gone); });
    ob::ScopedState<> end(space_);
    for (int i = 0; i < drives_; ++i) {
      const ob::State* from = path.getStates().back();
      sampler_->sample(control.get(), from);
      const auto wanted = static_cast<int>(sampler_->sampleStepCount(4, 24));
      const unsigned int driven =
          space_->propagateWhileValid(from, control.get(), wanted, end.get());
      if (driven == 0) return false;
      path.append(end.get(), control.get(), driven * space_->getPropagationStepSize());
      if (pdef_->getGoal()->isSatisfied(end.get())) return true;
    }
    return false;
  }

  oc::SpaceInformationPtr space_;
  oc::ControlSamplerPtr sampler_;
  int drives_ = 60;
};

}  // namespace

int main(int argc, char** argv) {
  const auto make = [](auto& problem) { return std::make_shared<Shooting>(problem.space()); };
  return regoplan::benchmark_main(argc, argv, {{"Shooting", make}});
}
