#include "drive_diagnosis/fit/window_linearisation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/drive_diagnosis/compared_drive.h"

namespace regoplan {
namespace {

/// A drive over a soft stretch that a fit takes for a zone of soil less soft, and another fit.
struct OverAZone : OverAStretch {
  OverAZone()
      : trials{{.id = "", .parameter = "radius", .deviation = {.radius_share = 0.01}},
               {.id = "", .parameter = "payload", .deviation = {.payload_share = 0.02}}},
        shifts(Eigen::MatrixXd::Zero(comparison->measured().rows(),
                                     static_cast<Eigen::Index>(comparison->inputs()))),
        other_shifts(shifts) {
    for (WindowZone* one : {&said, &other}) *one = zone;
    said.numbers = weaker_by(kWeakness - 1);
    other.numbers = weaker_by(kWeakness);
    other.begins += 0.3;
    other_shifts.setConstant(0.2);
  }

  static ContestFit fit_of(double radius, double payload, const WindowZone& zone) {
    Eigen::VectorXd numbers(kNumbers.size());
    for (std::size_t k = 0; k < kNumbers.size(); ++k) {
      numbers[static_cast<Eigen::Index>(k)] = zone.numbers.at(kNumbers[k]);
    }
    return {.parameters = Eigen::Vector2d(radius, payload), .zones = {numbers}};
  }
  LinearisedWindows here(WindowLinearisation& linearisation) const {
    return linearisation.about(fit_of(0.5, -1, said), {said}, shifts);
  }
  LinearisedWindows there(WindowLinearisation& linearisation) const {
    return linearisation.about(fit_of(0.7, 1, other), {other}, other_shifts);
  }

  static inline const std::vector<std::size_t> kNumbers{0, 1};
  std::vector<VehicleTrial> trials;
  WindowZone said, other;
  Eigen::MatrixXd shifts, other_shifts;
  std::stop_token stop;
};

constexpr double kSolved = 1e-3;  ///< as near as motions are found, in N m and m/s

void expect_row(const Eigen::MatrixXd& is, const Eigen::MatrixXd& should_be, Eigen::Index row) {
  EXPECT_LT((is.row(row) - should_be.row(row)).cwiseAbs().maxCoeff(), kSolved) << "window " << row;
}

TEST(WindowLinearisation, OnlyWindowsThatItIsToldToArePredictedAnew) {
  OverAZone drive;
  WindowLinearisation linearisation(*drive.comparison, drive.trials, OverAZone::kNumbers,
                                    drive.stop);
  const LinearisedWindows full = drive.there(linearisation), before = drive.here(linearisation);
  const WindowSet anew = drive.comparison->touching({drive.comparison->widened(drive.zone, 1)});
  linearisation.predict_only(anew, before);
  const LinearisedWindows some = drive.there(linearisation);

  const Eigen::MatrixXd first_order = before.base + 0.2 * before.columns[0] +
                                      2 * before.columns[1] + before.shifted_by(drive.other_shifts);
  ASSERT_LT(anew.size(), drive.comparison->size() / 2);
  for (std::size_t i = 0; i < drive.comparison->size(); ++i) {
    const auto w = static_cast<Eigen::Index>(i);
    const bool is_new = std::ranges::binary_search(anew, i);
    expect_row(some.base, is_new ? full.base : first_order, w);
    expect_row(some.columns[1], is_new ? full.columns[1] : before.columns[1], w);
    expect_row(some.inputs[0], is_new ? full.inputs[0] : before.inputs[0], w);
    expect_row(some.data, is_new ? full.data : before.data, w);
    expect_row(some.zones[0][1], full.zones[0][1], w);
  }

  linearisation.predict_all();
  const LinearisedWindows again = drive.there(linearisation);
  for (Eigen::Index w = 0; w < full.base.rows(); ++w) expect_row(again.base, full.base, w);
}

TEST(WindowLinearisation, WindowsWithoutAMotionAreAsSaid) {
  OverAZone drive;
  WindowLinearisation linearisation(*drive.comparison, drive.trials, OverAZone::kNumbers,
                                    drive.stop);
  EXPECT_TRUE(drive.here(linearisation).unbalanced.empty());
  drive.said.numbers = weaker_by(40);  // carries no vehicle
  const LinearisedWindows sunk = drive.here(linearisation);
  ASSERT_FALSE(sunk.unbalanced.empty());
  const WindowSet touching = drive.comparison->touching({drive.said});
  const Eigen::MatrixXd as_said = drive.comparison->predicted_as_said({});
  for (const std::size_t w : sunk.unbalanced) {
    EXPECT_TRUE(std::ranges::binary_search(touching, w)) << "window " << w;
    expect_row(sunk.base, as_said, static_cast<Eigen::Index>(w));
  }
}

TEST(WindowLinearisation, ASoilThatCarriesNowhereChangesNothing) {
  OverAZone drive;
  WindowLinearisation linearisation(*drive.comparison, drive.trials, OverAZone::kNumbers,
                                    drive.stop);
  const auto is_carried = [&](const WindowZone& zone) {
    const ContestFit fit = OverAZone::fit_of(0, 0, zone);
    return linearisation.is_carried(linearisation.predicted(fit, {zone}, drive.shifts), fit,
                                    {zone});
  };
  EXPECT_TRUE(is_carried(drive.said));
  WindowZone sunk = drive.said;
  sunk.begins = std::floor(sunk.begins) - 1;  // its windows lie in it with all wheels
  sunk.numbers = weaker_by(400);
  const LinearisedWindows full =
      linearisation.about(OverAZone::fit_of(0, 0, sunk), {sunk}, drive.shifts);
  const bool changes = std::ranges::any_of(
      full.zones[0], [](const Eigen::MatrixXd& number) { return !number.isZero(0); });
  ASSERT_FALSE(changes);
  EXPECT_FALSE(is_carried(sunk));
}

}  // namespace
}  // namespace regoplan
