#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/recording/noise_model.h"

namespace regoplan {

/// How replicates change in the course of a recording, or from place to place: what would else be
/// taken for scatter.
struct Course {
  /// `time_s`, `day`, `on_day`, `run_order`, `warm_up`, `after_slip_ratio`, `after_load_n`,
  /// `position_m`
  std::string column;
  std::string kind;      ///< what changes: `offset`, `gain`, `cohesion`, `strength`, `stiffness`
  double gain_nats = 0;  ///< over days and scatter alone, all channels
  std::vector<double> along;  ///< of the column, per run
  std::vector<double> value;  ///< what replicates follow, per run, from 0 to 1
  /// What 0 and 1 stand for, in the column's unit; of a stretch, the first and the last of those
  /// whose value is 1; of `on_day` which day of the recording that is, counted from 1.
  double low = 0, high = 0;
  bool is_stretch = false;  ///< the value is 1 on a part of the column and 0 elsewhere
  std::vector<std::vector<double>> trend;  ///< per channel and run, as estimate_noise() takes it

  /// Whether it follows time, so that time can be a place.
  bool in_time() const { return !after_run() && !in_place(); }
  /// Whether it follows what the run before was.
  bool after_run() const { return column == "after_slip_ratio" || column == "after_load_n"; }
  /// Whether replicates of one day, or of some time, differ from all others.
  bool for_a_time() const { return is_stretch && in_time(); }
  /// Whether replicates on some stretch of the bed differ from those elsewhere.
  bool in_place() const { return column == "position_m"; }
};

/// Changes of the model values of one channel that a course may follow, per run.
struct CourseKind {
  std::string name;
  std::vector<std::vector<double>> of_channel;
};

/// The likeliest course of the replicates' differences; nothing where none gains anything over days
/// and scatter alone.
std::optional<Course> likeliest_course(const Recording& recording,
                                       const std::vector<Condition>& conditions,
                                       const std::vector<ChannelRuns>& channels,
                                       const std::vector<CourseKind>& kinds,
                                       const DiagnosisSetup& setup,
                                       const std::stop_token& stop = {});

/// Runs in blocks of the course: days where there are at most six, else quarters, parted where a
/// stretch begins or ends.
std::vector<int> blocks_of(const Course& course);

}  // namespace regoplan
