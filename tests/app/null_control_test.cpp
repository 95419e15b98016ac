// A smooth surface fitted to real runs of some days, tested on the other days of the same wheel:
// nothing is missing there, so that a test for lack of fit has to stay silent.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <set>

#include "app/diagnose/recording_file.h"
#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/bed/discrepancy.h"
#include "tests/measured_data.h"

namespace regoplan {
namespace {

DiagnosisSetup dry_sand() {
  DiagnosisSetup setup{.wheel = {.radius_m = 0.058, .width_m = 0.05}};
  setup.soil.mean = {.cohesion_pa = 300,
                     .friction_angle_rad = 0.506,
                     .kc = 0,
                     .kphi = 5e6,
                     .n = 1.4,
                     .a0 = 0.4,
                     .a1 = 0.15,
                     .lambda = 0.3,
                     .density_kgpm3 = 1330,
                     .kx0_m = 0.01,
                     .kx1_m = 0,
                     .ky0_m = 0.01,
                     .ky1_m = 0};
  return setup;
}

/// Conditions of one half of the days.
std::vector<Eigen::Index> rows_of(const TestBed& bed, const ChannelData& data,
                                  const std::set<double>& days) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < data.conditions.size(); ++i) {
    if (days.contains(bed.conditions[data.conditions[i]].day)) {
      rows.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return rows;
}

/// Noise and a smooth surface without any symmetry: the side force's too, as a gauge's offset is
/// none of the soil's.
Eigen::MatrixXd covariance_of(const TestBed& bed, const ChannelData& data,
                              const DiscrepancySetting& setting) {
  const ConditionsAt at = conditions_of(bed, data);
  return data.noise + std::pow(setting.amplitude * data.scale, 2) *
                          discrepancy_kernels(discrepancy_scales()[setting.scales], Channel::kFx,
                                              at, at, setting.sides);
}

/// Misfit of the other half against what a smooth surface through one half and the noise predict.
double misfit_of_the_rest(const TestBed& bed, const ChannelData& data,
                          const Eigen::VectorXd& residual, const std::vector<Eigen::Index>& known,
                          const std::vector<Eigen::Index>& rest) {
  double top = -INFINITY, misfit = 0;
  for (const DiscrepancySetting& setting : discrepancy_settings()) {
    const Eigen::MatrixXd whole = covariance_of(bed, data, setting);
    const Eigen::VectorXd seen = residual(known);
    const Eigen::LLT<Eigen::MatrixXd> factor(Eigen::MatrixXd(whole(known, known)));
    const double score = -0.5 * factor.matrixL().solve(seen).squaredNorm() -
                         factor.matrixLLT().diagonal().array().log().sum();
    if (!(score > top)) continue;  // the smoothness comes from the known half alone
    top = score;
    const Eigen::MatrixXd across = whole(rest, known);
    const Eigen::VectorXd error = Eigen::VectorXd(residual(rest)) - across * factor.solve(seen);
    const Eigen::MatrixXd covariance =
        Eigen::MatrixXd(whole(rest, rest)) - across * factor.solve(across.transpose());
    misfit = covariance.llt().matrixL().solve(error).squaredNorm();
  }
  return misfit;
}

TEST(NullControl, ASmoothSurfaceThroughHalfTheDaysPredictsTheOtherHalf) {
  const std::string file = measured_data() / "cmu_single_wheel" / "smooth.csv";
  if (const auto absence = absence_of(file)) GTEST_SKIP() << *absence;
  Recording recording = read_recording(file).recording;
  std::set<double> days;
  for (const WheelRun& run : recording.runs) days.insert(run.day);
  ASSERT_GE(days.size(), 2);
  std::set<double> first_half;
  bool first = true;
  for (const double day : days) {  // every other one: either half has been at most conditions
    if (first) first_half.insert(day);
    first = !first;
  }
  // the conditions of each half apart: no mean may mix them
  for (WheelRun& run : recording.runs) run.wheel = first_half.contains(run.day) ? "a" : "b";
  const CondensedRecording condensed = condense(recording, dry_sand());
  const TestBed& bed = condensed.bed;
  std::set<double> second_half;
  for (const double day : days) {
    if (!first_half.contains(day)) second_half.insert(day);
  }
  const auto model = predict(bed, bed.setup.soil.mean, {});
  ASSERT_TRUE(model);
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& channel = bed.channels[c];
    const Eigen::VectorXd residual =
        channel.mean - model->segment(bed.offset(c), channel.mean.size());
    const auto known = rows_of(bed, channel, first_half), rest = rows_of(bed, channel, second_half);
    ASSERT_GE(known.size(), 8);
    ASSERT_GE(rest.size(), 8);
    const double misfit = misfit_of_the_rest(bed, channel, residual, known, rest);
    const boost::math::chi_squared silent(static_cast<double>(rest.size()));
    EXPECT_LT(misfit, boost::math::quantile(silent, 0.995)) << name(channel.channel);
  }
}

}  // namespace
}  // namespace regoplan
