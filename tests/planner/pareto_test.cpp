#include "planner/verdict/pareto.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace regoplan {
namespace {

Candidate candidate(double margin_min, double duration_s, double energy_j) {
  Candidate made;
  made.margin_min = margin_min;
  made.duration_s = duration_s;
  made.energy_j = energy_j;
  return made;
}

TEST(Pareto, WhatIsWorseInEverythingIsNotBest) {
  EXPECT_EQ(pareto_best(std::vector{candidate(0.2, 80, 100), candidate(0.1, 90, 110)}),
            (std::vector{true, false}));
}

TEST(Pareto, EachIsBestThatIsBetterSomewhere) {
  EXPECT_EQ(pareto_best(std::vector{candidate(0.2, 80, 100), candidate(0.1, 70, 110),
                                    candidate(0.1, 90, 90)}),
            (std::vector{true, true, true}));
}

TEST(Pareto, EqualOnesDoNotBeatEachOther) {
  EXPECT_EQ(pareto_best(std::vector{candidate(0.2, 80, 100), candidate(0.2, 80, 100)}),
            (std::vector{true, true}));
}

TEST(Pareto, WhatIsNotKnownIsWorse) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pareto_best(std::vector{candidate(0.2, 80, kNaN), candidate(0.2, 80, 100)}),
            (std::vector{false, true}));
  EXPECT_EQ(pareto_best(std::vector{candidate(kNaN, kNaN, kNaN)}), (std::vector{true}));
}

TEST(Pareto, WhoIsNotBestIsBeatenByOneWhoIs) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<Candidate> candidates;
  for (int i = 0; i < 60; ++i)
    candidates.push_back(candidate(any(random), any(random), any(random)));
  const std::vector<bool> best = pareto_best(candidates);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    bool beaten = false;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      beaten = beaten || (best[k] && candidates[k].margin_min > candidates[i].margin_min &&
                          candidates[k].duration_s < candidates[i].duration_s &&
                          candidates[k].energy_j < candidates[i].energy_j);
    }
    EXPECT_EQ(beaten, !best[i]) << i;
  }
}

}  // namespace
}  // namespace regoplan
