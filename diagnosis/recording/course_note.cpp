#include "diagnosis/recording/course_note.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/recording/thresholds.h"

namespace regoplan {
namespace {

/// "follow run_order", "differ on day 2 of the recording".
std::string course_words(const Course& course) {
  if (course.column == "on_day") {
    return fmt::format("differ on day {:.0f} of the recording", course.low);
  }
  if (!course.is_stretch) return fmt::format("follow {}", course.column);
  if (course.column == "run_order") {
    return fmt::format("differ at runs {:.0f} to {:.0f}", course.low + 1, course.high + 1);
  }
  return fmt::format("differ at {} {:.6g} to {:.6g}", course.column, course.low, course.high);
}

}  // namespace

std::string doubtful_course_note(const Course& course) {
  return fmt::format(
      "replicates may {} ({}; {:.1f} nats over usual days and scatter alone, {:g} are asked for): "
      "it is taken for scatter",
      course_words(course), course.kind, course.gain_nats, Thresholds::kCourse_nats);
}

std::string course_note(const Course& course, const std::vector<ChannelNoise>& noise) {
  std::string text = fmt::format(
      "replicates do not scatter only: they {} ({}; {:.0f} nats over usual days and scatter alone)",
      course_words(course), course.kind, course.gain_nats);
  for (std::size_t c = 0; c < noise.size(); ++c) {
    double low = INFINITY, high = -INFINITY;
    for (const double t : course.trend[c]) {
      low = std::min(low, noise[c].trend * t);
      high = std::max(high, noise[c].trend * t);
    }
    text += fmt::format("{} {} by {:.3g}", c == 0 ? ":" : ",", name(noise[c].channel), high - low);
  }
  return text;
}

}  // namespace regoplan
