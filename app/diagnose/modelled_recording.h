#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "app/diagnose/recording_file.h"
#include "diagnosis/diagnosis.h"
#include "terramech/wheel/wheel_model.h"

namespace regoplan {

bool is_length(Channel channel);

/// A recording beside what the wheel model has for its runs at the prior means.
class ModelledRecording {
 public:
  ModelledRecording(const RecordingFile& file, const DiagnosisSetup& setup);

  const RecordingFile& file() const { return file_; }
  const std::vector<WheelRun>& runs() const { return file_.recording.runs; }
  const Wheel& wheel() const { return wheel_; }
  const WheelModel& model() const { return model_; }
  const WheelForces& forces(std::size_t run) const { return at_[run].forces; }
  double modelled(std::size_t run, Channel channel) const;
  /// What limits a channel: the load, load times radius, or the radius.
  double reach(std::size_t run, Channel channel) const;
  bool is_measured(Channel channel) const;
  /// Both the recording and the model have a number.
  bool is_comparable(std::size_t run, Channel channel) const;
  /// `file:line` of a run.
  std::string place(std::size_t run) const;
  /// How a channel's changes from run to run follow the model's: 1 as they do, -1 the other way.
  double correlation(Channel channel) const;

 private:
  const RecordingFile& file_;
  const Wheel& wheel_;
  WheelModel model_;
  std::vector<WheelChannels> at_;
};

}  // namespace regoplan
