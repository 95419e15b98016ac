#pragma once

#include <chrono>
#include <string>

#include "planner/plan.h"

namespace regoplan {

/// One line on a terminal's standard error that shows how far long work has come. Silent where
/// standard error is no terminal, or when quiet. Ends with its line wiped.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const PlanProgress& progress);
  /// Takes the line off the terminal, so that something else can be printed.
  void wipe();
  /// \param share of this stage, 0 to 1
  void show(std::string_view stage, double share);

 private:
  bool is_due(std::string_view stage);

  bool on_;
  bool shown_ = false;
  std::string stage_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace regoplan
