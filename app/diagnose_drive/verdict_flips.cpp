#include "app/diagnose_drive/verdict_flips.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "drive_diagnosis/corrected_world.h"
#include "planner/problem/rejection_text.h"
#include "planner/problem/world.h"
#include "planner/soils/soil_uncertainty.h"
#include "planner/verdict/ranking.h"

namespace regoplan {
namespace {

constexpr double kStanding_mps = 0.1;

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

VehicleState state_of(const DriveWindow& window, const Vehicle& vehicle) {
  const double curvature = std::clamp(window.yaw_rate_rad_s / window.forward_mps,
                                      -vehicle.curvature_max_1pm, vehicle.curvature_max_1pm);
  return {.x_m = window.x_m,
          .y_m = window.y_m,
          .yaw_rad = window.yaw_rad,
          .motion = {.vx_mps = window.forward_mps,
                     .vy_mps = 0,
                     .yaw_rate_rad_s = curvature * window.forward_mps},
          .curvature_1pm = curvature,
          .rim_speed_mps = window.forward_mps};
}

/// Why each state may not be driven, without its place; empty where it may.
std::vector<std::string> reasons(const PlanningProblem& problem,
                                 const std::vector<VehicleState>& states, std::uint64_t seed) {
  constexpr int kDraws = 40;
  const World world(problem, WorldUse::kVerdict, 1);
  std::vector<std::string> why;
  std::vector<VehicleState> allowed;  // at the soils' means
  std::vector<std::size_t> index;
  for (const VehicleState& state : states) {
    const auto rejected = world.judge(state, {}, 0).rejected;
    why.push_back(rejected ? rejection_text(rejected->reason, rejected->exceeded) : "");
    if (rejected) continue;
    allowed.push_back(state);
    index.push_back(why.size() - 1);
  }
  std::vector<int> kept(allowed.size());
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::vector<PathMargins> margins =
        margins_on(problem, allowed, soil_draw(problem, seed, draw));
    for (std::size_t i = 0; i < allowed.size(); ++i) {
      kept[i] += margins[i].smallest() >= problem.limits.margin_min;
    }
  }
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    if (kept[i] >= share_counted_on(problem.limits) * kDraws) continue;
    why[index[i]] =
        fmt::format("margins kept in {:.0f} % of the draws of the soils", 100.0 * kept[i] / kDraws);
  }
  return why;
}

}  // namespace

std::vector<VerdictFlip> verdict_flips(const DriveSetup& setup, const Limits& limits,
                                       const DriveDiagnosis& diagnosis, std::uint64_t seed) {
  const VehicleEffects& effects = *diagnosis.effects;
  std::vector<std::size_t> judged;
  std::vector<VehicleState> states;
  for (std::size_t i = 0; i < diagnosis.windows.size(); ++i) {
    const DriveWindow& window = diagnosis.windows[i];
    const bool moves = std::abs(window.forward_mps) > kStanding_mps;
    if (!moves || !std::isfinite(window.yaw_rate_rad_s)) continue;
    if (!setup.map.inside(window.x_m, window.y_m)) continue;
    judged.push_back(i);
    states.push_back(state_of(window, *setup.vehicle));
  }
  const std::vector<std::string> before =
      reasons(problem_of(setup.map, *setup.vehicle, setup, limits), states, seed);
  const std::vector<std::string> after =
      reasons(problem_of(corrected_map(setup.map, effects, diagnosis.windows),
                         corrected_vehicle(*setup.vehicle, effects), setup, limits),
              states, seed);
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
