#include "app/diagnose/recording_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>

#include "app/diagnose/copied_runs.h"
#include "app/diagnose/diagnosis_setup.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/mechanisms/mechanism.h"
#include "terramech/tables/csv_table.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

using Cells = CsvTable::Cells;

constexpr std::array<std::string_view, 4> kRequired{"run_id", "load_n", "slip_ratio",
                                                    "slip_angle_deg"};

/// What a sensor of a wheel can say at most, in N, N m, m, m/s or degrees; and a clock in seconds,
/// or in milliseconds since 1970. Beyond it is garbage, whose square no fit survives.
constexpr double kMost = 1e9, kLatest_s = 1e13;
constexpr ValueRange kMeasurable{.min = -kMost, .max = kMost};
constexpr ValueRange kPositive{.min = 0, .max = kMost, .min_excluded = true};
constexpr ValueRange kClock{.min = -kLatest_s, .max = kLatest_s};

/// A circumstance of the runs that is a number.
struct Circumstance {
  std::string_view column;
  ValueRange allowed;
  double WheelConditions::*member;
  double unit;
  bool RecordedColumns::*recorded;
};
constexpr std::array<Circumstance, 4> kCircumstances{{
    {"speed_mps", kPositive, &WheelConditions::speed_mps, 1, &RecordedColumns::speed},
    {"position_m", kMeasurable, &WheelConditions::position_m, 1, &RecordedColumns::position},
    {"time_s", kClock, &WheelConditions::time_s, 1, &RecordedColumns::time},
    {"wheel_angle_deg", kMeasurable, &WheelConditions::wheel_angle_rad, kDegree,
     &RecordedColumns::wheel_angle},
}};
constexpr std::array<std::string_view, 4> kOtherCircumstances{"day", "replicate", "pass", "wheel"};

/// Days since 1970-01-01 of `2020-11-16`, also with a time of day behind a `T` or a space.
std::optional<double> iso_day(std::string_view text) {
  if (text.size() < 10 || text[4] != '-' || text[7] != '-') return {};
  if (text.size() > 10 && text[10] != 'T' && text[10] != ' ') return {};
  const auto part = [&](std::size_t from, std::size_t length) {
    int value = -1;
    const char* end = text.data() + from + length;
    return std::from_chars(text.data() + from, end, value).ptr == end ? value : -1;
  };
  const int year = part(0, 4), month = part(5, 2), day = part(8, 2);
  if (year < 0 || month < 0 || day < 0) return {};
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return {};
  return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

/// What a slip ratio outside [-1, 1] may have been meant as.
std::string_view slip_hint(const std::string& cell) {
  const std::optional<double> value = parse_number(cell);
  if (!value || std::abs(*value) > 1e4) return "";
  if (*value < -1 && *value >= -5) {
    return "a braking wheel's slip is (r w - Vx)/Vx; it looks like (r w - Vx)/(r w)";
  }
  return std::abs(*value) > 1 ? "is it in per cent?" : "";
}

/// What a measured value that is no number may have been meant as.
std::string_view measured_hint(const std::string& cell) {
  return parse_number(cell) ? "" : "leave the cell empty where nothing was measured";
}

/// One row on its way to a run.
class Row {
 public:
  Row(const CsvTable& table, const Cells& cells) : table_(table), cells_(cells) {}

  double number(std::string_view column, const ValueRange& allowed,
                std::string_view hint = "") const {
    return table_.number(cells_, table_.column(column), allowed, hint);
  }

  const std::string& text(std::string_view column) const { return cells_[table_.column(column)]; }

  bool says(std::string_view column) const {
    const auto index = table_.find_column(column);
    return index && !cells_[*index].empty();
  }

  int integer(std::string_view column, int min) const {
    const double value = number(column, {.min = static_cast<double>(min), .max = 1e6});
    if (value != std::floor(value)) throw not_valid(column, fmt::format("an integer from {}", min));
    return static_cast<int>(value);
  }

  double day() const {
    const std::string& cell = text("day");
    if (const auto number = parse_number(cell)) return *number;
    if (const auto date = iso_day(cell)) return *date;
    throw not_valid("day", "a number or an ISO date such as 2020-11-16");
  }

 private:
  InputError not_valid(std::string_view column, std::string_view allowed) const {
    const std::string& cell = text(column);
    return table_.error(fmt::format("{}: {} is not valid (allowed: {})", column,
                                    cell.empty() ? "an empty cell" : cell, allowed));
  }

  const CsvTable& table_;
  const Cells& cells_;
};

WheelRun read_run(const CsvTable& table, const Cells& cells) {
  const Row row(table, cells);
  WheelRun run{.run_id = row.text("run_id")};
  run.load_n = row.number("load_n", kPositive);
  run.slip_ratio =
      row.number("slip_ratio", {.min = -1, .max = 1}, slip_hint(row.text("slip_ratio")));
  run.slip_angle_rad = row.number("slip_angle_deg", {.min = -90, .max = 90}) * kDegree;
  for (const Circumstance& at : kCircumstances) {
    if (row.says(at.column)) {
      run.conditions.*at.member = at.unit * row.number(at.column, at.allowed);
    }
  }
  if (row.says("pass")) run.conditions.pass = row.integer("pass", 1);
  if (row.says("day")) run.day = row.day();
  if (row.says("wheel")) run.wheel = row.text("wheel");
  if (row.says("replicate")) run.replicate = row.integer("replicate", 0);
  for (const Channel channel : kChannels) {
    if (row.says(name(channel))) {
      run.measured[static_cast<std::size_t>(channel)] =
          row.number(name(channel), kMeasurable, measured_hint(row.text(name(channel))));
    }
  }
  return run;
}

/// Setup columns: what the wheel of all runs was.
constexpr std::array<std::string_view, 4> kWheelColumns{"wheel_radius_m", "wheel_width_m",
                                                        "lug_height_m", "lug_count"};

/// One number that holds for all runs; nothing where the column is not given.
std::optional<double> one_for_all(const RecordingFile& read, std::string_view column,
                                  const ValueRange& allowed) {
  const auto found = std::ranges::find(read.columns, column);
  if (found == read.columns.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(found - read.columns.begin());
  const auto refuse = [&](std::size_t row, std::string_view what) {
    const std::string& cell = read.cells[row][index];
    return InputError(fmt::format("{}:{}: {}: {} is not valid (allowed: {})", read.file,
                                  read.lines[row], column, cell.empty() ? "an empty cell" : cell,
                                  what));
  };
  for (std::size_t row = 0; row < read.cells.size(); ++row) {
    if (read.cells[row][index] != read.cells[0][index]) throw refuse(row, "one value in all rows");
  }
  if (read.cells.empty() || read.cells[0][index].empty()) return std::nullopt;
  const std::optional<double> value = parse_number(read.cells[0][index]);
  if (!value || !allowed.contains(*value)) throw refuse(0, allowed.text());
  return value;
}

RecordedWheel recorded_wheel(const RecordingFile& read) {
  RecordedWheel wheel{.radius_m = one_for_all(read, "wheel_radius_m", kAbove0),
                      .width_m = one_for_all(read, "wheel_width_m", kAbove0),
                      .lug_height_m = one_for_all(read, "lug_height_m", of_lugs("lug_height_m"))};
  if (const auto count = one_for_all(read, "lug_count", of_lugs("lugs"))) {
    if (*count != std::floor(*count)) {
      throw InputError(fmt::format("{}: lug_count: {} is not valid (allowed: an integer from 0)",
                                   read.file, *count));
    }
    wheel.lug_count = static_cast<int>(*count);
  }
  return wheel;
}

const std::vector<std::string>& known_columns() {
  static const std::vector<std::string> kKnown = [] {
    std::vector<std::string> known(kRequired.begin(), kRequired.end());
    for (const Channel channel : kChannels) known.emplace_back(name(channel));
    for (const Circumstance& at : kCircumstances) known.emplace_back(at.column);
    known.insert(known.end(), kOtherCircumstances.begin(), kOtherCircumstances.end());
    known.insert(known.end(), kWheelColumns.begin(), kWheelColumns.end());
    return known;
  }();
  return kKnown;
}

/// Whether an optional column says something of every run; one that says nothing of any counts as
/// not given.
bool is_recorded(const RecordingFile& read, std::string_view column) {
  const auto found = std::ranges::find(read.columns, column);
  if (found == read.columns.end()) return false;
  const auto index = static_cast<std::size_t>(found - read.columns.begin());
  const auto is_empty = [index](const Cells& cells) { return cells[index].empty(); };
  const auto empty = std::ranges::find_if(read.cells, is_empty);
  if (empty == read.cells.end()) return true;
  if (std::ranges::all_of(read.cells, is_empty)) return false;
  throw InputError(fmt::format(
      "{}:{}: {}: an empty cell is not valid (allowed: a value in every row, or in none)",
      read.file, read.lines[static_cast<std::size_t>(empty - read.cells.begin())], column));
}

/// Different runs of one name, and one replicate of it, which notes and residuals could not tell
/// apart; empty: none.
std::string names_of_several_runs(const RecordingFile& read) {
  std::map<std::pair<std::string_view, std::optional<int>>, std::vector<std::int64_t>> lines_of;
  for (std::size_t i = 0; i < read.recording.runs.size(); ++i) {
    const WheelRun& run = read.recording.runs[i];
    lines_of[{run.run_id, run.replicate}].push_back(read.lines[i]);
  }
  std::erase_if(lines_of, [](const auto& run) { return run.second.size() == 1; });
  if (lines_of.empty()) return "";
  const auto& [run, lines] = *lines_of.begin();
  return fmt::format(
      "{}: run_id: {} on lines {} and {} are different runs{}; what is told of one may be of "
      "another",
      read.file, run.first, lines[0], lines[1],
      lines_of.size() == 1 ? "" : fmt::format(", and so of {} more", lines_of.size() - 1));
}

/// A sensor errs now and then; what is wrong throughout has another reason, such as a unit.
void refuse_where_too_many_are_left_out(const RecordingFile& read) {
  constexpr std::size_t kOneIn = 20;
  const std::size_t rows = read.recording.runs.size() + read.left_out.size();
  if (kOneIn * read.left_out.size() <= rows) return;
  throw InputError(fmt::format("{}; {} of {} rows are out of range (up to {} % are left out)",
                               read.left_out.front().why, read.left_out.size(), rows,
                               100 / kOneIn));
}

}  // namespace

RecordingFile read_recording(std::istream& stream, const std::string& file) {
  CsvTable table(stream, file);
  if (!table.find_column("run_id") && table.find_column("x_m")) {
    throw table.error(
        "column run_id is missing; a drive, which has x_m, is diagnosed with --scenario "
        "SCENARIO.yaml");
  }
  for (const std::string_view column : kRequired) table.required_column(column, known_columns());
  if (std::ranges::none_of(kChannels,
                           [&](Channel c) { return table.find_column(name(c)).has_value(); })) {
    throw table.error(
        "no measured column (at least one of fx_n, fy_n, torque_nm, sinkage_m, rut_left_m, "
        "rut_right_m)");
  }
  RecordingFile read{.file = file, .columns = table.columns()};
  Recording& recording = read.recording;
  std::map<Cells, std::int64_t> line_of;
  while (std::optional<Cells> cells = table.next()) {
    const auto [copied, is_new] = line_of.try_emplace(*cells, table.line());
    if (!is_new) {
      throw table.error(
          fmt::format("run_id: {}: this row is a copy of line {} (allowed: each run "
                      "once; a copy is no replicate)",
                      (*cells)[table.column("run_id")], copied->second));
    }
    try {
      recording.runs.push_back(read_run(table, *cells));
    } catch (const OutOfRangeError& bad) {
      read.left_out.push_back(
          {.run_id = (*cells)[table.column("run_id")], .cell = bad.cell(), .why = bad.what()});
      continue;
    }
    read.cells.push_back(std::move(*cells));
    read.lines.push_back(table.line());
  }
  refuse_where_too_many_are_left_out(read);
  if (recording.runs.empty()) throw InputError(file + ": no runs below the header");

  read.wheel = recorded_wheel(read);
  for (const Circumstance& at : kCircumstances) {
    recording.columns.*at.recorded = is_recorded(read, at.column);
  }
  recording.columns.day = is_recorded(read, "day");
  recording.columns.pass = is_recorded(read, "pass");
  recording.columns.wheel = is_recorded(read, "wheel");
  for (const Channel channel : kChannels) {
    if (std::ranges::any_of(recording.runs, [channel](const WheelRun& run) {
          return !std::isnan(run.value(channel));
        })) {
      recording.channels.push_back(channel);
    }
  }
  if (recording.channels.empty()) throw InputError(file + ": no channel is measured in any run");
  std::ranges::copy_if(read.columns, std::back_inserter(recording.ignored),
                       [](const std::string& column) {
                         return std::ranges::find(known_columns(), column) == known_columns().end();
                       });
  if (auto copies = leave_out_copies(read)) recording.warnings.push_back(std::move(*copies));
  if (std::string several = names_of_several_runs(read); !several.empty()) {
    recording.warnings.push_back(std::move(several));
  }
  return read;
}

std::vector<std::string> ignored_columns(const RecordingFile& read) {
  std::vector<std::string> told;
  for (const std::string& column : read.recording.ignored) {
    const auto meant = meant_column(column, read.columns, known_columns());
    told.push_back(meant ? fmt::format("{} (did you mean {}?)", column, *meant) : column);
  }
  return told;
}

RecordingFile read_recording(const std::string& file) {
  if (!std::filesystem::exists(file)) throw InputError(file + ": no such file");
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) throw InputError(file + ": cannot be read");
  return read_recording(stream, file);
}

DiagnosisSetup setup_with(DiagnosisSetup setup, const RecordedWheel& wheel) {
  setup.wheel.radius_m = wheel.radius_m.value_or(setup.wheel.radius_m);
  setup.wheel.width_m = wheel.width_m.value_or(setup.wheel.width_m);
  if (wheel.lug_height_m) setup.lug_height_m = wheel.lug_height_m;
  if (wheel.lug_count) setup.lug_count = wheel.lug_count;
  return setup;
}

}  // namespace regoplan
