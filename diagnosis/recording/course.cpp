#include "diagnosis/recording/course.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "diagnosis/recording/replicate_contrasts.h"
#include "diagnosis/recording/replicates.h"
#include "diagnosis/recording/run_times.h"
#include "diagnosis/recording/thresholds.h"
#include "terramech/basics/interruption.h"

namespace regoplan {
namespace {

/// Up to which days are looked at one by one.
constexpr std::size_t kMostDays = 6;

struct Column {
  std::string name;
  std::vector<double> along;  // per run
  std::vector<double> value;  // per run, from 0 to 1
  double low = 0, high = 0;
  double cost_nats = 0;  // of having been chosen among others of its name
  bool is_stretch = false;
};

void add(std::string name, std::vector<double> value, std::vector<Column>& columns) {
  const auto [low, high] = std::ranges::minmax(value);
  if (!(high > low)) return;
  std::vector<double> along = value;
  for (double& v : value) v = (v - low) / (high - low);
  columns.push_back({.name = std::move(name),
                     .along = std::move(along),
                     .value = std::move(value),
                     .low = low,
                     .high = high});
}

/// Stretches between any two sixteenths of the runs along a column, and from one to its end.
/// \param along of each run
void add_stretches(const std::string& name, const std::vector<double>& along,
                   std::vector<Column>& columns) {
  constexpr std::size_t kParts = 16;
  std::vector<double> sorted = along;
  std::ranges::sort(sorted);
  std::vector<double> edges;
  for (std::size_t k = 1; k < kParts; ++k) edges.push_back(sorted[along.size() * k / kParts]);
  edges.push_back(std::nextafter(sorted.back(), INFINITY));
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<Column> stretches;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      Column column{
          .name = name, .along = along, .low = edges[i], .high = edges[i], .is_stretch = true};
      for (const double at : along) {
        const bool inside = at >= edges[i] && at < edges[k];
        column.value.push_back(inside ? 1 : 0);
        if (inside) column.high = std::max(column.high, at);
      }
      stretches.push_back(std::move(column));
    }
  }
  for (Column& column : stretches) {
    column.cost_nats = std::log(static_cast<double>(stretches.size()));
    columns.push_back(std::move(column));
  }
}

/// Each day apart from all others.
void add_days(const std::vector<WheelRun>& runs, const std::set<double>& days,
              std::vector<Column>& columns) {
  double count = 0;
  for (const double day : days) {
    ++count;
    Column column{.name = "on_day", .low = count, .high = count, .is_stretch = true};
    for (const WheelRun& run : runs) {
      column.along.push_back(run.day);
      column.value.push_back(run.day == day ? 1 : 0);
    }
    columns.push_back(std::move(column));
  }
}

/// What the runs may follow; rows stand in the order of the runs.
std::vector<Column> columns_of(const Recording& recording) {
  const std::vector<WheelRun>& runs = recording.runs;
  const auto each = [&](const auto& of) {
    std::vector<double> value;
    for (std::size_t i = 0; i < runs.size(); ++i) value.push_back(of(i));
    return value;
  };
  std::vector<Column> columns;
  const std::vector<double> time_s = each([&](std::size_t i) { return runs[i].conditions.time_s; });
  const std::vector<double> order = each([](std::size_t i) { return static_cast<double>(i); });
  // Days that are told go by the recording's own numbers; such as nobody told have no time.
  const std::string when = recording.columns.time ? "time_s" : "day";
  const std::vector<double> at =
      recording.columns.time ? time_s : each([&](std::size_t i) { return runs[i].day; });
  // Of two times alone, as of two days, each apart from the other says the same.
  if (std::set(time_s.begin(), time_s.end()).size() > 2) add(when, at, columns);
  const auto n = static_cast<double>(runs.size());
  add("run_order", order, columns);
  add("warm_up", each([&](std::size_t i) { return std::exp(-8 * static_cast<double>(i) / n); }),
      columns);
  add("after_slip_ratio", each([&](std::size_t i) { return i == 0 ? 0 : runs[i - 1].slip_ratio; }),
      columns);
  add("after_load_n", each([&](std::size_t i) { return runs[i == 0 ? 0 : i - 1].load_n; }),
      columns);
  std::set<double> days;
  for (const WheelRun& run : runs) days.insert(run.day);
  const bool are_few = days.size() > 1 && days.size() <= kMostDays;
  if (are_few) add_days(runs, days, columns);
  // Days that nobody told begin where they were assumed to; of many, some may differ together.
  if (!are_few || !recording.columns.day) {
    if (tells_times(recording)) {
      add_stretches(when, at, columns);
    } else {
      add_stretches("run_order", order, columns);
    }
  }
  if (recording.columns.position) {
    add_stretches("position_m", each([&](std::size_t i) { return runs[i].conditions.position_m; }),
                  columns);
  }
  return columns;
}

/// Sizes by which runs may follow a column, those of replicates alike: what their loads differ by
/// is no course, however late in the recording they were run.
std::vector<double> size_of_conditions(const std::vector<double>& of_run,
                                       const std::vector<Condition>& conditions) {
  std::vector<double> size(of_run.size(), 0.0);
  for (const Condition& at : conditions) {
    double sum = 0, count = 0;
    for (const std::size_t run : at.runs) {
      if (!std::isfinite(of_run[run])) continue;
      sum += of_run[run];
      ++count;
    }
    for (const std::size_t run : at.runs) size[run] = count > 0 ? sum / count : 0;
  }
  return size;
}

/// How many runs tell what follows a column: (sum of v)^2 over the sum of v^2, v the squared
/// distance of a run from the mean of its replicates.
double runs_that_carry(const Column& column, const std::vector<Condition>& conditions) {
  double sum = 0, squares = 0;
  for (const Condition& at : conditions) {
    double mean = 0;
    for (const std::size_t run : at.runs) mean += column.value[run];
    mean /= static_cast<double>(at.runs.size());
    for (const std::size_t run : at.runs) {
      const double v = std::pow(column.value[run] - mean, 2);
      sum += v;
      squares += v * v;
    }
  }
  return squares > 0 ? sum * sum / squares : 0;
}

using ChannelContrasts = std::vector<std::optional<ReplicateContrasts>>;

/// What the replicates of each channel say, where they tell its noise.
ChannelContrasts contrasts_of(const Recording& recording, const std::vector<Condition>& conditions,
                              const std::vector<ChannelRuns>& channels, const DiagnosisSetup& setup,
                              const std::stop_token& stop) {
  ChannelContrasts contrasts;
  for (const ChannelRuns& c : channels) {
    const ChannelNoise plain = estimate_noise(recording, conditions, c, setup, {}, stop);
    auto& of_channel = contrasts.emplace_back();
    if (plain.source == NoiseSource::kReplicates) {
      of_channel.emplace(recording, conditions, c.adjusted, plain);
    }
  }
  return contrasts;
}

/// What the replicates of all channels gain by following trends, each with a factor of its own.
double gain_nats(const ChannelContrasts& contrasts, const std::vector<std::vector<double>>& trend) {
  constexpr double kCost_nats = 0.5;  // a factor counts like another part of the noise model
  double gain = 0;
  for (std::size_t c = 0; c < contrasts.size(); ++c) {
    if (contrasts[c]) gain += contrasts[c]->gain(trend[c]) - kCost_nats;
  }
  return gain;
}

}  // namespace

std::optional<Course> likeliest_course(const Recording& recording,
                                       const std::vector<Condition>& conditions,
                                       const std::vector<ChannelRuns>& channels,
                                       const std::vector<CourseKind>& kinds,
                                       const DiagnosisSetup& setup, const std::stop_token& stop) {
  const ChannelContrasts contrasts = contrasts_of(recording, conditions, channels, setup, stop);
  std::optional<Course> best;
  for (const Column& column : columns_of(recording)) {
    if (runs_that_carry(column, conditions) < Thresholds::kCourseRuns) continue;
    for (const CourseKind& kind : kinds) {
      throw_if_stopped(stop);
      Course course{.column = column.name,
                    .kind = kind.name,
                    .along = column.along,
                    .value = column.value,
                    .low = column.low,
                    .high = column.high,
                    .is_stretch = column.is_stretch};
      for (std::size_t c = 0; c < channels.size(); ++c) {
        std::vector<double> trend = size_of_conditions(kind.of_channel[c], conditions);
        for (std::size_t i = 0; i < trend.size(); ++i) trend[i] *= column.value[i];
        course.trend.push_back(std::move(trend));
      }
      course.gain_nats = gain_nats(contrasts, course.trend) - column.cost_nats;
      if (course.gain_nats > (best ? best->gain_nats : 0)) best = course;
    }
  }
  return best;
}

std::vector<int> blocks_of(const Course& course) {
  constexpr std::size_t kQuarters = 4;
  const std::set<double> values(course.along.begin(), course.along.end());
  std::vector<int> block;
  for (std::size_t i = 0; i < course.along.size(); ++i) {
    const double at = course.along[i];
    if (values.size() <= kMostDays) {
      block.push_back(static_cast<int>(std::distance(values.begin(), values.find(at))));
      continue;
    }
    const auto before = static_cast<std::size_t>(
        std::ranges::count_if(course.along, [&](double v) { return v < at; }));
    const auto quarter = static_cast<int>(before * kQuarters / course.along.size());
    constexpr int kBefore = 0, kInside = 1, kAfter = 2;
    int side = kBefore;
    if (course.is_stretch && at >= course.low) side = at <= course.high ? kInside : kAfter;
    block.push_back(3 * quarter + side);
  }
  return block;
}

}  // namespace regoplan
