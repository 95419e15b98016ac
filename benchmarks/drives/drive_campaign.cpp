// Campaigns of drives, one a word of the command line. Figures stand in README.md.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>

#include "benchmarks/drives/independent_simulator.h"
#include "driving/drive.h"
#include "driving/true_world.h"
#include "planner/evaluation/manoeuvres.h"
#include "terramech/basics/angles.h"
#include "tests/terramech/named_soils.h"

namespace regoplan::drives {
namespace {

/// The soils of scenarios/demo/soils.yaml that the campaigns use.
UncertainSoil firm_regolith() {
  return {.mean = named_soils::firm_regolith(),
          .standard_deviation = {.cohesion_pa = 50,
                                 .friction_angle_rad = 2 * kDegree,
                                 .kc = 350,
                                 .kphi = 2e5,
                                 .n = 0,
                                 .a0 = 0.05,
                                 .a1 = 0.05,
                                 .lambda = 0.1,
                                 .density_kgpm3 = 50,
                                 .kx0_m = 0.0045,
                                 .kx1_m = 0.011,
                                 .ky0_m = 0.0033,
                                 .ky1_m = 0.005}};
}

UncertainSoil loose_regolith() {
  return {.mean = named_soils::loose_regolith(),
          .standard_deviation = {.cohesion_pa = 40,
                                 .friction_angle_rad = 2 * kDegree,
                                 .kc = 225,
                                 .kphi = 1.1e5,
                                 .n = 0,
                                 .a0 = 0.05,
                                 .a1 = 0.05,
                                 .lambda = 0.1,
                                 .density_kgpm3 = 60,
                                 .kx0_m = 0.006,
                                 .kx1_m = 0.011,
                                 .ky0_m = 0.0045,
                                 .ky1_m = 0.005}};
}

/// Every number within one standard deviation of its mean, uniformly.
Soil drawn(const UncertainSoil& soil, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> off(-1, 1);
  Soil result = soil.mean;
  for (const SoilParameter& parameter : soil_parameters()) {
    result.*parameter.member += off(random) * soil.standard_deviation.*parameter.member;
  }
  return result;
}

SensorSuite grade_a() {
  const SensorChannel ten{.rate_hz = 10};
  SensorSuite suite{.position = SensorChannel{.rate_hz = 1, .noise = 0.02},
                    .yaw = SensorChannel{.rate_hz = 1, .noise = kDegree},
                    .wheel_speed = ten};
  suite.wheel_speed->noise = 0.01;
  return suite;
}

PlanningProblem base_problem(const Vehicle& vehicle, const UncertainSoil& soil, double gravity) {
  // A plane of one cell stands in until a manoeuvre brings its own.
  ElevationRaster flat{.frame = {.columns = 2, .rows = 2, .cell_width_m = 1, .cell_height_m = 1},
                       .height_m = {0, 0, 0, 0}};
  flat.frame.north_m = 2;
  return {.map = TerrainMap(flat, std::nullopt,
                            {.soils = {{"soil", "", soil}}, .classes = {}, .unmapped = 0}, {}),
          .vehicle = vehicle,
          .gravity_mps2 = gravity,
          .speed_max_mps = vehicle.speed_max_mps,
          .limits = default_limits(vehicle)};
}

struct Case {
  std::string name;
  Manoeuvre manoeuvre;
  double gravity_mps2 = 1.62;
};

std::vector<Case> cases_of(const std::string& vehicle_name) {
  const bool fast = vehicle_name == "lrv";
  const Vehicle vehicle = preset_vehicle(vehicle_name);
  const double gravity = fast ? 1.62 : 3.71, speed = fast ? 1.5 : 0.04;
  const MapSoil firm{"firm", "", firm_regolith()}, loose{"loose", "", loose_regolith()};
  const Manoeuvre any{.vehicle = vehicle, .soil = firm, .speed_mps = speed};
  Manoeuvre slope = any, slalom = any, soft = any, braking = any;
  slope.kind = ManoeuvreKind::kSlopeTraverse;
  slope.slope_rad = 15 * kDegree;
  slope.slope_heading_rad = 90 * kDegree;
  slope.length_m = fast ? 60 : 15;
  slalom.kind = ManoeuvreKind::kSlalom;
  slalom.amplitude_m = fast ? 1.5 : 0.5;
  slalom.wavelength_m = fast ? 20 : 8;
  slalom.waves = 2;
  soft.kind = ManoeuvreKind::kSteadyTurn;
  soft.soil = loose;
  soft.radius_m = fast ? 12 : 5;
  soft.angle_rad = 120 * kDegree;
  braking.kind = ManoeuvreKind::kBrakingInATurn;
  braking.radius_m = fast ? 12 : 4;
  braking.speed_mps = fast ? 2 : 0.04;
  braking.angle_rad = 60 * kDegree;
  braking.braking_mps2 = fast ? 0.1 : 0.001;
  return {{"side slope 15 deg", slope, gravity},
          {"slalom", slalom, gravity},
          {"soft soil", soft, gravity},
          {"braking in a turn", braking, gravity}};
}

/// A case made ready, with the world as it is planned in.
struct Course {
  explicit Course(const Case& one)
      : base(base_problem(one.manoeuvre.vehicle, one.manoeuvre.soil.soil, one.gravity_mps2)),
        prepared(prepare(one.manoeuvre, base.limits, base)),
        planned(prepared.problem, WorldUse::kVerdict, 1),
        path(std::get<ReferencePath>(prepared.course)) {
    path.goes_on = true;
  }
  PlanningProblem base;
  PreparedManoeuvre prepared;
  World planned;
  ReferencePath path;
};

double rms_m(const Course& course, const UncertainSoil& soil, FollowerChoice follower,
             std::uint64_t draw) {
  const PlanningProblem& problem = course.prepared.problem;
  const Soil truth = drawn(soil, draw);
  const double longest_s = problem.vehicle.speed_max_mps > 1 ? 0.025 : 0.25;
  const IndependentSimulator simulator(
      problem.vehicle, {truth}, problem.gravity_mps2,
      [&](double x, double y, double yaw) { return course.planned.dynamics().ground(x, y, yaw); },
      longest_s);
  const DriveResult result = drive(course.planned, simulator, course.path, false,
                                   {.follower = follower,
                                    .sensors = grade_a(),
                                    .deviation_max_m = 5,
                                    .seed = draw,
                                    .judge_margins = false});
  if (!result.reached) {
    fmt::print(stderr, "draw {}: {} at {:.1f} m\n", draw, result.reason ? name(*result.reason) : "",
               result.s_m);
    return 5;
  }
  return result.cross_track_rms_m;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

void compare_followers(int draws, const SteeringLaw& law) {
  fmt::print("{:>10} {:>18} {:>10} {:>12} {:>8} {:>10}\n", "vehicle", "manoeuvre", "pursuit_m",
             "compensated_m", "gain", "worst_m");
  std::fflush(stdout);
  for (const std::string vehicle : {"lrv", "curiosity"}) {
    for (const Case& one : cases_of(vehicle)) {
      const Course course(one);
      std::vector<double> before, after, gain, worse;
      for (int i = 0; i < draws; ++i) {
        const auto seed = static_cast<std::uint64_t>(i + 1);
        const UncertainSoil& soil = one.manoeuvre.soil.soil;
        before.push_back(rms_m(course, soil, {FollowerKind::kPursuit, law}, seed));
        after.push_back(rms_m(course, soil, {FollowerKind::kCompensated, law}, seed));
        gain.push_back(1 - after.back() / before.back());
        worse.push_back(after.back() - before.back());
      }
      fmt::print("{:>10} {:>18} {:>10.4f} {:>12.4f} {:>8.2f} {:>10.4f}\n", vehicle, one.name,
                 median(before), median(after), median(gain), std::ranges::max(worse));
      std::fflush(stdout);
    }
  }
}

/// The gains that keep pursuit nearest to its paths, in the mean over the cases.
void tune(int draws) {
  for (const double wheelbases : {0.35, 0.5, 0.7, 1.0, 1.4}) {
    for (const double damping : {0.7, 1.0}) {
      const SteeringLaw law{.lookahead_wheelbases = wheelbases, .damping = damping};
      double sum = 0;
      std::string each;
      for (const std::string vehicle : {"lrv", "curiosity"}) {
        for (const Case& one : cases_of(vehicle)) {
          const Course course(one);
          std::vector<double> values;
          for (int i = 0; i < draws; ++i) {
            values.push_back(rms_m(course, one.manoeuvre.soil.soil, {FollowerKind::kPursuit, law},
                                   static_cast<std::uint64_t>(i + 1)));
          }
          sum += median(values);
          each += fmt::format(" {:.4f}", median(values));
        }
      }
      fmt::print("L {:.2f} wheelbases, damping {:.1f}: mean {:.4f} m  ({} )\n", wheelbases, damping,
                 sum / 8, each);
      std::fflush(stdout);
    }
  }
}

/// Open loop on the same soil, weaving along 200 m of a plane that falls 5 deg to the right.
/// The steering goes from one side to the other at its full rate, so that what it does within a
/// step is no matter of the integrator.
void equal_physics() {
  for (const std::string name : {"lrv", "curiosity"}) {
    const bool fast = name == "lrv";
    const Vehicle vehicle = preset_vehicle(name);
    const double gravity = fast ? 1.62 : 3.71, v = fast ? 1.5 : 0.04, slope = std::tan(5 * kDegree);
    const auto ground = [&](double, double, double yaw) {
      return GroundPatch{.known = true,
                         .slope_forward = slope * std::sin(yaw),
                         .slope_left = slope * std::cos(yaw)};
    };
    const Soil soil = firm_regolith().mean;
    const WheelModel model({.wheel = vehicle.wheel, .soil = soil, .gravity_mps2 = gravity});
    const std::vector<WheelLaw> laws{WheelLaw(model)};
    const VehicleDynamics terramech(vehicle, laws, ground, gravity);
    const double step_s = fast ? 0.025 : 0.25;
    const IndependentSimulator simulator(vehicle, {soil}, gravity, ground, step_s);
    VehicleState a = terramech.rolling_state(0, 0, 0, v), b = a;
    double way = 0, apart = 0, time_s = 0, ours_s = 0;
    while (way < 200) {
      const bool to_left = std::fmod(way + 10, 40) < 20;
      const double k = (to_left ? 0.15 : -0.15) * vehicle.curvature_max_1pm;
      const VehicleControl control{.speed_target_mps = v, .curvature_target_1pm = k};
      const auto begun = std::chrono::steady_clock::now();
      const StepResult ours = simulator.step(b, control, step_s);
      ours_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
      const StepResult other = terramech.step(a, control, step_s);
      if (!ours.converged || !other.converged) {
        fmt::print("{}: no balance after {:.1f} m ({} {})\n", name, way, ours.converged,
                   other.converged);
        break;
      }
      way += std::hypot(other.state.x_m - a.x_m, other.state.y_m - a.y_m);
      a = other.state;
      b = ours.state;
      time_s += step_s;
      apart = std::max(apart, std::hypot(a.x_m - b.x_m, a.y_m - b.y_m));
    }
    fmt::print(
        "{}: {:.1f} m in {:.0f} s: at most {:.4f} m apart; simulator {:.0f} times real time\n",
        name, way, time_s, apart, time_s / ours_s);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace regoplan::drives

int main(int argc, char** argv) {
  using namespace regoplan::drives;
  const std::string what = argc > 1 ? argv[1] : "";
  const int draws = argc > 2 ? std::atoi(argv[2]) : 50;
  if (what == "equal_physics") {
    equal_physics();
  } else if (what == "followers") {
    compare_followers(draws, {});
  } else if (what == "tune") {
    tune(draws);
  } else {
    fmt::print(stderr, "drive_campaign equal_physics | followers [DRAWS] | tune [DRAWS]\n");
    return 1;
  }
  return 0;
}
