#include "app/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace regoplan {

namespace {
constexpr const char* kWipeLine = "\r\033[K";
}

ProgressLine::ProgressLine(bool quiet) : on_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs(kWipeLine, stderr);
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
  fmt::print(stderr, "{}{} {:.0f} %, {} found", kWipeLine, stage_, 100 * progress.share,
             progress.found);
  std::fflush(stderr);
}

}  // namespace regoplan
