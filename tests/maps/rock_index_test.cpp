#include "maps/rock_index.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace regoplan {
namespace {

TEST(RockIndex, FindsExactlyTheRocksWhoseSquareTouchesTheRectangleEachOnce) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-50, 150);
  std::uniform_real_distribution<double> radius(0.1, 4);
  std::vector<Rock> rocks;
  for (int i = 0; i < 500; ++i) rocks.push_back({place(random), place(random), radius(random), 1});
  const RockIndex index(rocks);
  for (int i = 0; i < 500; ++i) {
    const double x_m = place(random);
    const double y_m = place(random);
    const double width_m = i % 3 == 0 ? 0 : 5 * radius(random);
    std::multiset<double> expected;
    for (const Rock& rock : rocks) {
      if (rock.x_m + rock.radius_m >= x_m && rock.x_m - rock.radius_m <= x_m + width_m &&
          rock.y_m + rock.radius_m >= y_m && rock.y_m - rock.radius_m <= y_m + width_m) {
        expected.insert(rock.x_m);
      }
    }
    std::multiset<double> found;
    const bool any = index.any_of(x_m, x_m + width_m, y_m, y_m + width_m, [&](const Rock& rock) {
      found.insert(rock.x_m);
      return false;
    });
    ASSERT_FALSE(any);
    ASSERT_EQ(found, expected);
  }
}

TEST(RockIndex, StopsAtTheFirstRockThatPasses) {
  const RockIndex index({{0, 0, 1, 1}, {0.5, 0, 1, 1}});
  int visits = 0;
  EXPECT_TRUE(index.any_of(0, 1, 0, 1, [&](const Rock&) { return ++visits > 0; }));
  EXPECT_EQ(visits, 1);
  EXPECT_FALSE(index.any_of(10, 11, 0, 1, [](const Rock&) { return true; }));
  EXPECT_FALSE(RockIndex().any_of(0, 1, 0, 1, [](const Rock&) { return true; }));
}

}  // namespace
}  // namespace regoplan
