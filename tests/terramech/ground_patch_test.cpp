#include "terramech/parameters/ground_patch.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/terramech/lunar_soil.h"

namespace regoplan {
namespace {

constexpr double kG = 3.7;

TEST(PatchAxes, OnTheFlatGravityOnlyPresses) {
  const PatchAxes axes(patch_with(0, 0), kG);
  EXPECT_EQ(axes.gravity_forward_mps2, 0);
  EXPECT_EQ(axes.gravity_left_mps2, 0);
  EXPECT_EQ(axes.gravity_normal_mps2, kG);
  EXPECT_EQ(axes.forward_per_vx, 1);
  EXPECT_EQ(axes.left_per_vy, 1);
  EXPECT_EQ(axes.yaw_per_turn, 1);
}

TEST(PatchAxes, GravityPullsBackUphillAndToTheRightWhereTheLeftIsHigher) {
  const double angle = 20 * kDegree;
  const PatchAxes up(patch_with(std::tan(angle), 0), kG);
  EXPECT_NEAR(up.gravity_forward_mps2, -kG * std::sin(angle), 1e-15);
  EXPECT_NEAR(up.gravity_normal_mps2, kG * std::cos(angle), 1e-15);
  const PatchAxes side(patch_with(0, std::tan(angle)), kG);
  EXPECT_NEAR(side.gravity_left_mps2, -kG * std::sin(angle), 1e-15);
  EXPECT_NEAR(side.gravity_normal_mps2, kG * std::cos(angle), 1e-15);
}

TEST(PatchAxes, GravityKeepsItsSizeAndTheTiltIsThePlanes) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> slope(-1, 1);
  for (int i = 0; i < 50; ++i) {
    const GroundPatch patch = patch_with(slope(random), slope(random));
    const PatchAxes axes(patch, kG);
    EXPECT_NEAR(
        std::hypot(axes.gravity_forward_mps2, axes.gravity_left_mps2, axes.gravity_normal_mps2), kG,
        1e-14);
    EXPECT_NEAR(axes.gravity_normal_mps2, kG * std::cos(patch.tilt_rad()), 1e-14);
  }
}

TEST(PatchAxes, VelocitiesInThePlaneKeepTheirLengthAndThePowerOfGravity) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> slope(-1, 1), speed(-2, 2);
  for (int i = 0; i < 50; ++i) {
    const GroundPatch patch = patch_with(slope(random), slope(random));
    const PatchAxes axes(patch, kG);
    const double vx = speed(random), vy = speed(random);
    const double forward = axes.forward_per_vx * vx + axes.forward_per_vy * vy;
    const double left = axes.left_per_vy * vy;
    const double up = patch.slope_forward * forward + patch.slope_left * left;
    EXPECT_NEAR(std::hypot(forward, left, up), std::hypot(vx, vy), 1e-13);
    EXPECT_NEAR(axes.gravity_forward_mps2 * vx + axes.gravity_left_mps2 * vy, -kG * up, 1e-13);
  }
}

TEST(PatchAxes, TheHeadingTurnsAsTheBodyTurnsAboutTheNormal) {
  // The x axis of a body on the plane z = a x + b y, turned by a small angle about the normal.
  const double a = 0.5, b = -0.3, yaw = 0.8, turn = 1e-6;
  const GroundPatch patch = Plane{a, b}(0, 0, yaw);
  const PatchAxes axes(patch, kG);
  // After the turn the body's x axis points along x cos(turn) + y sin(turn).
  const double forward = axes.forward_per_vx + turn * axes.forward_per_vy;
  const double left = turn * axes.left_per_vy;
  EXPECT_NEAR(std::atan2(left, forward) / turn, axes.yaw_per_turn, 1e-5);
}

}  // namespace
}  // namespace regoplan
