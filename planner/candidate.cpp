#include "planner/candidate.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <tuple>

#include "planner/path_improvement.h"
#include "planner/path_margins.h"
#include "planner/rejection_text.h"
#include "planner/soil_uncertainty.h"
#include "planner/steer_back.h"
#include "terramech/parallel_for.h"

namespace regoplan {
namespace {

std::string why_overturned(const Replay& replay) {
  if (const auto& rejection = replay.rejection) {
    return fmt::format("{}, {:.2f} s", rejection_text(*rejection), replay.rejection_time_s);
  }
  const VehicleState& end = replay.end;
  return fmt::format("the goal is not reached: the path ends at ({:.2f}, {:.2f})", end.x_m,
                     end.y_m);
}

bool passes(const Replay& replayed) {
  return replayed.reached_goal && !replayed.rejection;
}

VerifiedPath verify(const World& verdict, const World& searched, const FoundPath& path) {
  const ReplaySteps fine = verification_steps(verdict);
  const Replay as_searched = replay(searched, path.controls, {.coarse_s = fine.coarse_s}, false);
  VerifiedPath verified{
      .candidate = {.planner = path.planner, .seed = path.seed, .controls = path.controls},
      .replay = replay(verdict, path.controls, fine)};
  if (!passes(verified.replay)) {
    verified.candidate.controls = steered_back(verdict, fine, path.controls, as_searched.coarse);
    verified.replay = replay(verdict, verified.candidate.controls, fine);
  }
  const Replay& replayed = verified.replay;
  Candidate& candidate = verified.candidate;
  candidate.points = replayed.points;
  candidate.length_m = replayed.length_m;
  candidate.duration_s = replayed.duration_s;
  candidate.energy_j = replayed.energy_j;
  candidate.verified.passed = passes(replayed);
  candidate.verified.deviation_max_m = deviation_max_m(replayed, as_searched);
  if (!candidate.verified.passed) candidate.verified.reason = why_overturned(replayed);
  if (candidate.points.empty()) return verified;
  candidate.margin_min = candidate.points[smallest_margin_index(candidate.points)].margin;
  candidate.verified.margin_min = candidate.margin_min;
  candidate.margin_worst_tenth = margin_of_worst_tenth(candidate.points);
  candidate.limiting = limiting_place(candidate.points);
  return verified;
}

/// The farthest that a path strays from another.
double stray_m(const Candidate& path, const Candidate& other) {
  double farthest = 0;
  for (const TrajectoryPoint& point : path.points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const TrajectoryPoint& there : other.points) {
      nearest = std::min(nearest, std::hypot(point.x_m - there.x_m, point.y_m - there.y_m));
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

bool differ(const Candidate& path, const Candidate& other) {
  constexpr double kLeast_m = 2, kShareOfWay = 0.04;
  const double apart = std::max(stray_m(path, other), stray_m(other, path));
  return apart >= std::max(kLeast_m, kShareOfWay * other.length_m);
}

}  // namespace

VerifiedPaths verify_all(const World& verdict, const World& searched,
                         const std::vector<FoundPath>& found,
                         const std::function<void(const PlanProgress&)>& on_progress) {
  std::vector<VerifiedPath> all(found.size());
  std::atomic<std::size_t> done = 0;
  const std::thread::id caller = std::this_thread::get_id();
  parallel_for(found.size(), verdict.problem().search.threads, [&](std::size_t i) {
    all[i] = verify(verdict, searched, found[i]);
    ++done;
    if (std::this_thread::get_id() != caller) return;  // progress is for one thread
    on_progress({.stage = "verifying",
                 .share = static_cast<double>(done) / static_cast<double>(found.size()),
                 .found = static_cast<int>(found.size())});
  });
  VerifiedPaths paths;
  for (VerifiedPath& path : all) {
    if (path.candidate.verified.passed) {
      paths.passed.push_back(std::move(path));
    } else {
      paths.overturned.push_back(std::move(path.candidate));
    }
  }
  return paths;
}

std::vector<VerifiedPath> improved_paths(const World& verdict, const World& searched,
                                         const std::vector<VerifiedPath>& paths) {
  std::vector<std::optional<VerifiedPath>> all(paths.size());
  parallel_for(paths.size(), verdict.problem().search.threads, [&](std::size_t i) {
    const Candidate& before = paths[i].candidate;
    const std::optional<ImprovedPath> found = improved(searched, before.controls);
    if (!found) return;
    VerifiedPath path =
        verify(verdict, searched,
               {.planner = before.planner, .seed = before.seed, .controls = found->controls});
    if (!path.candidate.verified.passed || path.candidate.margin_min < before.margin_min) return;
    path.candidate.improvement = found->improvement;
    all[i] = std::move(path);
  });
  std::vector<VerifiedPath> better;
  for (std::optional<VerifiedPath>& path : all) {
    if (path) better.push_back(std::move(*path));
  }
  return better;
}

std::vector<VerifiedPath> different_paths(std::vector<VerifiedPath> paths, int most) {
  std::stable_sort(paths.begin(), paths.end(), [](const VerifiedPath& a, const VerifiedPath& b) {
    return a.candidate.margin_min > b.candidate.margin_min;
  });
  std::vector<VerifiedPath> chosen;
  for (VerifiedPath& path : paths) {
    if (static_cast<int>(chosen.size()) == most) break;
    const auto differs = [&](const VerifiedPath& other) {
      return differ(path.candidate, other.candidate);
    };
    if (std::all_of(chosen.begin(), chosen.end(), differs)) chosen.push_back(std::move(path));
  }
  return chosen;
}

void add_spread(const PlanningProblem& problem, VerifiedPath& path) {
  const MarginSpread spread = margin_spread(problem, path.replay, problem.search.soil_draws,
                                            problem.search.seed, problem.search.threads);
  path.candidate.margin_p05 = spread.p05;
  path.candidate.probability_feasible = spread.probability_feasible;
}

void rank(std::vector<VerifiedPath>& paths) {
  constexpr double kTie = 0.01;
  const auto key = [](const VerifiedPath& path) {
    const Candidate& c = path.candidate;
    return std::tuple(-std::round(c.margin_p05 / kTie), -c.margin_worst_tenth, c.duration_s,
                      c.energy_j);
  };
  std::stable_sort(paths.begin(), paths.end(),
                   [&](const VerifiedPath& a, const VerifiedPath& b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < paths.size(); ++i) {
    paths[i].candidate.rank = static_cast<int>(i) + 1;
  }
}

}  // namespace regoplan
