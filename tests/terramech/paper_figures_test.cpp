#include "terramech/wheel/paper_figures.h"

#include <gtest/gtest.h>

namespace regoplan {

TEST(PaperFigures, CurvesOfSlipAnglesStandAboveEachOtherAndEndAtNoSideForce) {
  const PaperFigures figures = paper_figures();
  ASSERT_EQ(figures.figure_6.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& points = figures.figure_6[i].points;
    EXPECT_EQ(points.front().slip_ratio, 0);
    EXPECT_EQ(points.back().slip_ratio, 1);
    EXPECT_NEAR(points.back().fy_n, 0, 1e-9);
    if (i == 0) continue;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      EXPECT_GT(points[k].fy_n, figures.figure_6[i - 1].points[k].fy_n);
    }
  }
}

TEST(PaperFigures, CurvesOfConstantSlipHaveOneLongitudinalForce) {
  int count = 0;
  for (const FigureCurve& curve : paper_figures().figure_7) {
    if (!curve.of_constant_slip) continue;
    ++count;
    EXPECT_EQ(curve.points.front().fx_n, curve.points.back().fx_n) << curve.label;
  }
  EXPECT_EQ(count, 6);
}

TEST(PaperFigures, FigureTenEndsWhereTheExperimentsDid) {
  for (const FigureCurve& curve : paper_figures().figure_10) {
    EXPECT_NEAR(curve.points.back().slip_ratio, 0.7, 1e-12);
  }
}

}  // namespace regoplan
