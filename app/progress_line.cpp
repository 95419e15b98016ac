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

void ProgressLine::show(const PlanProgress& progress) {
  if (!on_) return;
  const auto now = std::chrono::steady_clock::now();
  if (progress.stage == stage_ && now < next_) return;
  stage_ = progress.stage;
  next_ = now + std::chrono::milliseconds(100);
  shown_ = true;
  fmt::print(stderr, "{}{} {:.0f} %, {} found", kWipeLine, stage_, 100 * progress.share,
             progress.found);
  std::fflush(stderr);
}

}  // namespace regoplan
