#include "benchmarks/diagnosis/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terramech/basics/angles.h"

namespace regoplan::challenge {
namespace {

std::size_t at(Channel channel) {
  return static_cast<std::size_t>(channel);
}

/// Six significant digits.
double as_in_file(double value) {
  return std::stod(fmt::format("{:.6g}", value));
}
double angle_as_in_file(double rad) {
  return std::round(rad / kDegree * 1000) / 1000 * kDegree;
}

/// The slip ratio of a wheel whose rim is faster than told.
double true_slip(double told, double rim_factor) {
  const double told_rim = told >= 0 ? 1 : 1 + told, forward = told >= 0 ? 1 - told : 1;
  const double rim = told_rim * rim_factor;
  return rim >= forward ? (rim - forward) / rim : (rim - forward) / forward;
}

double heavy_tailed(Random& random, double dof) {
  if (dof == 0) return normal(random);
  // scaled to standard deviation 1
  return std::student_t_distribution<double>(dof)(random) * std::sqrt((dof - 2) / dof);
}

}  // namespace

MeasurementNoise draw_noise(Random& random, const Rig& rig) {
  const double w = rig.middle_load_n, r = rig.setup.wheel.radius_m, h = rig.middle_sinkage_m;
  const double level = log_uniform(random, 0.6, 1.6);
  MeasurementNoise noise;
  noise.sigma[at(Channel::kFx)] = level * uniform(random, 0.008, 0.025) * w;
  noise.sigma[at(Channel::kFy)] = level * uniform(random, 0.008, 0.025) * w;
  noise.sigma[at(Channel::kTorque)] = level * uniform(random, 0.006, 0.018) * w * r;
  noise.sigma[at(Channel::kSinkage)] = level * uniform(random, 0.02, 0.06) * h;
  noise.sigma[at(Channel::kRutLeft)] = noise.sigma[at(Channel::kRutRight)] =
      level * uniform(random, 0.04, 0.1) * h;
  noise.growth = chance(random, 0.5) ? uniform(random, 0.01, 0.05) : 0;
  noise.outliers = chance(random, 0.5) ? uniform(random, 0.01, 0.02) : 0;
  noise.tail_dof = chance(random, 0.4) ? uniform(random, 4, 8) : 0;
  noise.day_offset = chance(random, 0.6) ? uniform(random, 0.2, 1) : 0;
  noise.day_gain = chance(random, 0.4) ? uniform(random, 0.002, 0.01) : 0;
  noise.load_error = uniform(random, 0, 0.006);
  noise.load_spread = uniform(random, 0.005, 0.05);
  noise.common = chance(random, 0.5) ? uniform(random, 0.1, 0.5) : 0;
  return noise;
}

double noise_sigma(const MeasurementNoise& noise, Channel channel, double value) {
  const double base = noise.sigma[at(channel)], gain = std::hypot(noise.growth, noise.day_gain);
  return std::hypot(base * std::hypot(1.0, noise.day_offset), gain * value);
}

std::optional<ChannelValues> ideal_values(const Rig& rig, const RigCondition& condition,
                                          const std::vector<DrawnEffect>& effects,
                                          const std::vector<InstrumentFault>& faults) {
  TruthPhysics p{.variant = rig.setup.variant,
                 .wheel = rig.setup.wheel,
                 .soil = rig.soil,
                 .gravity_mps2 = rig.setup.gravity_mps2,
                 .at = {.load_n = condition.load_n,
                        .middle_load_n = rig.middle_load_n,
                        .slip_ratio = condition.slip_ratio,
                        .slip_angle_rad = condition.slip_angle_rad,
                        .pass = condition.pass,
                        .speed_mps = condition.speed_mps,
                        .position_m = condition.position_m,
                        .time_s = condition.time_s,
                        .series_s = rig.series_s(),
                        .day = condition.day,
                        .previous_slip_ratio = condition.previous_slip_ratio}};
  for (const InstrumentFault& fault : faults) {
    if (fault.id == "slip_scale") p.at.slip_ratio = true_slip(p.at.slip_ratio, 1 + fault.amount);
    if (fault.id == "load_cell") p.at.load_n /= 1 + fault.amount;
  }
  const auto c = channels_with(effects, p);
  if (!c) return std::nullopt;
  const ChannelValues seen{c->fx_n,      c->fy_n,       c->torque_nm,
                           c->sinkage_m, c->rut_left_m, c->rut_right_m};
  ChannelValues shown = seen;
  for (const InstrumentFault& fault : faults) {
    double& value = shown[at(fault.channel)];
    if (fault.id == "sensor_bias") value += fault.amount;
    if (fault.id == "sensor_gain") value += fault.amount * seen[at(fault.channel)];
    if (fault.id == "sensor_crosstalk") value += fault.amount * seen[at(fault.from)];
    if (fault.id == "sensor_turned") {
      double& other = shown[at(fault.from)];
      const double along = value, across = other, turn = fault.amount;
      value = along * std::cos(turn) + across * std::sin(turn);
      other = across * std::cos(turn) - along * std::sin(turn);
    }
  }
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (!std::ranges::count(rig.channels, static_cast<Channel>(i))) {
      shown[i] = WheelRun::kNotMeasured;
    }
  }
  return shown;
}

std::optional<Recording> record(Random& random, const Rig& rig, const MeasurementNoise& noise,
                                const std::vector<DrawnEffect>& effects,
                                const std::vector<InstrumentFault>& faults) {
  struct Planned {
    std::size_t condition;
    int replicate;
  };
  std::vector<Planned> plan;
  for (int k = 0; k < rig.replicates; ++k) {
    const auto begin = static_cast<std::ptrdiff_t>(plan.size());
    for (std::size_t i = 0; i < rig.conditions.size(); ++i) plan.push_back({i, k});
    if (!rig.same_order) std::shuffle(plan.begin() + begin, plan.end(), random);
  }
  if (!rig.same_order && !rig.replicate_by_day) std::shuffle(plan.begin(), plan.end(), random);

  std::array<ChannelValues, kDays> offset{}, gain{};
  for (int day = 0; day < kDays; ++day) {
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      offset[static_cast<std::size_t>(day)][i] = noise.day_offset * noise.sigma[i] * normal(random);
      gain[static_cast<std::size_t>(day)][i] = 1 + noise.day_gain * normal(random);
    }
  }

  ChannelValues before{};
  Recording recording{.columns = rig.columns, .channels = rig.channels};
  for (std::size_t i = 0; i < plan.size(); ++i) {
    RigCondition run = rig.at_run(rig.conditions[plan[i].condition], plan[i].replicate, i);
    const auto day = static_cast<std::size_t>(run.day);
    run.slip_ratio = as_in_file(run.slip_ratio + noise.slip_jitter * uniform(random, -1, 1));
    if (run.slip_angle_rad != 0)
      run.slip_angle_rad += noise.angle_jitter_rad * uniform(random, -1, 1);
    run.slip_angle_rad = angle_as_in_file(run.slip_angle_rad);
    const double told_n = as_in_file(run.load_n * (1 + noise.load_spread * bounded_normal(random)));
    run.load_n = told_n * (1 + noise.load_error * normal(random));
    const auto ideal = ideal_values(rig, run, effects, faults);
    if (!ideal) return std::nullopt;

    WheelRun row{.run_id = fmt::format("r{:03}", i + 1),
                 .load_n = told_n,
                 .slip_ratio = run.slip_ratio,
                 .slip_angle_rad = run.slip_angle_rad,
                 .conditions = {},
                 .day = rig.columns.day ? static_cast<double>(day + 1) : 0};
    if (rig.columns.pass) row.conditions.pass = run.pass;
    if (rig.columns.speed) row.conditions.speed_mps = run.speed_mps;
    if (rig.columns.position) row.conditions.position_m = run.position_m;
    if (rig.columns.time) row.conditions.time_s = run.time_s;
    if (rig.replicates > 1) row.replicate = plan[i].replicate + 1;
    const double shared = normal(random);
    for (const Channel channel : rig.channels) {
      const std::size_t c = at(channel);
      const double sigma = std::hypot(noise.sigma[c], noise.growth * (*ideal)[c]);
      const bool is_force = c <= at(Channel::kTorque);
      const double common = is_force ? noise.common : 0;
      double scatter =
          std::sqrt(1 - common) * heavy_tailed(random, noise.tail_dof) + std::sqrt(common) * shared;
      scatter = noise.memory * before[c] + std::sqrt(1 - noise.memory * noise.memory) * scatter;
      before[c] = scatter;
      if (chance(random, noise.outliers)) scatter += sign(random) * uniform(random, 4, 9);
      row.measured[c] = as_in_file((*ideal)[c] * gain[day][c] + offset[day][c] + sigma * scatter);
    }
    recording.runs.push_back(std::move(row));
  }
  return recording;
}

}  // namespace regoplan::challenge
