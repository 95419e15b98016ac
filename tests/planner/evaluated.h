// Paths and manoeuvres of an LRV on flat ground, evaluated.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "planner/evaluation/evaluation.h"
#include "planner/evaluation/manoeuvres.h"
#include "tests/planner/flat_problem.h"

namespace regoplan {

inline UncertainSoil uncertain_regolith() {
  UncertainSoil soil = firm_regolith();
  soil.standard_deviation.cohesion_pa = 50;
  soil.standard_deviation.friction_angle_rad = 2 * kTestDegree;
  soil.standard_deviation.ky0_m = 0.003;
  return soil;
}

inline const EvaluationSettings kSettings{.soil_draws = 30, .seed = 3};

inline ReferencePath reference(const std::vector<PathPoint>& points, double speed_mps) {
  PathCurve curve(points);
  SpeedProfile speed({{0, speed_mps}, {curve.length_m(), speed_mps}});
  return {.name = "path", .legs = {{std::move(curve), std::move(speed)}}};
}

inline PathEvaluation evaluated(const PlanningProblem& problem, const ReferencePath& path,
                                const EvaluationSettings& settings = kSettings) {
  const World world(problem, WorldUse::kVerdict, 1);
  return evaluate(world, path, settings);
}

inline PlanningProblem flat_problem(const UncertainSoil& soil = firm_regolith()) {
  PlanningProblem problem = lrv_problem(one_soil_map(60, soil, flat));
  problem.speed_max_mps *= kSpeedTolerance;
  return problem;
}

inline Manoeuvre turn(double speed_mps, double radius_m = 15) {
  return {.kind = ManoeuvreKind::kSteadyTurn,
          .name = "turn",
          .vehicle = preset_vehicle("lrv"),
          .soil = {.name = "regolith", .source = "test", .soil = uncertain_regolith()},
          .speed_mps = speed_mps,
          .radius_m = radius_m,
          .angle_rad = 90 * kTestDegree};
}

inline PathEvaluation evaluated(const Manoeuvre& manoeuvre,
                                const EvaluationSettings& settings = kSettings) {
  const PlanningProblem base = flat_problem();
  const PreparedManoeuvre prepared = prepare(manoeuvre, base.limits, base);
  const World world(prepared.problem, WorldUse::kVerdict, 1);
  return std::visit([&](const auto& course) { return evaluate(world, course, settings); },
                    prepared.course);
}

}  // namespace regoplan
