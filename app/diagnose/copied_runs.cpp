#include "app/diagnose/copied_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

namespace regoplan {
namespace {

constexpr double kBeyondChance = 10;  ///< so many times the pairs that are alike by chance

/// Digits of a number but for zeros at its ends, which a writer may have added.
int significant_digits(std::string_view cell) {
  std::string digits;
  for (const char letter : cell.substr(0, cell.find_first_of("eE"))) {
    if (letter >= '0' && letter <= '9') digits += letter;
  }
  const std::size_t first = digits.find_first_not_of('0');
  if (first == std::string::npos) return 0;
  return static_cast<int>(digits.find_last_not_of('0') - first) + 1;
}

/// What two runs have to share for one to be a replicate of the other; day, time and position may
/// be others.
using Commanded = std::tuple<double, double, double, int, double, double, std::string>;

Commanded commanded(const WheelRun& run) {
  const WheelConditions& at = run.conditions;
  return {run.load_n,   run.slip_ratio,     run.slip_angle_rad, at.pass,
          at.speed_mps, at.wheel_angle_rad, run.wheel};
}

double pairs_among(std::size_t runs) {
  return static_cast<double>(runs) * (static_cast<double>(runs) - 1) / 2;
}

/// What runs at the same conditions have in common, to the last digit.
class Repeats {
 public:
  explicit Repeats(const RecordingFile& file) : file_(file) {
    std::map<Commanded, std::vector<std::size_t>> alike;
    const std::vector<WheelRun>& runs = file.recording.runs;
    for (std::size_t i = 0; i < runs.size(); ++i) alike[commanded(runs[i])].push_back(i);
    for (const auto& [conditions, same] : alike) compare(same);
  }

  /// Runs whose values are those of an earlier run, each with the first such.
  const std::map<std::size_t, std::size_t>& copies() const { return copies_; }

  /// Pairs that would have the same values in all channels if each channel agreed by itself, as
  /// often as it does in pairs that are no copies.
  double pairs_by_chance() const {
    double expected = differing_;
    for (const Channel channel : channels()) {
      if (differing_ > 0) expected *= agreeing_[static_cast<std::size_t>(channel)] / differing_;
    }
    return expected;
  }

 private:
  const std::vector<Channel>& channels() const { return file_.recording.channels; }

  /// A channel's value; of one that was not measured, what no sensor says.
  double key(std::size_t run, Channel channel) const {
    const double value = file_.recording.runs[run].value(channel);
    return std::isnan(value) ? HUGE_VAL : value;
  }

  /// Whether values are told with so many digits that runs do not share them by chance.
  bool is_told_finely(std::size_t run) const {
    constexpr int kFewestChannels = 2, kFewestDigits = 3;
    return std::ranges::count_if(channels(), [&](Channel channel) {
             const auto column = std::ranges::find(file_.columns, name(channel));
             const auto index = static_cast<std::size_t>(column - file_.columns.begin());
             return significant_digits(file_.cells[run][index]) >= kFewestDigits;
           }) >= kFewestChannels;
  }

  void compare(const std::vector<std::size_t>& runs) {
    std::map<std::vector<double>, std::vector<std::size_t>> alike;
    std::array<std::map<double, std::size_t>, kChannelCount> with_value;
    for (const std::size_t run : runs) {
      std::vector<double> values;
      for (const Channel channel : channels()) {
        values.push_back(key(run, channel));
        ++with_value[static_cast<std::size_t>(channel)][values.back()];
      }
      alike[values].push_back(run);
    }
    double in_all = 0;
    for (const auto& [values, same] : alike) {
      in_all += pairs_among(same.size());
      for (const std::size_t run : same) {
        if (run != same.front() && is_told_finely(run)) copies_[run] = same.front();
      }
    }
    differing_ += pairs_among(runs.size()) - in_all;
    for (const Channel channel : channels()) {
      const auto at = static_cast<std::size_t>(channel);
      for (const auto& [value, count] : with_value[at]) agreeing_[at] += pairs_among(count);
      agreeing_[at] -= in_all;
    }
  }

  const RecordingFile& file_;
  std::map<std::size_t, std::size_t> copies_;
  double differing_ = 0;                          ///< pairs that differ in some channel
  std::array<double, kChannelCount> agreeing_{};  ///< of these, by channel
};

template <class Item>
void erase_at(std::vector<Item>& items, const std::map<std::size_t, std::size_t>& at) {
  for (auto one = at.rbegin(); one != at.rend(); ++one) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(one->first));
  }
}

}  // namespace

std::optional<std::string> leave_out_copies(RecordingFile& file) {
  const Repeats repeats(file);
  const std::map<std::size_t, std::size_t>& copies = repeats.copies();
  const auto count = static_cast<double>(copies.size());
  if (copies.empty() || count <= kBeyondChance * repeats.pairs_by_chance()) return std::nullopt;
  const auto [copy, original] = *copies.begin();
  const std::string told = fmt::format(
      "{}: load, slip, slip angle and every measured value of {} of {} rows are those of an "
      "earlier row, "
      "to the last digit (run_id {} in line {} those of {} in line {}); they are left out: a copy "
      "is no replicate",
      file.file, copies.size(), file.recording.runs.size(), file.recording.runs[copy].run_id,
      file.lines[copy], file.recording.runs[original].run_id, file.lines[original]);
  erase_at(file.recording.runs, copies);
  erase_at(file.cells, copies);
  erase_at(file.lines, copies);
  return told;
}

}  // namespace regoplan
