#include "terramech/basics/bracketed_root.h"

#include <gtest/gtest.h>

#include <cmath>

namespace regoplan {
namespace {

template <class Function>
double root_between(const Function& f, double from, double to, const RootTolerance& tolerance) {
  return bracketed_root(f, {.from = from, .f_from = f(from), .to = to, .f_to = f(to)}, tolerance);
}

TEST(BracketedRoot, IsFoundFromEitherSide) {
  const auto f = [](double x) { return std::exp(x) - 5; };
  EXPECT_NEAR(root_between(f, 0, 10, {.argument = 1e-13}), std::log(5), 1e-12);
  EXPECT_NEAR(root_between(f, 10, 0, {.argument = 1e-13}), std::log(5), 1e-12);
}

TEST(BracketedRoot, ClosesInOnAJump) {
  const auto f = [](double x) { return x < 0.3 ? -1.0 : 100.0; };
  EXPECT_NEAR(root_between(f, 0, 1, {.argument = 1e-6, .calls_max = 200}), 0.3, 1e-2);
}

TEST(BracketedRoot, AsksNoMoreOftenThanAllowed) {
  int calls = 0;
  const auto f = [&](double x) {
    ++calls;
    return x * x * x - 2;
  };
  bracketed_root(f, {.from = 0, .f_from = -2, .to = 2, .f_to = 6}, {.calls_max = 3});
  EXPECT_EQ(calls, 3);
}

TEST(BracketedRoot, AnEndThatIsCloseEnoughIsTheAnswer) {
  const auto f = [](double) -> double { throw "not to be asked"; };
  EXPECT_EQ(bracketed_root(f, {.from = 0, .f_from = -1, .to = 1, .f_to = 0}, {}), 1);
}

}  // namespace
}  // namespace regoplan
