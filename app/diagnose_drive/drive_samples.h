#pragma once

#include <string>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// Samples of a drive as they come, in bounded memory: when they are too many, each two become one.
class DriveSamples {
 public:
  /// \param names channels, `time_s, x_m, y_m` among them \param samples_max even
  DriveSamples(std::vector<std::string> names, std::size_t samples_max);

  /// \param values one of each channel, NaN where it was not sampled
  void add(const std::vector<double>& values);
  /// Hands the samples over.
  void give(DriveRecording& drive);

 private:
  enum class Merge { kMean, kLast, kFirst };
  struct Column {
    std::string name;
    Merge merge = Merge::kMean;
    std::vector<double> precise;  ///< of time and position
    std::vector<float> values;    ///< of all else
    bool is_precise = false;
    double sum = 0, last = 0;
    int count = 0;
  };
  void flush();
  void halve();

  std::vector<Column> columns_;
  std::size_t samples_max_;
  std::size_t size_ = 0;
  int rows_per_sample_ = 1;
  int pending_ = 0;
};

}  // namespace regoplan
