#include "app/evaluate/evaluation_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>

#include "app/command/kept_page_notice.h"
#include "app/command/progress_line.h"
#include "app/evaluate/evaluation_files.h"
#include "app/evaluate/evaluation_report.h"
#include "app/evaluate/evaluation_words.h"
#include "app/evaluate/path_files.h"
#include "app/io/interrupt.h"
#include "app/io/quantity_text.h"
#include "app/io/staged_files.h"
#include "app/settings/manoeuvre_settings.h"
#include "planner/problem/changed_problem.h"

namespace regoplan {
namespace {

/// Of the draws in which the margins hold, in per cent, with its interval.
std::string probability_text(const std::optional<SoilSpread>& spread) {
  if (!spread) return std::string(kNotKnown);
  const Probability& holds = spread->feasible;
  return fmt::format("{:.1f} ({:.1f}-{:.1f})", 100 * holds.share, 100 * holds.low,
                     100 * holds.high);
}

std::string summary(const EvaluationResult& result) {
  std::string text = evaluation_headline(result) + "\n";
  text += fmt::format("{:>4} {:>8} {:>10} {:>10} {:>15} {:>16} {:>9} {:>8}  {}\n", "rank",
                      "feasible", "margin_min", "margin_p05", "limited by", "P(margins), 95 %",
                      "deviation", "energy", "path");
  for (const EvaluatedPath& path : result.paths) {
    const PathEvaluation& e = path.evaluation;
    text += fmt::format("{:>4} {:>8} {:>10} {:>10} {:>15} {:>16} {:>9} {:>8}  {}\n", e.rank,
                        e.feasible ? "yes" : "no", margin_text(e, e.margin_min),
                        margin_text(e, e.spread ? e.spread->margin.p05 : 0), limited_by(e),
                        probability_text(e.spread),
                        driven_text(e, length_text(e.tracking.deviation_max_m)),
                        driven_text(e, energy_text(e.tracking.energy_j)), e.name);
    if (e.refusal) text += fmt::format("{:>13} {}\n", "why:", sentence(*e.refusal));
    if (!e.spread) continue;
    const std::string doubt = too_doubtful_text(path);
    if (!doubt.empty()) text += fmt::format("{:>13} {}\n", "but:", doubt);
    if (!e.spread->influences.empty() && e.spread->influences.front().share > 0.01) {
      const SoilInfluence& most = e.spread->influences.front();
      text += fmt::format("{:>13} {} of {}: {:.0f} % of the margin's variance\n",
                          "varies with:", most.parameter, most.soil, 100 * most.share);
    }
    if (e.spread->direct_draws < e.spread->draws) {
      const PathMargins& error = e.spread->surrogate_error;
      text += fmt::format(
          "{:>13} {} of {} draws by the wheel model; error of the others, taken "
          "off: {:.4f}\n",
          "draws:", e.spread->direct_draws, e.spread->draws,
          std::max({error.cornering, error.tip_over, error.traction}));
    }
  }
  if (const std::string ties = tie_sentence(result); !ties.empty()) text += ties + "\n";
  return text;
}

double checked_speed_mps(const EvaluationRequest& request, const PlanningProblem& problem) {
  if (!request.speed_mps) return problem.speed_max_mps;
  if (*request.speed_mps > problem.vehicle.speed_max_mps) {
    throw InputError(
        fmt::format("--speed: {} is not valid (allowed: above 0 to {}, the largest of "
                    "{})",
                    *request.speed_mps, problem.vehicle.speed_max_mps, problem.vehicle.name));
  }
  return *request.speed_mps;
}

EvaluatedPath evaluated(PathEvaluation evaluation, const PlanningProblem& problem) {
  return {.evaluation = std::move(evaluation),
          .vehicle = problem.vehicle.name,
          .gravity_mps2 = problem.gravity_mps2,
          .limits = problem.limits,
          .recorded_margin_min = {}};
}

/// What is to be judged.
struct GivenCourses {
  double speed_max_mps = 0;
  std::vector<GivenPath> paths;
  std::vector<Manoeuvre> manoeuvres;
};

GivenCourses read_courses(const EvaluationRequest& request, const PlanningProblem& problem) {
  GivenCourses given{.speed_max_mps = checked_speed_mps(request, problem)};
  for (const std::string& file : request.path_files) {
    given.paths.push_back(read_path(file, problem, given.speed_max_mps));
  }
  if (request.manoeuvre_file) given.manoeuvres = read_manoeuvres(*request.manoeuvre_file, problem);
  return given;
}

/// Vehicles of manoeuvres that are not the scenario's, each once.
std::vector<Vehicle> vehicles_of(const GivenCourses& given, const PlanningProblem& problem) {
  std::vector<Vehicle> vehicles;
  for (const Manoeuvre& manoeuvre : given.manoeuvres) {
    const std::string& name = manoeuvre.vehicle.name;
    if (name != problem.vehicle.name &&
        std::ranges::find(vehicles, name, &Vehicle::name) == vehicles.end()) {
      vehicles.push_back(manoeuvre.vehicle);
    }
  }
  return vehicles;
}

/// The scenario's files, then those of what is judged.
std::vector<InputFile> inputs_of(const Scenario& scenario, const EvaluationRequest& request) {
  std::vector<InputFile> inputs = scenario.inputs;
  for (const std::string& file : request.path_files) {
    inputs.push_back({.key = "path " + std::filesystem::path(file).filename().string(),
                      .path = file,
                      .shown = file});
  }
  if (request.manoeuvre_file) {
    inputs.push_back(
        {.key = "manoeuvres", .path = *request.manoeuvre_file, .shown = *request.manoeuvre_file});
  }
  return inputs;
}

/// On a plane of its own. Another vehicle brings its own limits; the margin asked for is the
/// scenario's.
EvaluatedPath judged_manoeuvre(const Manoeuvre& manoeuvre, const PlanningProblem& problem,
                               const EvaluationSettings& settings) {
  Limits limits = problem.limits;
  if (manoeuvre.vehicle.name != problem.vehicle.name) {
    limits = default_limits(manoeuvre.vehicle);
    limits.margin_min = problem.limits.margin_min;
  }
  const PreparedManoeuvre prepared = prepare(manoeuvre, limits, problem);
  const World plane(prepared.problem, WorldUse::kVerdict, 1);
  PathEvaluation evaluation = std::visit(
      [&](const auto& course) { return evaluate(plane, course, settings); }, prepared.course);
  EvaluatedPath path = evaluated(std::move(evaluation), prepared.problem);
  path.plane = {.slope_rad = manoeuvre.slope_rad,
                .uphill_rad = manoeuvre.slope_heading_rad,
                .on_the_spot = manoeuvre.kind == ManoeuvreKind::kPointTurn};
  return path;
}

/// One after the other; what an interrupt cuts short is not kept.
void judge_all(const GivenCourses& given, const PlanningProblem& problem, bool quiet,
               EvaluationResult& result) {
  const std::stop_token stop = result.settings.stop;
  ProgressLine line(quiet);
  const std::size_t count = given.paths.size() + given.manoeuvres.size();
  const auto judge = [&](const auto& judged) {
    if (stop.stop_requested()) return;
    const auto feasible = std::ranges::count_if(
        result.paths, [](const EvaluatedPath& path) { return path.evaluation.feasible; });
    line.show({.stage = "evaluating",
               .share = static_cast<double>(result.paths.size()) / static_cast<double>(count),
               .found = static_cast<int>(feasible)});
    EvaluatedPath path = judged();
    if (!stop.stop_requested()) result.paths.push_back(std::move(path));
  };
  const PlanningProblem tolerant = with_speed_max(problem, kSpeedTolerance * given.speed_max_mps);
  const World world(tolerant, WorldUse::kVerdict, 1);
  for (const GivenPath& path : given.paths) {
    judge([&] {
      EvaluatedPath judged = evaluated(evaluate(world, path.path, result.settings), problem);
      judged.recorded_margin_min = path.recorded_margin_min;
      return judged;
    });
  }
  for (const Manoeuvre& manoeuvre : given.manoeuvres) {
    judge([&] { return judged_manoeuvre(manoeuvre, problem, result.settings); });
  }
  result.interrupted = stop.stop_requested();
}

}  // namespace

ExitStatus run_evaluation(const Scenario& scenario, const EvaluationRequest& request) {
  require_writable_folder(request.folder);
  const PlanningProblem& problem = scenario.problem;
  // Everything is read before anything is judged.
  const GivenCourses given = read_courses(request, problem);
  const std::vector<InputDigest> inputs = digests_of(inputs_of(scenario, request));
  require_results_fit(request.folder, {"evaluation.json", "report.html"});
  notify_of_kept_page(request.folder, "evaluate", request.quiet);
  for (const std::string& notice : scenario.notices) notify(notice, request.quiet);
  for (const GivenPath& path : given.paths) {
    for (const std::string& notice : path.notices) notify(notice, request.quiet);
  }

  const auto begun = std::chrono::steady_clock::now();
  EvaluationResult result{.settings = {.follower = {.kind = follower_named(request.follower)},
                                       .deviation_max_m = request.deviation_max_m,
                                       .soil_draws = request.soil_draws,
                                       .seed = problem.search.seed,
                                       .threads = problem.search.threads,
                                       .stop = stop_on_interrupt()},
                          .speed_max_mps = given.speed_max_mps,
                          .vehicles = vehicles_of(given, problem),
                          .inputs = inputs};
  judge_all(given, problem, request.quiet, result);
  rank(result);
  result.evaluation_time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  write_evaluation_files(problem, result, request.folder);
  if (request.json) {
    fmt::print("{}", evaluation_json(problem, result, request.folder.path));
  } else if (!request.quiet) {
    fmt::print("{}report: {}\n", summary(result), (request.folder.path / "report.html").string());
  }
  if (result.interrupted) return kInterrupted;
  return result.any_feasible() ? kYes : kNo;
}

}  // namespace regoplan
