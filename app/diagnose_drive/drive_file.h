#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/diagnose_drive/drive_columns.h"
#include "drive_diagnosis/recording/drive_recording.h"

namespace regoplan {

/// Most samples of a drive that are held: of a longer file, as many rows as it takes are averaged
/// into one (positions and headings: the last one counts).
inline constexpr std::size_t kDriveSamplesMax = 1'000'000;

/// Reads the recording of a drive. Rows that cannot be used (a cell too many, no time) and cells
/// that are no number or out of range are left out, each kind told once as a finding with its
/// count and first line; where that is more than one row in twenty, the file is refused. Time that
/// runs back is put right (`mend_time`). Columns not known are ignored, and listed.
/// \throws InputError naming file, line, column, value and range
DriveRecording read_drive(const std::string& file, const DriveColumnMap& map);
DriveRecording read_drive(std::istream& stream, const std::string& file, const DriveColumnMap& map);

}  // namespace regoplan
