#include "drive_diagnosis/fit/linearised_windows.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

/// Three windows of two channels, with a parameter, an input and a zone of one number.
LinearisedWindows three_windows() {
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(3, 2);
  LinearisedWindows windows = LinearisedWindows::none(ones, 1, 1, 1, 1);
  windows.data = 10 * ones;
  windows.base = 7 * ones;
  windows.columns[0] = 2 * ones;
  windows.inputs[0] = 3 * ones;
  windows.zones[0][0].row(1).setConstant(5);
  return windows;
}

TEST(LinearisedWindows, AZoneChangesItsWindowsAndAParameterAll) {
  ContestFit fit{.parameters = Eigen::VectorXd::Constant(1, 0.5)};
  fit.zones = {Eigen::VectorXd::Constant(1, 2)};
  const Eigen::MatrixXd change = three_windows().changed_by(fit);
  EXPECT_EQ(change.row(0), Eigen::RowVector2d(1, 1));
  EXPECT_EQ(change.row(1), Eigen::RowVector2d(11, 11));
  EXPECT_EQ(change.row(2), Eigen::RowVector2d(1, 1));
}

TEST(LinearisedWindows, AnInputChangesTheWindowThatItIsShiftedIn) {
  Eigen::MatrixXd shifts = Eigen::MatrixXd::Zero(3, 1);
  shifts(2, 0) = -1;
  const Eigen::MatrixXd change = three_windows().shifted_by(shifts);
  EXPECT_TRUE(change.topRows(2).isZero(0));
  EXPECT_EQ(change.row(2), Eigen::RowVector2d(-3, -3));
}

TEST(LinearisedWindows, ForgetWhatTheyAreToldToAndNothingElse) {
  LinearisedWindows windows = three_windows();
  windows.forget({1});
  const LinearisedWindows before = three_windows();
  for (const auto& [now, was] : {std::pair{windows.data, before.data},
                                 {windows.base, before.base},
                                 {windows.columns[0], before.columns[0]},
                                 {windows.inputs[0], before.inputs[0]},
                                 {windows.zones[0][0], before.zones[0][0]}}) {
    EXPECT_TRUE(now.row(1).isZero(0));
    EXPECT_EQ(now.row(0), was.row(0));
    EXPECT_EQ(now.row(2), was.row(2));
  }
}

}  // namespace
}  // namespace regoplan
