#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "terramech/tables/csv_table.h"

namespace regoplan {

/// A row that a recording does without, because of one of its numbers.
struct LeftOutRow {
  std::string run_id;
  CellOutOfRange cell;
  std::string why;  ///< with file, line, column, value and range
};

/// What a recording itself says of its wheel, in columns that hold one value.
struct RecordedWheel {
  std::optional<double> radius_m, width_m, lug_height_m;
  std::optional<int> lug_count;
};

/// A recording with the table that it was read from.
struct RecordingFile {
  std::string file;
  Recording recording;
  RecordedWheel wheel = {};
  std::vector<std::string> columns;             ///< of the table
  std::vector<std::vector<std::string>> cells;  ///< of each run, as wide as `columns`
  std::vector<std::int64_t> lines;              ///< of each run in the file
  std::vector<LeftOutRow> left_out = {};        ///< rows that are none of the runs
};

/// Reads a single-wheel recording: `run_id, load_n, slip_ratio, slip_angle_deg`, at least one of
/// `fx_n, fy_n, torque_nm, sinkage_m, rut_left_m, rut_right_m`, and what else is known of the runs
/// (`day, replicate, pass, speed_mps, time_s, wheel_angle_deg, position_m, wheel`), and of the
/// wheel
/// (`wheel_radius_m, wheel_width_m, lug_height_m, lug_count`, one value each). An empty cell
/// of a channel is not measured; a column of empty cells counts as not given. Other columns are
/// kept and listed as ignored. A row with a number outside its range, as sensors give one now and
/// then, is left out; where that is more than one row in twenty, the recording is refused. Runs
/// that repeat others are left out with a warning (`copied_runs.h`).
/// \throws InputError naming file, line, column, value, range and, where the value hints at one,
/// the unit that may be meant
RecordingFile read_recording(const std::string& file);
RecordingFile read_recording(std::istream& stream, const std::string& file);

/// Columns that are not used, each with the known one that it may be meant for.
std::vector<std::string> ignored_columns(const RecordingFile& read);

/// The setup with the wheel that the recording tells.
DiagnosisSetup setup_with(DiagnosisSetup setup, const RecordedWheel& wheel);

}  // namespace regoplan
