#pragma once

#include <chrono>
#include <string>

#include "planner/plan.h"

namespace regoplan {

/// One line on a terminal's standard error that shows how far a plan has come. Silent where
/// standard error is no terminal, or when quiet. Ends with its line wiped.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const PlanProgress& progress);

 private:
  bool on_;
  bool shown_ = false;
  std::string stage_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace regoplan
