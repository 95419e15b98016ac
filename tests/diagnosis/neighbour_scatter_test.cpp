#include "diagnosis/recording/neighbour_scatter.h"

#include <gtest/gtest.h>

#include <random>

namespace regoplan {
namespace {

/// One run at each slip ratio and slip angle.
std::vector<Condition> grid(const std::vector<double>& slips, const std::vector<double>& angles) {
  std::vector<Condition> conditions;
  for (const double slip : slips) {
    for (const double angle : angles) {
      conditions.push_back(
          {.load_n = 60, .slip_ratio = slip, .slip_angle_rad = angle, .runs = {conditions.size()}});
    }
  }
  return conditions;
}

TEST(NeighbourScatter, IsKnownAsWellAsItSays) {
  const std::vector<std::vector<Condition>> beds{
      grid({.1, .3, .5, .7}, {0, .2, .4}), grid({.05, .2, .35, .5, .65}, {0, .17, .35, .52}),
      grid({0, .05, .1, .15, .2, .25, .3, .35, .4, .45, .5, .55}, {0})};
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const auto& conditions : beds) {
    const std::vector<double> model(conditions.size(), 0.0);
    constexpr int kDraws = 4000;
    double mean = 0, square = 0;
    int told = 0;
    for (int i = 0; i < kDraws; ++i) {
      std::vector<double> value(conditions.size());
      for (double& v : value) v = normal(random);
      const RunScatter scatter = neighbour_scatter(conditions, value, model);
      const double variance = scatter.deviation * scatter.deviation;
      mean += variance / kDraws;
      square += variance * variance / kDraws;
      told = scatter.degrees_of_freedom;
    }
    EXPECT_GT(mean, 1.1);  // cautious
    EXPECT_LT(mean, 1.6);
    const double shown = 2 * mean * mean / (square - mean * mean);
    EXPECT_GE(shown, 0.95 * told);
    EXPECT_LE(shown, 1.3 * told);
  }
}

}  // namespace
}  // namespace regoplan
