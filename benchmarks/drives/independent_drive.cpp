// Drives a path in the independent simulator, over ground and with a vehicle that a truth file
// conceals, and records it as `regoplan drive` does.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "app/drive/drive_files.h"
#include "app/evaluate/path_files.h"
#include "app/settings/scenario_settings.h"
#include "app/settings/sensor_settings.h"
#include "app/settings/truth_settings.h"
#include "benchmarks/drives/independent_ground.h"
#include "benchmarks/drives/independent_simulator.h"
#include "planner/problem/changed_problem.h"
#include "terramech/basics/input_error.h"

namespace regoplan::drives {
namespace {

struct Options {
  std::string scenario, path, truth, sensors, out;
  double roughness_m = 0;
  std::uint64_t seed = 1;
};

/// A drive begins as if it had been set upon the ground at its speed: no wheel slips yet and none
/// carries what turning and slopes transfer, so that torques jump in the first few tenths of a
/// second. No vehicle that drives does so: the recording begins once forces balance, with the
/// row at 1 s: ten times the lag of load transfer later.
constexpr double kBalanced_s = 0.95;

int run(const Options& options) {
  const Scenario scenario = read_scenario(options.scenario, {.seed = options.seed});
  GivenPath given = read_path(options.path, scenario.problem, scenario.problem.speed_max_mps);
  given.path.goes_on = true;  // the simulator's wheels roll
  const PlanningProblem problem =
      with_speed_max(scenario.problem, 1.05 * scenario.problem.speed_max_mps);
  const DriveTruth truth = read_truth(options.truth, problem);
  const IndependentGround ground(problem, truth, options.roughness_m, options.seed);
  const double longest_step_s = problem.vehicle.speed_max_mps > 1 ? 0.05 : 0.25;
  const IndependentSimulator world(problem.vehicle, ground.soils(), problem.gravity_mps2,
                                   std::cref(ground), longest_step_s, truth);
  DriveRecord record{.scenario = options.scenario,
                     .path = options.path,
                     .sensors = options.sensors,
                     .ends_in_goal = false,
                     .settings = {.sensors = read_sensors(options.sensors),
                                  .deviation_max_m = 5,
                                  .seed = options.seed,
                                  .judge_margins = false}};
  const World planned(problem, WorldUse::kVerdict, 1);
  record.result = drive(planned, world, given.path, false, record.settings);
  std::erase_if(record.result.rows, [](const SensedRow& row) { return row.time_s < kBalanced_s; });
  std::ofstream(options.out) << drive_csv(record, problem.vehicle);
  fmt::print("{:.1f} m in {:.1f} s {}\n", record.result.length_m, record.result.duration_s,
             record.result.reached ? "to its end" : name(*record.result.reason));
  return record.result.reached ? 0 : 2;
}

}  // namespace
}  // namespace regoplan::drives

int main(int argc, char** argv) {
  regoplan::drives::Options options;
  CLI::App program("Drives a path in the independent simulator; exit 2: not to its end.");
  program.add_option("SCENARIO.yaml", options.scenario)->required();
  program.add_option("PATH.csv", options.path)->required();
  program.add_option("--truth", options.truth)->required();
  program.add_option("--sensors", options.sensors, "file of sensors")->required();
  program.add_option("--roughness-m", options.roughness_m, "of the ground, not on the map");
  program.add_option("--seed", options.seed);
  program.add_option("--out", options.out, "drive.csv")->required();
  CLI11_PARSE(program, argc, argv);
  try {
    return regoplan::drives::run(options);
  } catch (const regoplan::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
