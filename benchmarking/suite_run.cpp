#include "benchmarking/suite_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "planner/problem/world.h"
#include "planner/runtime/child_processes.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

using Clock = std::chrono::steady_clock;

/// What a run may take beyond its search before it counts as hanging: its verification and the
/// soil draws.
constexpr double kVerificationLimit_s = 120;

/// What it may take beyond the bound of its search, which OMPL watches now and then, before
/// allocations fail.
constexpr double kVerificationMemory_mb = 1024;

/// Estimates what remains from what has been done in this session.
class Stopwatch {
 public:
  Stopwatch(std::size_t before, std::size_t total)
      : before_(before), total_(total), start_(Clock::now()) {}

  SuiteProgress progress(const std::string& experiment, std::size_t done) const {
    SuiteProgress progress{.experiment = experiment, .done = done, .total = total_};
    if (done > before_) {
      const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
      progress.remaining_s =
          elapsed_s * static_cast<double>(total_ - done) / static_cast<double>(done - before_);
    }
    return progress;
  }

 private:
  std::size_t before_, total_;
  Clock::time_point start_;
};

std::vector<char> bytes_of(const BenchmarkRecord& record) {
  const std::string text =
      to_json(record).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return {text.begin(), text.end()};
}

ChildTask task_of(const Suite& suite, const SuiteRun& run, const World& searched,
                  const World& verdict, const OwnPlanners& own) {
  const SuitePlanner& planner = suite.planners[run.planner];
  const RunBounds& bounds = suite.bounds;
  const BenchmarkRun request{
      .planner = planner.planner,
      .parameters = planner.parameters,
      .guidance = {.seed = run.seed, .margin_min = verdict.problem().limits.margin_min},
      .time_s = bounds.time_s,
      .iterations = bounds.iterations,
      .memory_mb = bounds.memory_mb,
      .progress_interval_s = bounds.progress_interval_s};
  return {.work = [&searched, &verdict, &own,
                   request] { return bytes_of(benchmark(searched, verdict, request, own)); },
          .time_limit_s = bounds.time_s + kVerificationLimit_s,
          .memory_limit_mb = bounds.memory_mb + kVerificationMemory_mb};
}

/// What a process says of a planner, with the planner's place in the suite's file.
InputError refused(const Suite& suite, std::size_t planner, const std::string& why) {
  const auto place = suite.planner_places.find(suite.planners[planner].label);
  return InputError(place == suite.planner_places.end() ? why : place->second + ": " + why);
}

}  // namespace

void require_parameters(const Suite& suite, const PlanningProblem& problem,
                        const SuiteSession& session, const SingleThread& alone) {
  const World world(problem, WorldUse::kVerdict, session.processes);
  std::size_t next = 0;
  run_in_children(
      session.processes, AnswerOrder::kAsGiven,
      [&]() -> std::optional<ChildTask> {
        if (next == suite.planners.size()) return std::nullopt;
        const SuitePlanner& planner = suite.planners[next++];
        return ChildTask{.work = [&] {
          require_parameters(world, planner.planner, planner.parameters, session.planners);
          return std::vector<char>();
        }};
      },
      [&](const ChildAnswer& answer) {
        if (answer.bad_input) throw refused(suite, answer.task, answer.failure);
      },
      session.stop, alone);
}

void run_suite(const Suite& suite, const std::vector<SuiteRun>& runs, RunJournal& journal,
               const std::function<PlanningProblem(std::size_t, std::size_t)>& problem_of,
               const SuiteSession& session, const SingleThread& alone) {
  const auto key_of = [&](const SuiteRun& run) {
    return RunKey{.experiment = experiment_name(suite, run.scenario, run.sweep_point),
                  .planner = suite.planners[run.planner].label,
                  .seed = run.seed};
  };
  std::vector<SuiteRun> left;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(left),
               [&](const SuiteRun& run) { return !journal.holds(key_of(run)); });
  std::size_t done = runs.size() - left.size();
  const Stopwatch watch(done, runs.size());

  for (auto first = left.begin(); first != left.end() && !session.stop.stop_requested();) {
    const auto last = std::find_if(first, left.end(), [&](const SuiteRun& run) {
      return run.scenario != first->scenario || run.sweep_point != first->sweep_point;
    });
    const std::string experiment = experiment_name(suite, first->scenario, first->sweep_point);
    session.on_progress(watch.progress(experiment, done));
    PlanningProblem problem = problem_of(first->scenario, first->sweep_point);
    problem.search.soil_draws = suite.bounds.soil_draws;
    problem.search.threads = 1;  // of one run; the processes share the machine
    const World searched(problem, WorldUse::kSearch, session.processes);
    const World verdict(problem, WorldUse::kVerdict, session.processes);
    auto next = first;
    run_in_children(
        session.processes, AnswerOrder::kAsEnded,
        [&]() -> std::optional<ChildTask> {
          if (next == last) return std::nullopt;
          return task_of(suite, *next++, searched, verdict, session.planners);
        },
        [&](const ChildAnswer& answer) {
          const SuiteRun& run = *(first + static_cast<std::ptrdiff_t>(answer.task));
          if (answer.bad_input) throw refused(suite, run.planner, answer.failure);
          journal.append({.key = key_of(run),
                          .outcome = answer.bytes
                                         ? benchmark_record_of(nlohmann::json::parse(*answer.bytes))
                                         : crashed_run(run.seed, answer.failure)});
          session.on_progress(watch.progress(experiment, ++done));
        },
        session.stop, alone);
    first = last;
  }
}

}  // namespace regoplan
