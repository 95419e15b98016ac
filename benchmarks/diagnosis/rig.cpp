#include "benchmarks/diagnosis/rig.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "terramech/basics/angles.h"

namespace regoplan::challenge {
namespace {

struct Bed {
  Wheel wheel;
  Soil soil;
  double gravity_mps2;
};

Bed lab_sand(Random& random) {
  const double kx = log_uniform(random, 0.006, 0.018), ky = log_uniform(random, 0.006, 0.02);
  return {{uniform(random, 0.05, 0.13), uniform(random, 0.05, 0.13)},
          {.cohesion_pa = log_uniform(random, 150, 900),
           .friction_angle_rad = uniform(random, 28, 36) * kDegree,
           .kc = uniform(random, 500, 2500),
           .kphi = log_uniform(random, 5e5, 3e6),
           .n = uniform(random, 0.95, 1.3),
           .a0 = uniform(random, 0.35, 0.45),
           .a1 = uniform(random, 0.1, 0.25),
           .lambda = uniform(random, 0.2, 0.9),
           .density_kgpm3 = uniform(random, 1350, 1650),
           .kx0_m = kx,
           .kx1_m = kx * uniform(random, 0, 1),
           .ky0_m = ky,
           .ky1_m = ky * uniform(random, 0, 1)},
          9.80665};
}

Bed lunar_simulant(Random& random) {
  return {{uniform(random, 0.08, 0.125), uniform(random, 0.08, 0.12)},
          {.cohesion_pa = log_uniform(random, 300, 1200),
           .friction_angle_rad = uniform(random, 33, 40) * kDegree,
           .kc = uniform(random, 1000, 2000),
           .kphi = log_uniform(random, 6e5, 1.2e6),
           .n = uniform(random, 0.9, 1.1),
           .a0 = uniform(random, 0.36, 0.44),
           .a1 = uniform(random, 0.1, 0.2),
           .lambda = uniform(random, 0.5, 1),
           .density_kgpm3 = uniform(random, 1500, 1750),
           .kx0_m = uniform(random, 0.012, 0.036),
           .kx1_m = uniform(random, 0.01, 0.05),
           .ky0_m = uniform(random, 0.01, 0.02),
           .ky1_m = uniform(random, 0.01, 0.03)},
          chance(random, 0.7) ? 9.80665 : 1.62};
}

Bed martian_simulant(Random& random) {
  return {{uniform(random, 0.12, 0.25), uniform(random, 0.1, 0.25)},
          {.cohesion_pa = log_uniform(random, 200, 1500),
           .friction_angle_rad = uniform(random, 29, 37) * kDegree,
           .kc = uniform(random, 1000, 14000),
           .kphi = log_uniform(random, 6e5, 2.5e6),
           .n = uniform(random, 0.9, 1.2),
           .a0 = uniform(random, 0.35, 0.45),
           .a1 = uniform(random, 0.1, 0.3),
           .lambda = uniform(random, 0.3, 0.9),
           .density_kgpm3 = uniform(random, 1250, 1600),
           .kx0_m = log_uniform(random, 0.01, 0.025),
           .kx1_m = uniform(random, 0, 0.03),
           .ky0_m = log_uniform(random, 0.01, 0.025),
           .ky1_m = uniform(random, 0, 0.03)},
          chance(random, 0.6) ? 9.80665 : 3.72};
}

/// How well independent tests know each number.
Soil spread(Random& random, const Soil& s) {
  const double care = log_uniform(random, 0.6, 1.4);
  return {.cohesion_pa = care * 0.25 * s.cohesion_pa,
          .friction_angle_rad = care * 1.5 * kDegree,
          .kc = care * 0.25 * s.kc,
          .kphi = care * 0.15 * s.kphi,
          .n = care * 0.05,
          .a0 = care * 0.03,
          .a1 = care * 0.03,
          .lambda = care * 0.08,
          .density_kgpm3 = care * 30,
          .kx0_m = care * 0.2 * s.kx0_m,
          .kx1_m = care * 0.2 * s.kx1_m,
          .ky0_m = care * 0.2 * s.ky0_m,
          .ky1_m = care * 0.2 * s.ky1_m,
          .c0_m = care * 0.1 * s.c0_m};
}

/// A soil within two standard deviations of what is known.
Soil true_soil(Random& random, const UncertainSoil& known) {
  for (int i = 0; i < 1000; ++i) {
    Soil soil = known.mean;
    for (const SoilParameter& parameter : soil_parameters()) {
      soil.*parameter.member += bounded_normal(random) * known.standard_deviation.*parameter.member;
    }
    if (is_valid(soil)) return soil;  // rarely not: a0 + a1 s left the contact
  }
  return known.mean;
}

std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(count == 1 ? from : from + (to - from) * i / (count - 1));
  }
  return values;
}

std::vector<double> slips(Random& random, bool skid) {
  const bool braking = skid || chance(random, 0.4);
  std::vector<double> values = spaced(uniform(random, 0, 0.1), uniform(random, 0.55, 0.8),
                                      std::uniform_int_distribution<int>(5, 7)(random));
  if (braking) {
    for (const double s : spaced(-uniform(random, 0.4, 0.6), -0.12, skid ? 3 : 2)) {
      values.insert(values.begin(), s);
    }
    std::ranges::sort(values);
  }
  for (double& s : values) s = std::round(s * 100) / 100;
  return values;
}

std::vector<double> slip_angles_deg(Random& random, const Needs& needs) {
  std::vector<double> values = one_of<std::vector<double>>(
      random, {{0, 4, 8, 12, 16}, {0, 8, 16}, {0, 5, 10, 15, 20}, {0, 10, 20, 30}, {0, 6, 12, 18}});
  if (!needs.side && !needs.both_sides && chance(random, 0.25)) values = {0};
  if (!needs.both_sides && !chance(random, 0.25)) return values;
  for (std::size_t i = 1; i < values.size(); i += 2) values[i] *= -1;
  if (values.size() > 1) values.push_back(-values[values.size() - 1]);
  return values;
}

/// The load under which the wheel of the mean soil sinks to the given share of its radius.
double load_at(const Bed& bed, double sinkage_over_radius) {
  double low = 0.1, high = 1e5;
  for (int i = 0; i < 60; ++i) {
    const double load = std::sqrt(low * high);
    TruthPhysics p{.wheel = bed.wheel, .soil = bed.soil, .gravity_mps2 = bed.gravity_mps2};
    p.at.load_n = load;
    p.at.slip_ratio = 0.2;
    const auto c = truth_channels(p);
    (c && c->sinkage_m < sinkage_over_radius * bed.wheel.radius_m ? low : high) = load;
  }
  return std::round(std::sqrt(low * high) * 10) / 10;
}

struct Levels {
  std::vector<double> slip, angle_deg, load, speed;
  std::vector<int> pass;
};

/// A share of the grid in which every level of every factor stands as evenly as chance allows.
std::vector<RigCondition> design(Random& random, const Levels& levels, std::size_t count) {
  std::vector<RigCondition> grid;
  for (const double slip : levels.slip) {
    for (const double angle : levels.angle_deg) {
      for (const double load : levels.load) {
        for (const double speed : levels.speed) {
          for (const int pass : levels.pass) {
            grid.push_back({.load_n = load,
                            .slip_ratio = slip,
                            .slip_angle_rad = angle * kDegree,
                            .pass = pass,
                            .speed_mps = speed});
          }
        }
      }
    }
  }
  std::shuffle(grid.begin(), grid.end(), random);
  const auto same = [](const RigCondition& a, const RigCondition& b) {
    return (a.load_n == b.load_n) + (a.slip_ratio == b.slip_ratio) +
           (a.slip_angle_rad == b.slip_angle_rad) + (a.pass == b.pass) +
           (a.speed_mps == b.speed_mps);
  };
  std::vector<RigCondition> chosen;
  std::vector<double> crowding(grid.size(), 0);
  std::vector<bool> taken(grid.size(), false);
  while (chosen.size() < std::min(count, grid.size())) {
    std::size_t best = grid.size();
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!taken[i] && (best == grid.size() || crowding[i] < crowding[best])) best = i;
    }
    taken[best] = true;
    chosen.push_back(grid[best]);
    for (std::size_t i = 0; i < grid.size(); ++i)
      crowding[i] += std::pow(3, same(grid[i], grid[best]));
  }
  return chosen;
}

std::vector<Channel> channels_measured(Random& random, const Needs& needs) {
  using enum Channel;
  std::vector<Channel> channels =
      one_of<std::vector<Channel>>(random, {{kFx, kFy, kTorque, kSinkage},
                                            {kFx, kFy, kTorque, kSinkage},
                                            {kFx, kFy, kSinkage},
                                            {kFx, kFy, kTorque}});
  const auto add = [&](Channel channel) {
    if (!std::ranges::count(channels, channel)) channels.push_back(channel);
  };
  if (needs.torque) add(kTorque);
  if (needs.sinkage) add(kSinkage);
  std::ranges::sort(channels);
  return channels;
}

}  // namespace

int Rig::day_of(int replicate, std::size_t order) const {
  return replicate_by_day ? replicate : static_cast<int>(order * kDays / runs());
}

RigCondition Rig::at_run(const RigCondition& condition, int replicate, std::size_t order) const {
  RigCondition run = condition;
  run.day = day_of(replicate, order);
  if (own_times) {
    run.time_s = static_cast<double>(order) * kBetweenRuns_s + run.day * overnight_s;
  }
  return run;
}

double Rig::series_s() const {
  if (!own_times) return static_cast<double>(conditions.size()) * kBetweenRuns_s;
  return static_cast<double>(runs()) * kBetweenRuns_s + (kDays - 1) * overnight_s;
}

Needs operator|(const Needs& a, const Needs& b) {
  return {.side = a.side || b.side,
          .both_sides = a.both_sides || b.both_sides,
          .skid = a.skid || b.skid,
          .torque = a.torque || b.torque,
          .sinkage = a.sinkage || b.sinkage,
          .loads = a.loads || b.loads,
          .passes = a.passes || b.passes,
          .speeds = a.speeds || b.speeds,
          .positions = a.positions || b.positions,
          .times = a.times || b.times,
          .sweep = a.sweep || b.sweep};
}

Rig draw_rig(Random& random, const Needs& needs) {
  Bed bed = one_of<Bed (*)(Random&)>(random, {lab_sand, lunar_simulant, martian_simulant})(random);
  bed.wheel.radius_m = std::round(bed.wheel.radius_m * 1000) / 1000;
  bed.wheel.width_m = std::round(bed.wheel.width_m * 1000) / 1000;
  Rig rig;
  rig.setup.wheel = bed.wheel;
  rig.setup.gravity_mps2 = bed.gravity_mps2;
  if (chance(random, 0.1)) {
    rig.setup.variant = WheelVariant::kYoshida2004;
    bed.soil.c0_m = uniform(random, 0.05, 0.2) * bed.wheel.radius_m;
  }
  rig.setup.soil = {bed.soil, spread(random, bed.soil)};
  rig.soil = true_soil(random, rig.setup.soil);
  rig.middle_sinkage_m = uniform(random, 0.07, 0.16) * bed.wheel.radius_m;
  rig.middle_load_n = load_at(bed, rig.middle_sinkage_m / bed.wheel.radius_m);

  const double w = rig.middle_load_n;
  Levels levels{.slip = slips(random, needs.skid),
                .angle_deg = slip_angles_deg(random, needs),
                .load = {w},
                .speed = {std::round(log_uniform(random, 0.01, 0.1) * 1000) / 1000},
                .pass = {1}};
  if (needs.loads || chance(random, 0.3)) levels.load = {0.5 * w, w, 1.7 * w};
  if (!needs.loads && chance(random, 0.2)) levels.load = {0.7 * w, 1.3 * w};
  constexpr std::size_t kFewestConditions = 14;
  if (levels.slip.size() * levels.angle_deg.size() < kFewestConditions) {
    levels.load = {0.5 * w, w, 1.7 * w};
  }
  if (needs.times) levels.load.insert(levels.load.begin(), 0.3 * w);  // cohesion: small loads most
  rig.columns.speed = needs.speeds || chance(random, 0.4);
  if (needs.speeds || (rig.columns.speed && chance(random, 0.4))) {
    levels.speed = {0.02, 0.05, 0.12, 0.3};
  }
  rig.columns.pass = needs.passes || chance(random, 0.2);
  if (rig.columns.pass) levels.pass = {1, 2, 3};

  rig.replicates = chance(random, 0.75) ? 3 : (chance(random, 0.7) ? 2 : 1);
  const int runs = std::uniform_int_distribution<int>(60, 130)(random);
  const int most = std::max(18, runs / rig.replicates);
  rig.conditions = design(random, levels, static_cast<std::size_t>(std::min(most, 43)));
  constexpr std::size_t kFewestRuns = 40;
  while (rig.conditions.size() * static_cast<std::size_t>(rig.replicates) < kFewestRuns) {
    ++rig.replicates;
  }
  rig.same_order = needs.sweep || chance(random, 0.3);
  rig.replicate_by_day = chance(random, 0.5);
  rig.columns.day = chance(random, 0.75);
  rig.columns.position = needs.positions || chance(random, 0.15);
  rig.columns.time = needs.times || chance(random, 0.15);
  double before = 0, time_s = 0;
  for (RigCondition& condition : rig.conditions) {
    condition.previous_slip_ratio = before;
    before = condition.slip_ratio;
    condition.position_m = std::round(uniform(random, 0, 2) * 100) / 100;
    condition.time_s = time_s;
    time_s += kBetweenRuns_s;
  }
  rig.channels = channels_measured(random, needs);
  if (levels.angle_deg.size() == 1) std::erase(rig.channels, Channel::kFy);
  return rig;
}

}  // namespace regoplan::challenge
