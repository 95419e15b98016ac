#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// By what a column of each drive is to be multiplied, in the order of the drives; nothing where a
/// drive lacks it or is too short to say.
using ColumnFactors = std::vector<std::optional<double>>;

/// Drives that say nothing follow the others where these agree. \returns the factor of each drive
std::vector<double> with_others_followed(const ColumnFactors& factors);

/// Multiplies a column of each drive that has it; windows are to be read anew.
void multiply_column(std::string_view channel, const std::vector<double>& factors,
                     std::vector<DriveRecording>& drives);

/// Columns that are taken with one factor in the same drives.
struct FactoredColumns {
  std::vector<double> factors;  ///< of each drive
  std::vector<std::string> channels;

  double factor() const;  ///< that is not 1
  bool is_of_every_drive() const;
  /// Puts a column to those of the same factors.
  static void add(std::string channel, std::vector<double> factors,
                  std::vector<FactoredColumns>& groups);
};

/// Names of columns as every unit of a log has them, `steer_front_left`.
std::vector<std::string> without_units(std::vector<std::string> channels);

/// A finding of all drives together where it is of every one, else one of each that it is of.
std::vector<DriveFinding> findings_of(const FactoredColumns& columns, const DriveFinding& finding,
                                      const std::vector<DriveRecording>& drives);

}  // namespace regoplan
