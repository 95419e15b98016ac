// Real sand and the model of a rigid wheel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/diagnose/diagnosis_setup.h"
#include "app/diagnose/recording_file.h"
#include "diagnosis/diagnosis.h"
#include "tests/measured_data.h"

namespace regoplan {
namespace {

/// Real sand differs from the model in more than any one name: what users get of it is a class
/// with its shares, and names that carry most of it.
TEST(RealSand, IsAClassWithSharesAndNoSingleName) {
  const std::string file = measured_data() / "cmu_single_wheel" / "smooth.csv";
  if (const auto absence = absence_of(file)) GTEST_SKIP() << *absence;
  const DiagnosisSetup setup =
      read_setup_file("benchmarks/measured/smooth_wheel_on_sand.yaml").setup;
  const Diagnosis found = diagnose(read_recording(file).recording, setup, {});
  ASSERT_EQ(found.verdict, Verdict::kPartly) << found.sentence;
  ASSERT_FALSE(found.claims.empty());
  ASSERT_LE(found.claims.size(), 3u);
  const Claim& first = found.claims.front();
  EXPECT_FALSE(first.equivalent.empty());
  EXPECT_EQ(first.member_shares.size(), first.equivalent.size() + 1);
  // What to measure next parts the names of that class.
  ASSERT_FALSE(found.next_experiments.empty());
  for (const std::string& id : found.next_experiments.front().separates) {
    EXPECT_TRUE(first.member_shares.contains(id)) << id;
  }
  for (const Claim& claim : found.claims) {
    EXPECT_LT(claim.probability, 0.975);  // a nameless mismatch may do as well
    EXPECT_TRUE(std::isfinite(claim.evidence_nats));
    ASSERT_TRUE(claim.share);
    EXPECT_GT(claim.share->low, 0);
  }
  EXPECT_GT(1 - found.remainder_share, 0.5);
  // Errors of the names and their remainder on slip bands held out.
  const auto error = [&](Channel channel) {
    return std::ranges::find(found.fit, channel, &ChannelFit::channel)->corrected_rmse;
  };
  EXPECT_LT(error(Channel::kFx), 1.9);
  EXPECT_LT(error(Channel::kFy), 1.7);
  EXPECT_LT(error(Channel::kSinkage), 3.4e-3);
}

}  // namespace
}  // namespace regoplan
