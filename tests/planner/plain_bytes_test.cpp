#include "planner/runtime/plain_bytes.h"

#include <gtest/gtest.h>

#include "planner/driving/what_if.h"
#include "planner/verdict/verified_path.h"

namespace regoplan {
namespace {

VerifiedPath some_path() {
  VerifiedPath path;
  path.candidate.planner = "Lattice";
  path.candidate.controls = {{1, 2, 0.1}, {3, 4, -0.1}};
  path.candidate.improvement = Improvement{.cost_before = 9, .cost_after = 8};
  path.candidate.points = {{.time_s = 1}, {.time_s = 2}};
  path.candidate.verified = {.passed = false, .reason = "slope", .margin_min = 0.1};
  path.replay.judged.resize(3);
  path.replay.rejection = RejectedState{.reason = Rejection::kSlope, .x_m = 7};
  return path;
}

TEST(PlainBytes, WhatWasWrittenIsRead) {
  const VerifiedPath path = some_path();
  const auto read = from_bytes<VerifiedPath>(bytes_of(path));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->candidate.planner, path.candidate.planner);
  ASSERT_EQ(read->candidate.controls.size(), 2u);
  EXPECT_EQ(read->candidate.controls[1].curvature_target_1pm, -0.1);
  ASSERT_TRUE(read->candidate.improvement);
  EXPECT_EQ(read->candidate.improvement->cost_after, 8);
  EXPECT_EQ(read->candidate.points[1].time_s, 2);
  EXPECT_EQ(read->candidate.verified.reason, "slope");
  EXPECT_EQ(read->replay.judged.size(), 3u);
  ASSERT_TRUE(read->replay.rejection);
  EXPECT_EQ(read->replay.rejection->x_m, 7);
  EXPECT_EQ(bytes_of(*read), bytes_of(path));
}

TEST(PlainBytes, BytesThatEndTooEarlyAreNoAnswer) {
  const std::vector<char> whole = bytes_of(some_path());
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{9}, whole.size() / 2, whole.size() - 1}) {
    EXPECT_FALSE(from_bytes<VerifiedPath>(
        {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}));
  }
}

}  // namespace
}  // namespace regoplan
