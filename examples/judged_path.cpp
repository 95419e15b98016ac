// A path of one's own, given as points, judged at two speeds.
#include <cstdio>

#include "level_map.h"

namespace {

regoplan::PathEvaluation judged(double speed_mps) {
  using namespace regoplan;
  PlanningProblem problem = thirty_metres();
  const World world(problem, WorldUse::kVerdict, 1);
  PathCurve curve({{10, 25}, {20, 25}, {27, 28}, {30, 35}, {30, 45}});  // a turn to the left
  const double length_m = curve.length_m();
  const ReferencePath path{
      .name = "turn",
      .legs = {{std::move(curve), SpeedProfile({{0, speed_mps}, {length_m, speed_mps}})}}};
  return evaluate(world, path, {.soil_draws = 20});
}

}  // namespace

int main() {
  for (const double speed_mps : {1.0, 2.9}) {
    const regoplan::PathEvaluation e = judged(speed_mps);
    std::printf("at %.1f m/s: %s, smallest margin %.3f\n", speed_mps,
                e.feasible ? "feasible" : sentence(*e.refusal).c_str(), e.margin_min);
    if (e.feasible != (speed_mps < 2)) return 1;
  }
  return 0;
}
