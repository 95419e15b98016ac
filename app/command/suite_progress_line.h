#pragma once

#include <chrono>

#include "benchmarking/suite_run.h"

namespace regoplan {

/// One line on a terminal's standard error that shows how far a suite has come and what remains;
/// where standard error is no terminal, a line every minute. Silent when quiet.
class SuiteProgressLine {
 public:
  explicit SuiteProgressLine(bool quiet);
  ~SuiteProgressLine();
  SuiteProgressLine(const SuiteProgressLine&) = delete;
  SuiteProgressLine& operator=(const SuiteProgressLine&) = delete;

  void show(const SuiteProgress& progress);

 private:
  bool on_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace regoplan
