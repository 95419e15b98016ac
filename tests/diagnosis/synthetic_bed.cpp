#include "synthetic_bed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "terramech/basics/angles.h"
#include "tests/terramech/named_soils.h"

namespace regoplan {
namespace {

struct Sums {
  double fx = 0, fz_stress = 0, fz_cohesion = 0, fy = 0, torque = 0;
};

/// Stress integrals over one strip at sinkage h; q scales the stress.
Sums integrate(const TrueWheel& truth, const DiagnosisSetup& setup, const Soil& soil,
               const WheelRun& run, double h, double q) {
  const double r = setup.wheel.radius_m * truth.radius(run), b = setup.wheel.width_m;
  const double s = run.slip_ratio, beta = std::abs(run.slip_angle_rad);
  const double qv = s >= 0 ? 1 - s : 1 / (1 + s), u = qv * std::tan(beta);
  const double lambda = std::clamp(soil.lambda + truth.rear(run), 0.0, 1.5);
  const double front = std::acos(1 - h / r);
  const double rear = -std::acos(std::clamp(1 - lambda * h / r, -1.0, 1.0));
  const double middle = (soil.a0 + soil.a1 * s) * front;
  const double limit = truth.limit(run);
  const double c = soil.cohesion_pa * limit, mu = std::tan(soil.friction_angle_rad) * limit;
  const double kx = (soil.kx0_m + soil.kx1_m * beta) * truth.kx(run);
  const double ky = (soil.ky0_m + soil.ky1_m * beta) * truth.ky(run);
  const double k = std::pow(r, soil.n) * (soil.kc / b + soil.kphi) * truth.stiffness(run) *
                   truth.depth_stiffness(h);
  const double phi = std::atan(mu), xc = std::numbers::pi / 4 - phi / 2;
  const double d1 = 1 / std::tan(xc) + std::tan(xc + phi);
  const double d2 = 1 / std::tan(xc) + 1 / (std::pow(std::tan(xc), 2) * mu);
  const double mobilised = -std::expm1(-r * u * (front - rear) / ky);
  constexpr int kNodes = 160;
  const double step = (front - rear) / kNodes;
  Sums sum;
  for (int i = 0; i < kNodes; ++i) {
    const double theta = rear + (i + 0.5) * step;
    const double star =
        theta >= middle ? theta : front - (theta - rear) / (middle - rear) * (front - middle);
    const double sigma = q * k * std::pow(std::max(std::cos(star) - std::cos(front), 0.0), soil.n);
    const double jx = r * (front - theta - qv * (std::sin(front) - std::sin(theta)));
    const double jy = r * u * (front - theta);
    double mx = std::copysign(-std::expm1(-std::abs(jx) / kx), jx), my = -std::expm1(-jy / ky);
    if (truth.friction_circle && std::hypot(mx, my) > 1) {
      const double m = std::hypot(mx, my);
      mx /= m;
      my /= m;
    }
    const double area = r * b * step, tx = (c + sigma * mu) * mx;
    sum.fx += area * (tx * std::cos(theta) - sigma * std::sin(theta));
    sum.fz_stress += area * (sigma * mu * mx * std::sin(theta) + sigma * std::cos(theta));
    sum.fz_cohesion += area * c * mx * std::sin(theta);
    sum.torque += r * area * tx;
    const double depth = std::max(0.0, r * (std::cos(theta) - std::cos(front)));
    const double rb =
        d1 * (c * depth + d2 * soil.density_kgpm3 * setup.gravity_mps2 * depth * depth / 2);
    sum.fy += area * (c + sigma * mu) * my + mobilised * rb * (r - depth * std::cos(theta)) * step;
  }
  return sum;
}

}  // namespace

std::array<double, kChannelCount> true_channels(const TrueWheel& truth, const DiagnosisSetup& setup,
                                                const Soil& soil, const WheelRun& run) {
  const double load = run.load_n * truth.load(run);
  double low = 1e-6, high = 0.8 * setup.wheel.radius_m;
  for (int i = 0; i < 50; ++i) {
    const double h = (low + high) / 2;
    const Sums at = integrate(truth, setup, soil, run, h, 1);
    (at.fz_stress + at.fz_cohesion < load ? low : high) = h;
  }
  const double h = truth.sinkage(run, low);
  const Sums whole = integrate(truth, setup, soil, run, h, 1);
  const double q = (load - whole.fz_cohesion) / whole.fz_stress;
  Sums at = integrate(truth, setup, soil, run, h, q);
  const double tilt = std::tan(truth.tilt_rad(run)), b = setup.wheel.width_m;
  if (tilt != 0) {
    constexpr int kStrips = 11;
    at.fy = 0;
    for (int i = 0; i < kStrips; ++i) {
      const double depth = std::max(h + b * ((i + 0.5) / kStrips - 0.5) * tilt, 1e-5);
      at.fy += integrate(truth, setup, soil, run, depth, q).fy / kStrips;
    }
  }
  const double side = run.slip_angle_rad < 0 ? -1 : run.slip_angle_rad > 0 ? 1 : 0;
  return {at.fx + truth.fx_n(run, h),
          side * (at.fy + truth.fy_n(run, h)),
          at.torque + truth.torque_nm(run, h),
          h,
          h - side * b / 2 * tilt,
          h + side * b / 2 * tilt};
}

DiagnosisSetup simulant_setup() {
  DiagnosisSetup setup{.wheel = {.radius_m = 0.09, .width_m = 0.1}};
  setup.soil.mean = named_soils::simulant_2007();
  setup.soil.standard_deviation = {.cohesion_pa = 150,
                                   .friction_angle_rad = 1.5 * kDegree,
                                   .kc = 300,
                                   .kphi = 1.2e5,
                                   .n = 0.05,
                                   .a0 = 0.04,
                                   .a1 = 0.04,
                                   .lambda = 0.1,
                                   .density_kgpm3 = 40,
                                   .kx0_m = 0.005,
                                   .kx1_m = 0.01,
                                   .ky0_m = 0.002,
                                   .ky1_m = 0.005};
  return setup;
}

Recording record(const TrueWheel& truth, const DiagnosisSetup& setup, const Soil& soil,
                 const BedPlan& plan, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<WheelRun> grid;
  for (const double s : plan.slips) {
    for (const double angle : plan.angles_deg) {
      for (const double load : plan.loads_n) {
        grid.push_back({.load_n = load, .slip_ratio = s, .slip_angle_rad = angle * kDegree});
      }
    }
  }
  std::shuffle(grid.begin(), grid.end(), random);
  if (grid.size() > plan.conditions) grid.resize(plan.conditions);
  Recording recording;
  recording.columns.day = true;
  recording.columns.pass = plan.passes;
  recording.columns.speed = plan.speeds;
  recording.columns.position = plan.positions;
  recording.channels = {Channel::kFx, Channel::kFy, Channel::kTorque, Channel::kSinkage};
  if (plan.ruts) {
    recording.channels.push_back(Channel::kRutLeft);
    recording.channels.push_back(Channel::kRutRight);
  }
  std::array<double, kChannelCount> unit{1, 1, 0.09, 5e-4, 5e-4, 5e-4};
  for (double& u : unit) u *= plan.noise;
  std::vector<std::array<double, kChannelCount>> days(static_cast<std::size_t>(plan.replicates));
  for (auto& day : days) {
    for (std::size_t c = 0; c < kChannelCount; ++c) day[c] = plan.day * unit[c] * normal(random);
  }
  std::uniform_real_distribution<double> uniform;
  int name = 0;
  for (int replicate = 0; replicate < plan.replicates; ++replicate) {
    for (std::size_t k = 0; k < grid.size(); ++k) {
      WheelRun run = grid[k];
      run.run_id = fmt::format("r{}", ++name);
      run.day = replicate;
      run.load_n *= 1 + 0.01 * normal(random);
      run.slip_ratio += 0.001 * normal(random);
      if (plan.passes) run.conditions.pass = 1 + static_cast<int>(k % 3);
      if (plan.positions) {
        run.conditions.position_m =
            static_cast<double>(k * 29 % plan.conditions) / static_cast<double>(plan.conditions);
      }
      if (plan.speeds) run.conditions.speed_mps = k % 2 == 0 ? 0.03 : 0.15;
      run.measured = true_channels(truth, setup, soil, run);
      plan.instruments(run);
      for (std::size_t c = 0; c < kChannelCount; ++c) {
        double z = normal(random);
        if (uniform(random) < plan.outliers) z += z > 0 ? 6 + 4 * uniform(random) : -7;
        run.measured[c] += unit[c] * z + days[static_cast<std::size_t>(replicate)][c];
      }
      if (!plan.ruts) run.measured[4] = run.measured[5] = WheelRun::kNotMeasured;
      recording.runs.push_back(run);
    }
  }
  return recording;
}

}  // namespace regoplan
