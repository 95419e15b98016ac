#include "planner/benchmark/benchmark_run.h"

#include <fmt/format.h>
#include <ompl/base/PlannerStatus.h>
#include <ompl/config.h>
#include <ompl/control/SimpleSetup.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <algorithm>
#include <cmath>

#include "planner/benchmark/planner_parameters.h"
#include "planner/driving/margin_draws.h"
#include "planner/ompl/iteration_termination.h"
#include "planner/ompl/muted_ompl.h"
#include "planner/ompl/ompl_problem.h"
#include "planner/verdict/verified_path.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
namespace ot = ompl::tools;

using Properties = std::map<std::string, std::string>;

/// A planner that may end after so many iterations as well, where OMPL's benchmark knows time only,
/// and whose exceptions are crashes, where it takes some for an unknown status.
class WatchedPlanner : public ob::Planner {
 public:
  WatchedPlanner(ob::PlannerPtr planner, std::optional<std::int64_t> iterations)
      : ob::Planner(planner->getSpaceInformation(), planner->getName()),
        planner_(std::move(planner)),
        iterations_(iterations) {
    specs_ = planner_->getSpecs();
    params_.include(planner_->params());
    for (const auto& [name, read] : planner_->getPlannerProgressProperties()) {
      addPlannerProgressProperty(name, read);
    }
  }
  void setProblemDefinition(const ob::ProblemDefinitionPtr& definition) override {
    ob::Planner::setProblemDefinition(definition);
    planner_->setProblemDefinition(definition);
  }
  void setup() override {
    ob::Planner::setup();
    planner_->setup();
  }
  void clear() override {
    ob::Planner::clear();
    planner_->clear();
  }
  void getPlannerData(ob::PlannerData& data) const override { planner_->getPlannerData(data); }
  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& stop) override {
    try {
      if (!iterations_) return planner_->solve(stop);
      ob::IterationTerminationCondition iterations(static_cast<unsigned int>(*iterations_));
      return planner_->solve(ob::plannerOrTerminationCondition(stop, iterations));
    } catch (const std::exception& error) {
      failure_ = error.what();
      return ob::PlannerStatus::CRASH;
    }
  }
  /// What it threw, where it threw.
  const std::optional<std::string>& failure() const { return failure_; }

 private:
  ob::PlannerPtr planner_;
  std::optional<std::int64_t> iterations_;
  std::optional<std::string> failure_;
};

/// Takes `improve`, which is no parameter of OMPL's, out of them.
/// \returns nothing where it is not among them
std::optional<bool> extracted_improve(const std::string& planner, Properties& parameters) {
  const auto improve = parameters.extract("improve");
  if (!improve) return std::nullopt;
  if (improve.mapped() != "0" && improve.mapped() != "1") {
    throw InputError(fmt::format("{}: parameter improve: {} is not valid (allowed: 0, 1)", planner,
                                 improve.mapped()));
  }
  return improve.mapped() == "1";
}

std::string real(double value) {
  return fmt::format("{}", value);
}

double largest(const std::vector<TrajectoryPoint>& points, double TrajectoryPoint::*member) {
  double most = 0;
  for (const TrajectoryPoint& point : points) most = std::max(most, std::abs(point.*member));
  return most;
}

/// What the exact model says of the solution. \param solved that the planner says it is one
Properties verified_properties(bool solved, const std::optional<VerifiedPath>& path,
                               const PlanningProblem& problem) {
  if (!path || !path->candidate.verified.passed) {
    return {{"verified BOOLEAN", "0"}, {"overturned BOOLEAN", solved ? "1" : "0"}};
  }
  const Candidate& candidate = path->candidate;
  const Search& search = problem.search;
  const MarginSpread spread =
      margin_spread(smallest_margins(problem, path->replay, {.count = search.soil_draws},
                                     search.seed, search.threads),
                    problem.limits.margin_min);
  return {{"verified BOOLEAN", "1"},
          {"overturned BOOLEAN", "0"},
          {"path length m REAL", real(candidate.length_m)},
          {"path duration s REAL", real(candidate.duration_s)},
          {"path energy j REAL", real(candidate.energy_j)},
          {"margin min REAL", real(candidate.margin_min)},
          {"margin p05 REAL", real(spread.p05)},
          {"slip max REAL", real(largest(candidate.points, &TrajectoryPoint::slip_max))},
          {"sinkage max m REAL", real(largest(candidate.points, &TrajectoryPoint::sinkage_max_m))},
          {"deviation max m REAL", real(candidate.verified.deviation_max_m)}};
}

/// Of a planner that threw, whatever it had entered before.
Properties crashed_properties(const std::string& failure) {
  return {{"solved BOOLEAN", "0"},
          {"verified BOOLEAN", "0"},
          {"overturned BOOLEAN", "0"},
          {"failure STRING", failure}};
}

Properties counted_properties(const OmplProblem& problem) {
  Properties properties{{"propagations INTEGER", std::to_string(problem.propagations())}};
  const auto& counts = problem.rejections().counts();
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::string reason(name(static_cast<Rejection>(i)));
    std::replace(reason.begin(), reason.end(), '_', ' ');
    properties["rejected " + reason + " INTEGER"] = std::to_string(counts[i]);
  }
  return properties;
}

}  // namespace

BenchmarkRecord benchmark(const World& searched, const World& verdict, const BenchmarkRun& run,
                          const OwnPlanners& own) {
  const MutedOmpl muted;
  SearchGuidance guidance = run.guidance;
  Properties parameters = run.parameters;
  if (const auto improve = extracted_improve(run.planner, parameters)) guidance.improve = *improve;
  OmplProblem problem(searched, guidance);
  const ob::PlannerPtr made = make_planner(run.planner, problem, own);
  set_parameters(*made, run.planner, parameters);
  const auto planner = std::make_shared<WatchedPlanner>(made, run.iterations);

  oc::SimpleSetup setup(problem.space());
  problem.pose(*setup.getProblemDefinition());
  ot::Benchmark tool(setup, "run");
  tool.addPlanner(planner);
  BenchmarkRecord record;
  tool.setPostRunEvent([&](const ob::PlannerPtr&, Properties& properties) {
    properties.merge(counted_properties(problem));
    properties["random seed INTEGER"] = std::to_string(run.guidance.seed);
    if (planner->failure()) {
      Properties crashed = crashed_properties(*planner->failure());
      crashed.merge(properties);
      properties.swap(crashed);
      return;
    }
    const ob::ProblemDefinition& definition = *setup.getProblemDefinition();
    std::optional<VerifiedPath> path;
    if (const auto controls = exact_solution(definition); !controls.empty()) {
      path = verify(verdict, searched,
                    {.planner = run.planner, .seed = run.guidance.seed, .controls = controls});
    }
    properties.merge(verified_properties(definition.hasExactSolution(), path, verdict.problem()));
    if (!path || !path->candidate.verified.passed) return;
    for (const TrajectoryPoint& point : path->candidate.points) {
      record.path.push_back({point.x_m, point.y_m, point.margin});
    }
  });
  ot::Benchmark::Request request(run.time_s, run.memory_mb, 1, run.progress_interval_s,
                                 /*displayProgress=*/false, /*saveConsoleOutput=*/false,
                                 /*simplify=*/false);
  tool.benchmark(request);

  const ot::Benchmark::PlannerExperiment& told = tool.getRecordedExperimentData().planners.front();
  record.settings = told.common;
  record.properties = told.runs.front();
  record.progress_names = told.progressPropertyNames;
  if (!told.runsProgressData.empty()) {
    for (const auto& sample : told.runsProgressData.front()) {
      std::vector<std::string>& values = record.progress.emplace_back();
      for (const std::string& name : record.progress_names) {
        const auto value = sample.find(name);
        values.push_back(value == sample.end() ? "" : value->second);
      }
    }
  }
  return record;
}

void require_parameters(const World& world, const std::string& planner,
                        const std::map<std::string, std::string>& parameters,
                        const OwnPlanners& own) {
  const MutedOmpl muted;
  Properties of_ompl = parameters;
  extracted_improve(planner, of_ompl);
  OmplProblem problem(world, {});
  set_parameters(*make_planner(planner, problem, own), planner, of_ompl);
}

int ompl_crash_status() {
  return ob::PlannerStatus::CRASH;
}

std::vector<std::string> ompl_status_names() {
  std::vector<std::string> names;
  for (int i = 0; i < ob::PlannerStatus::TYPE_COUNT; ++i) {
    names.push_back(ob::PlannerStatus(static_cast<ob::PlannerStatus::StatusType>(i)).asString());
  }
  return names;
}

std::string ompl_version() {
  // Debian leaves OMPL_VERSION empty.
  return fmt::format("{}.{}.{}", OMPL_MAJOR_VERSION, OMPL_MINOR_VERSION, OMPL_PATCH_VERSION);
}

}  // namespace regoplan
