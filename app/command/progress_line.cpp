#include "app/command/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/command/terminal_line.h"

namespace regoplan {

ProgressLine::ProgressLine(bool quiet) : on_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  wipe();
}

void ProgressLine::wipe() {
  if (shown_) std::fputs(kWipeLine, stderr);
  shown_ = false;
  stage_.clear();  // whatever comes next is due at once
}

bool ProgressLine::is_due(std::string_view stage) {
  if (!on_) return false;
  const auto now = std::chrono::steady_clock::now();
  if (stage == stage_ && now < next_) return false;
  stage_ = stage;
  next_ = now + std::chrono::milliseconds(100);
  shown_ = true;
  return true;
}

void ProgressLine::show(std::string_view stage, double share) {
  if (!is_due(stage)) return;
  fmt::print(stderr, "{}{} {:.0f} %", kWipeLine, stage_, 100 * share);
  std::fflush(stderr);
}

void ProgressLine::show(const PlanProgress& progress) {
  if (!is_due(progress.stage)) return;
  fmt::print(stderr, "{}{} {:.0f} %, {} found, {} verified", kWipeLine, stage_,
             100 * progress.share, progress.found, progress.verified);
  std::fflush(stderr);
}

}  // namespace regoplan
