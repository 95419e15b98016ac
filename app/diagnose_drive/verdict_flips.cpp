#include "app/diagnose_drive/verdict_flips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "drive_diagnosis/corrected_world.h"
#include "planner/problem/rejection_text.h"
#include "planner/problem/world.h"
#include "planner/soils/soil_uncertainty.h"
#include "planner/verdict/ranking.h"
#include "terramech/basics/parallel_for.h"

namespace regoplan {
namespace {

PlanningProblem problem_of(const TerrainMap& map, const Vehicle& vehicle, const DriveSetup& setup,
                           const Limits& limits) {
  // A drive may have gone faster than anybody would plan: its speed is no reason here.
  return {.map = map,
          .vehicle = vehicle,
          .gravity_mps2 = setup.gravity_mps2,
          .start = {},
          .goal = {},
          .speed_max_mps = 1e3,
          .limits = limits,
          .search = {}};
}

/// Where the vehicle was at a time off the middle of a window, smoothed.
VehicleState state_at(const DriveWindow& window, const Vehicle& vehicle, double off_s) {
  const double curvature = std::clamp(window.yaw_rate_rad_s / window.forward_mps,
                                      -vehicle.curvature_max_1pm, vehicle.curvature_max_1pm);
  const MapPlace place = window.place_at(off_s);
  const double yaw_rad = window.yaw.at(off_s);
  return {.x_m = place.x_m,
          .y_m = place.y_m,
          .yaw_rad = std::isfinite(yaw_rad) ? yaw_rad : window.yaw_rad,
          .motion = {.vx_mps = window.forward_mps,
                     .vy_mps = 0,
                     .yaw_rate_rad_s = curvature * window.forward_mps},
          .curvature_1pm = curvature,
          .rim_speed_mps = window.forward_mps};
}

/// What was driven in a window, at stations as far apart as `evaluate` judges a path at: what
/// breaks a limit for a second only is no mean of five.
std::vector<VehicleState> states_of(const DriveWindow& window, const Vehicle& vehicle) {
  constexpr double kApart_m = 0.5;
  const double way_m = std::abs(window.forward_mps) * window.duration_s();
  const int stations = std::max(1, static_cast<int>(std::ceil(way_m / kApart_m)));
  std::vector<VehicleState> states;
  for (int k = 0; k < stations; ++k) {
    const double share = (k + 0.5) / stations - 0.5;
    states.push_back(state_at(window, vehicle, share * window.duration_s()));
  }
  return states;
}

/// Why a window may not be driven at the soils' means, and else its state of the smallest margin.
struct WindowJudged {
  std::string why;  ///< empty: it may
  VehicleState tightest;
};

/// \pre there is a state
WindowJudged judged_at_means(const World& world, const std::vector<VehicleState>& states) {
  WindowJudged judged{.why = {}, .tightest = states.front()};
  double least = std::numeric_limits<double>::infinity();
  for (const VehicleState& state : states) {
    const Judgement judgement = world.judge(state, {}, 0);
    if (judgement.rejected) {
      judged.why = rejection_text(judgement.rejected->reason, judgement.rejected->exceeded);
      return judged;
    }
    if (!(judgement.point.margin < least)) continue;
    least = judgement.point.margin;
    judged.tightest = state;
  }
  return judged;
}

/// Why each window may not be driven, without its place; empty where it may.
std::vector<std::string> reasons(const PlanningProblem& problem,
                                 const std::vector<std::vector<VehicleState>>& windows,
                                 std::uint64_t seed, int threads) {
  constexpr int kDraws = 40;
  const World world(problem, WorldUse::kVerdict, threads);
  std::vector<WindowJudged> judged(windows.size());
  parallel_for(windows.size(), threads,
               [&](std::size_t i) { judged[i] = judged_at_means(world, windows[i]); });
  std::vector<std::string> why;
  std::vector<VehicleState> tightest;  // of windows that may be driven at the soils' means
  std::vector<std::size_t> index;
  for (const WindowJudged& window : judged) {
    why.push_back(window.why);
    if (!window.why.empty()) continue;
    tightest.push_back(window.tightest);
    index.push_back(why.size() - 1);
  }
  std::vector<std::vector<PathMargins>> margins(kDraws);
  parallel_for(margins.size(), threads, [&](std::size_t draw) {
    margins[draw] = margins_on(problem, tightest, soil_draw(problem, seed, static_cast<int>(draw)));
  });
  for (std::size_t i = 0; i < tightest.size(); ++i) {
    const auto kept = std::ranges::count_if(margins, [&](const std::vector<PathMargins>& of) {
      return of[i].smallest() >= problem.limits.margin_min;
    });
    if (static_cast<double>(kept) >= share_counted_on(problem.limits) * kDraws) continue;
    why[index[i]] = fmt::format("margins kept in {:.0f} % of the draws of the soils",
                                100.0 * static_cast<double>(kept) / kDraws);
  }
  return why;
}

}  // namespace

std::vector<VerdictFlip> verdict_flips(const DriveSetup& setup, const Limits& limits,
                                       const DriveDiagnosis& diagnosis, std::uint64_t seed,
                                       int threads) {
  const VehicleEffects& effects = *diagnosis.effects;
  std::vector<std::size_t> judged;
  std::vector<std::vector<VehicleState>> states;
  for (std::size_t i = 0; i < diagnosis.windows.size(); ++i) {
    const DriveWindow& window = diagnosis.windows[i];
    const bool moves = std::abs(window.forward_mps) > kMoving_mps * window.pace;
    if (!moves || !std::isfinite(window.yaw_rate_rad_s)) continue;
    if (!setup.map.inside(window.x_m, window.y_m)) continue;
    judged.push_back(i);
    states.push_back(states_of(window, *setup.vehicle));
  }
  const std::vector<std::string> before =
      reasons(problem_of(setup.map, *setup.vehicle, setup, limits), states, seed, threads);
  const std::vector<std::string> after =
      reasons(problem_of(corrected_map(setup.map, effects, diagnosis.windows),
                         corrected_vehicle(*setup.vehicle, effects), setup, limits),
              states, seed, threads);
  std::vector<VerdictFlip> flips;
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (before[i].empty() == after[i].empty()) continue;
    const DriveWindow& window = diagnosis.windows[judged[i]];
    const bool goes_on = last && *last + 1 == judged[i] && flips.back().drive == window.drive &&
                         flips.back().before.empty() == before[i].empty();
    last = judged[i];
    if (goes_on) {
      flips.back().ends_s = window.end_s;
      continue;
    }
    flips.push_back({.drive = window.drive,
                     .starts_s = window.start_s,
                     .ends_s = window.end_s,
                     .x_m = window.x_m,
                     .y_m = window.y_m,
                     .before = before[i],
                     .after = after[i]});
  }
  return flips;
}

}  // namespace regoplan
