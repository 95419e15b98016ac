#include "benchmarks/planner/random_problem.h"

#include <gtest/gtest.h>

#include "planner/certificate/relaxed_problem.h"

namespace regoplan {

TEST(RelaxedProblem, OnRandomMapsNoCertificateWhereAVerifiedPathIs) {
  int certified = 0, passed = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const PlanningProblem problem = random_problem(seed);
    const bool impossible = certificate_of_infeasibility(problem).has_value();
    const bool path = verified_path_found(problem, "Lattice", 800);
    EXPECT_FALSE(impossible && path) << "map " << seed;
    certified += impossible;
    passed += path;
  }
  // Both answers occur, or the law would hold of nothing.
  EXPECT_GT(certified, 0);
  EXPECT_GT(passed, 0);
}

}  // namespace regoplan
