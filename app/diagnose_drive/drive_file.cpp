#include "app/diagnose_drive/drive_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "app/diagnose_drive/drive_samples.h"
#include "drive_diagnosis/recording/time_checks.h"
#include "terramech/basics/input_error.h"
#include "terramech/tables/csv_table.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

/// A column of the file on its way to a channel.
struct BoundColumn {
  std::string shown;  ///< as the file calls it
  KnownDriveColumn known;
  std::size_t cell = 0;
  double scale = 1, offset = 0;
  std::optional<std::size_t> fresh;
};

/// What was wrong with cells of one kind.
struct Trouble {
  std::int64_t count = 0;
  std::string first;
};

class DriveReader {
 public:
  DriveReader(std::istream& stream, const std::string& file, const DriveColumnMap& map)
      : table_(stream, file), file_(file), map_(map) {
    drive_.file = file;
    drive_.drive_id = std::filesystem::path(file).stem().string();
    bind();
  }

  DriveRecording read();

 private:
  void bind();
  void bind_column(const DriveColumnSource& source);
  void bind_quaternion();
  void read_row(const CsvTable::Cells& cells);
  double cell_value(const CsvTable::Cells& cells, const BoundColumn& column);
  void add_attitude(const CsvTable::Cells& cells, std::vector<double>& values);
  void note(const std::string& kind, const std::string& what);
  void tell_troubles();
  void name_the_drive();

  CsvTable table_;
  std::string file_;
  const DriveColumnMap& map_;
  DriveRecording drive_;
  std::vector<BoundColumn> columns_;
  std::array<std::size_t, 4> quaternion_{};
  std::set<std::size_t> used_;
  std::optional<std::size_t> id_cell_, day_cell_;
  std::string first_id_;
  std::map<std::string, Trouble> troubles_;
  std::optional<DriveSamples> samples_;
  std::int64_t rows_left_out_ = 0;
};

void DriveReader::bind_column(const DriveColumnSource& source) {
  const std::size_t cell = table_.column(source.column);
  used_.insert(cell);
  BoundColumn bound{.shown = source.column,
                    .known = known_drive_column(source.name).value_or(KnownDriveColumn{}),
                    .cell = cell,
                    .scale = source.scale,
                    .offset = source.offset,
                    .fresh = {}};
  if (source.fresh) {
    bound.fresh = table_.column(*source.fresh);
    used_.insert(*bound.fresh);
  }
  const auto twice = std::ranges::find_if(columns_, [&](const BoundColumn& other) {
    return other.known.channel == bound.known.channel;
  });
  if (twice != columns_.end()) {
    throw table_.error(
        fmt::format("columns {} and {} give the same quantity", twice->shown, bound.shown));
  }
  columns_.push_back(std::move(bound));
}

void DriveReader::bind() {
  std::set<std::string> mapped;
  for (const DriveColumnSource& source : map_.sources) {
    mapped.insert(source.name);
    if (source.name == "drive_id" || source.name == "day") {
      (source.name == "day" ? day_cell_ : id_cell_) = table_.column(source.column);
      used_.insert(table_.column(source.column));
    } else {
      bind_column(source);
    }
  }
  for (std::size_t i = 0; i < table_.columns().size(); ++i) {
    const std::string& name = table_.columns()[i];
    if (used_.contains(i) || mapped.contains(name)) continue;
    if (known_drive_column(name)) {
      bind_column({.name = name, .column = name, .fresh = {}});
    } else if (name == "day") {
      day_cell_ = i;
      used_.insert(i);
    } else if (name == "drive_id") {
      id_cell_ = i;
      used_.insert(i);
    }
  }
  for (const char* needed : {"time_s", "x_m", "y_m"}) {
    if (std::ranges::none_of(columns_,
                             [&](const BoundColumn& c) { return c.known.channel == needed; })) {
      throw table_.error(
          fmt::format("column {} is missing (a log with other names: --columns MAP.yaml)", needed));
    }
  }
  if (map_.quaternion) bind_quaternion();
  for (std::size_t i = 0; i < table_.columns().size(); ++i) {
    if (!used_.contains(i)) drive_.ignored.push_back(table_.columns()[i]);
  }
  std::vector<std::string> names;
  for (const BoundColumn& column : columns_) names.push_back(column.known.channel);
  if (map_.quaternion) names.insert(names.end(), {"yaw_rad", "pitch_rad", "roll_rad"});
  samples_.emplace(names, kDriveSamplesMax);
}

void DriveReader::bind_quaternion() {
  for (std::size_t i = 0; i < 4; ++i) {
    quaternion_.at(i) = table_.column(map_.quaternion->at(i));
    used_.insert(quaternion_.at(i));
  }
  std::erase_if(columns_, [](const BoundColumn& column) {
    const std::string& name = column.known.channel;
    return name == "yaw_rad" || name == "pitch_rad" || name == "roll_rad";
  });
}

void DriveReader::note(const std::string& kind, const std::string& what) {
  Trouble& trouble = troubles_[kind];
  if (trouble.count++ == 0) trouble.first = what;
}

double DriveReader::cell_value(const CsvTable::Cells& cells, const BoundColumn& column) {
  const std::string& cell = cells[column.cell];
  if (cell.empty()) return kNotSampled;
  if (column.fresh && parse_number(cells[*column.fresh]).value_or(1) == 0) return kNotSampled;
  const std::optional<double> number = parse_number(cell);
  if (!number) {
    note("no_number", fmt::format("{}:{}: {}: {} is no number", file_, table_.line(), column.shown,
                                  cell.substr(0, 20)));
    return kNotSampled;
  }
  const double value = column.scale * *number + column.offset;
  if (!column.known.allowed.contains(value)) {
    note("out_of_range",
         fmt::format("{}:{}: {}: {} is not valid (allowed: {})", file_, table_.line(), column.shown,
                     cell.substr(0, 20), column.known.allowed.text()));
    return kNotSampled;
  }
  return value * column.known.per_unit;
}

void DriveReader::add_attitude(const CsvTable::Cells& cells, std::vector<double>& values) {
  std::array<double, 4> q{};
  for (std::size_t i = 0; i < 4; ++i)
    q.at(i) = parse_number(cells[quaternion_.at(i)]).value_or(kNotSampled);
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(std::abs(norm - 1) < 0.1)) {
    if (std::isfinite(norm)) {
      note("out_of_range", fmt::format("{}:{}: attitude_quaternion: a norm of {:.3g} is not valid "
                                       "(allowed: 0.9 to 1.1)",
                                       file_, table_.line(), norm));
    }
    values.insert(values.end(), {kNotSampled, kNotSampled, kNotSampled});
    return;
  }
  for (double& part : q) part /= norm;
  const auto [w, x, y, z] = q;
  const double forward_up = 2 * (x * z - w * y), left_up = 2 * (y * z + w * x);
  values.push_back(std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)));
  values.push_back(std::asin(std::clamp(forward_up, -1.0, 1.0)));
  values.push_back(std::asin(std::clamp(left_up, -1.0, 1.0)));
}

void DriveReader::read_row(const CsvTable::Cells& cells) {
  std::vector<double> values;
  values.reserve(columns_.size() + 3);
  bool timed = false;
  for (const BoundColumn& column : columns_) {
    values.push_back(cell_value(cells, column));
    if (column.known.channel == "time_s") timed = !std::isnan(values.back());
  }
  if (map_.quaternion) add_attitude(cells, values);
  if (!timed) {
    note("no_time", fmt::format("{}:{}: a row without time_s", file_, table_.line()));
    ++rows_left_out_;
    return;
  }
  if (id_cell_) {
    if (first_id_.empty()) first_id_ = cells[*id_cell_];
    if (cells[*id_cell_] != first_id_) {
      throw table_.error(fmt::format("drive_id {} after {} (allowed: one drive a file)",
                                     cells[*id_cell_], first_id_));
    }
  }
  if (day_cell_ && drive_.day.empty()) drive_.day = cells[*day_cell_];
  samples_->add(values);
}

void DriveReader::tell_troubles() {
  static const std::map<std::string, std::string> kWords{
      {"no_number", "cells that are no number count as not sampled"},
      {"out_of_range", "cells out of range count as not sampled"},
      {"no_time", "rows without a time are left out"},
      {"torn_row", "rows with another number of cells or with zero bytes are left out"}};
  for (const auto& [kind, trouble] : troubles_) {
    drive_.findings.push_back(
        {.id = kind,
         .drive = drive_.drive_id,
         .text = fmt::format("{} {} (first: {})", trouble.count, kWords.at(kind), trouble.first),
         .value = static_cast<double>(trouble.count),
         .mended = true});
  }
}

/// Whoever names no day often has it in the name of the file.
std::string day_in(const std::string& name) {
  const auto digits = [&](std::size_t from, std::size_t count) {
    return name.size() >= from + count &&
           std::all_of(name.begin() + static_cast<std::ptrdiff_t>(from),
                       name.begin() + static_cast<std::ptrdiff_t>(from + count),
                       [](char letter) { return letter >= '0' && letter <= '9'; });
  };
  if (!digits(0, 4) || name.size() < 7 || name[4] != '-' || !digits(5, 2)) return "";
  const bool whole = name.size() >= 10 && name[7] == '-' && digits(8, 2);
  return name.substr(0, whole ? 10 : 7);
}

void DriveReader::name_the_drive() {
  if (!first_id_.empty()) drive_.drive_id = first_id_;
  if (drive_.day.empty()) drive_.day = day_in(drive_.drive_id);
}

DriveRecording DriveReader::read() {
  while (true) {
    try {
      const std::optional<CsvTable::Cells> cells = table_.next();
      if (!cells) break;
      ++drive_.rows_read;
      read_row(*cells);
    } catch (const TornRowError& bad) {
      ++drive_.rows_read;
      ++rows_left_out_;
      note("torn_row", bad.what());
    }
  }
  name_the_drive();
  if (drive_.rows_read == 0) throw InputError(file_ + ": no rows below the header");
  constexpr std::int64_t kOneIn = 20;
  if (kOneIn * rows_left_out_ > drive_.rows_read && rows_left_out_ > 1) {
    throw InputError(fmt::format("{}; {} of {} rows cannot be used (up to {} % are left out)",
                                 troubles_.begin()->second.first, rows_left_out_, drive_.rows_read,
                                 100 / kOneIn));
  }
  tell_troubles();
  samples_->give(drive_);
  if (drive_.rows_per_sample > 1) {
    drive_.findings.push_back({.id = "averaged",
                               .drive = drive_.drive_id,
                               .text = fmt::format("{} rows: every {} are averaged into one",
                                                   drive_.rows_read, drive_.rows_per_sample),
                               .value = drive_.rows_per_sample,
                               .mended = true});
  }
  mend_time(drive_);
  return std::move(drive_);
}

}  // namespace

DriveRecording read_drive(std::istream& stream, const std::string& file,
                          const DriveColumnMap& map) {
  return DriveReader(stream, file, map).read();
}

DriveRecording read_drive(const std::string& file, const DriveColumnMap& map) {
  if (!std::filesystem::exists(file)) throw InputError(file + ": no such file");
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) throw InputError(file + ": cannot be read");
  return read_drive(stream, file, map);
}

}  // namespace regoplan
