// The base model beside real single-wheel tests on dry sand (C. Pavlov, Carnegie Mellon University,
// github.com/robomechanics/3d-terramechanics), with soil numbers from the plate tests in the same
// sand. Nothing is tuned and nothing is claimed to fit: the table says where the model fails, and
// by how much against the scatter of replicate runs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "terramech/basics/angles.h"
#include "terramech/wheel/wheel_model.h"
#include "tests/measured_data.h"
#include "tests/terramech/csv_rows.h"

namespace regoplan {
namespace {

/// Pressure-sinkage numbers of the plate nearest to the wheel's width (60 mm): means of the six
/// tests. Friction from the angle of repose, density as published; cohesion as the authors take it.
/// The shear moduli of dry sand (Wong, Theory of Ground Vehicles) and the paper's a0 and a1 were
/// not measured in this sand.
Soil sand(const std::string& folder) {
  double k = 0, n = 0, count = 0;
  for (auto row : csv_rows::read(folder + "/pressure_sinkage/index.csv")) {
    if (row["tool"] != "plate_d60mm") continue;
    k += std::log(std::stod(row["fit_k_kN_per_m_n2"]) * 1000);
    n += std::stod(row["fit_n"]);
    ++count;
  }
  EXPECT_EQ(count, 6);
  return {.cohesion_pa = 1000,
          .friction_angle_rad = 29 * kDegree,
          .kc = 0,
          .kphi = std::exp(k / count),
          .n = n / count,
          .a0 = 0.4,
          .a1 = 0.15,
          .lambda = 0,
          .density_kgpm3 = 1330,
          .kx0_m = 0.025,
          .ky0_m = 0.025};
}

struct Misfit {
  double sum2 = 0;
  int count = 0;
  void add(double difference) {
    sum2 += difference * difference;
    ++count;
  }
  double rmse() const { return std::sqrt(sum2 / count); }
};

std::string slip_band(double slip) {
  return slip < -0.3 ? "slip < -0.3" : slip <= 0.3 ? "|slip| <= 0.3" : "slip > 0.3";
}

}  // namespace

TEST(SingleWheelMeasurements, SayWhereTheBaseModelFailsAndByHowMuch) {
  const std::string folder = measured_data() / "cmu_single_wheel";
  if (const auto absence = absence_of(folder)) GTEST_SKIP() << *absence;
  const WheelModel model({.wheel = {.radius_m = 0.058, .width_m = 0.050}, .soil = sand(folder)});
  // run-to-run standard deviation of replicates
  const std::map<std::string, double> noise{{"fx_n", 0.80}, {"fy_n", 0.76}, {"sinkage_m", 0.65e-3}};

  std::map<std::string, std::map<std::string, Misfit>> misfits;  // channel, condition
  std::map<std::string, Misfit> overall;
  int runs = 0, not_carried = 0;
  for (auto row : csv_rows::read(folder + "/smooth.csv")) {
    ++runs;
    const double slip = std::stod(row["slip_ratio"]);
    const double angle_deg = std::stod(row["slip_angle_deg"]);
    const WheelForces forces =
        model.forces(std::stod(row["load_n"]), motion_at(slip, angle_deg * kDegree));
    if (!has_forces(forces.status)) {
      ++not_carried;
      continue;
    }
    const std::map<std::string, double> predicted{
        {"fx_n", forces.fx_n}, {"fy_n", forces.fy_n}, {"sinkage_m", forces.sinkage_m}};
    for (const auto& [channel, value] : predicted) {
      const double difference = value - std::stod(row[channel]);
      misfits[channel][fmt::format("{:>3.0f} deg, {}", 15 * std::round(std::abs(angle_deg) / 15),
                                   slip_band(slip))]
          .add(difference);
      overall[channel].add(difference);
    }
  }
  EXPECT_EQ(runs, 108);
  EXPECT_EQ(not_carried, 0);
  for (const auto& [channel, conditions] : misfits) {
    const double scale = channel == "sinkage_m" ? 1000 : 1;
    fmt::print("{} ({}), replicates scatter by {:.2f}\n", channel, scale == 1 ? "N" : "mm",
               noise.at(channel) * scale);
    for (const auto& [condition, misfit] : conditions) {
      fmt::print("  {:<24} {:3} runs  rmse {:7.2f}  = {:5.1f} x scatter\n", condition, misfit.count,
                 misfit.rmse() * scale, misfit.rmse() / noise.at(channel));
    }
    fmt::print("  {:<24} {:3} runs  rmse {:7.2f}  = {:5.1f} x scatter\n", "all",
               overall[channel].count, overall[channel].rmse() * scale,
               overall[channel].rmse() / noise.at(channel));
  }
  // The misfit is physics left out, not noise; yet forces stay of the order of the load (13-30 N).
  for (const auto& [channel, misfit] : overall) {
    EXPECT_GT(misfit.rmse(), 3 * noise.at(channel)) << channel;
  }
  EXPECT_LT(overall["fx_n"].rmse(), 15);
  EXPECT_LT(overall["fy_n"].rmse(), 15);
  EXPECT_LT(overall["sinkage_m"].rmse(), 0.03);
}

}  // namespace regoplan
