#include "app/command/suite_progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "app/command/terminal_line.h"

namespace regoplan {
namespace {

std::string words(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

SuiteProgressLine::SuiteProgressLine(bool quiet)
    : on_(!quiet), terminal_(isatty(STDERR_FILENO) == 1) {
  if (!terminal_) next_ = std::chrono::steady_clock::now() + std::chrono::minutes(1);
}

SuiteProgressLine::~SuiteProgressLine() {
  if (shown_ && terminal_) std::fputs(kWipeLine, stderr);
}

void SuiteProgressLine::show(const SuiteProgress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (!on_ || now < next_) return;
  next_ = now + (terminal_ ? std::chrono::milliseconds(100) : std::chrono::minutes(1));
  shown_ = true;
  const std::string remaining =
      progress.remaining_s ? fmt::format(", about {} left", words(*progress.remaining_s)) : "";
  fmt::print(stderr, "{}{} of {} runs{} ({}){}", terminal_ ? kWipeLine : "", progress.done,
             progress.total, remaining, progress.experiment, terminal_ ? "" : "\n");
  std::fflush(stderr);
}

}  // namespace regoplan
