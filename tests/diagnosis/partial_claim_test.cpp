#include "diagnosis/names/partial_claim.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace regoplan {
namespace {

double probability_in(const std::vector<ScoredCandidate>& ranking, const std::string& id) {
  return std::ranges::find(ranking, id, &ScoredCandidate::id)->probability;
}

double whole(const std::vector<ScoredCandidate>& ranking) {
  double sum = 0;
  for (const ScoredCandidate& one : ranking) sum += one.probability;
  return sum;
}

std::vector<CappedName> two_names() {
  std::vector<CappedName> names(2);
  names[0].id = "front_bulldozing";
  names[0].gain_nats = 100;
  names[1].id = "flank_friction";
  names[1].gain_nats = 60;
  return names;
}

TEST(CappedRanking, GivesTheBestNameWhatChanceLeaves) {
  const auto ranking = capped_ranking(two_names(), 0.05);
  EXPECT_NEAR(probability_in(ranking, "front_bulldozing"), 0.95, 1e-4);
  EXPECT_NEAR(probability_in(ranking, "unexplained"), 0.05, 1e-9);
  EXPECT_NEAR(whole(ranking), 1, 1e-9);
}

TEST(CappedRanking, WhatIsToldOfANameBeforehandCounts) {
  std::vector<CappedName> names = two_names();
  names[1].gain_nats = names[0].gain_nats;
  names[1].prior_nats = 100;
  const auto ranking = capped_ranking(names, 0.05);
  EXPECT_EQ(ranking.front().id, "flank_friction");
  EXPECT_EQ(ranking.front().evidence_nats, names[1].gain_nats);  // of the recording alone
  EXPECT_NEAR(whole(ranking), 1, 1e-9);
}

TEST(CappedRanking, WhatSomethingSpeaksAgainstWeighsNothing) {
  std::vector<CappedName> names = two_names();
  names[0].refused = true;
  const auto one_left = capped_ranking(names, 0.05);
  EXPECT_EQ(probability_in(one_left, "front_bulldozing"), 0);
  EXPECT_NEAR(probability_in(one_left, "flank_friction"), 0.95, 1e-9);
  EXPECT_NEAR(whole(one_left), 1, 1e-9);
  names[1].refused = true;
  const auto none_left = capped_ranking(names, 0.05);
  EXPECT_EQ(probability_in(none_left, "unexplained"), 1);
  EXPECT_NEAR(whole(none_left), 1, 1e-9);
}

TEST(LikelierThan, IsWhateverLeavesNamesNoMoreThanHalfOfTheProbability) {
  const std::vector<ScoredCandidate> ranking{
      {"soil_change", 0.6}, {"grousers", 0.3}, {"multi_pass", 0.1}};
  EXPECT_NE(likelier_than({"grousers", "multi_pass"}, ranking).find("likelier: soil_change"),
            std::string::npos);
  // Several may be likelier together than the likeliest of all.
  const std::vector<ScoredCandidate> close{
      {"soil_change", 0.4}, {"grousers", 0.35}, {"multi_pass", 0.25}};
  EXPECT_NE(likelier_than({"soil_change"}, close).find("likelier: grousers, multi_pass"),
            std::string::npos);
  EXPECT_EQ(likelier_than({"soil_change"}, ranking), "");
  EXPECT_EQ(likelier_than({"soil_change", "grousers"}, ranking), "");
}

}  // namespace
}  // namespace regoplan
