#pragma once

#include <optional>
#include <string_view>

#include "planner/runtime/time_budget.h"
#include "planner/stages/plan_session.h"

namespace regoplan {

/// Tells whoever watches a plan what is being done and what has been found.
class Announcements {
 public:
  /// Both must outlive it.
  Announcements(const PlanSession& session, const TimeBudget& budget)
      : session_(session), budget_(budget) {}

  /// \param share of the stage that is done, 0 to 1
  void stage(std::string_view stage, double share) const;
  void path_found() { ++found_; }
  void path_verified(const Candidate& candidate);

  int found() const { return found_; }
  int verified() const { return verified_; }
  std::optional<double> first_verified_s() const { return first_verified_s_; }

 private:
  const PlanSession& session_;
  const TimeBudget& budget_;
  int found_ = 0, verified_ = 0;
  std::optional<double> first_verified_s_;  ///< since the plan's start
};

}  // namespace regoplan
