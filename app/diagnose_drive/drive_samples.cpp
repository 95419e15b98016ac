#include "app/diagnose_drive/drive_samples.h"

#include <cmath>
#include <limits>

namespace regoplan {
namespace {

double merged(double a, double b, bool mean, bool first) {
  if (std::isnan(a)) return b;
  if (std::isnan(b) || first) return a;
  return mean ? (a + b) / 2 : b;
}

template <class Number>
void halve_values(std::vector<Number>& values, bool mean, bool first) {
  const std::size_t half = values.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    values[i] = static_cast<Number>(merged(static_cast<double>(values[2 * i]),
                                           static_cast<double>(values[2 * i + 1]), mean, first));
  }
  values.resize(half);
}

}  // namespace

DriveSamples::DriveSamples(std::vector<std::string> names, std::size_t samples_max)
    : samples_max_(samples_max) {
  for (std::string& name : names) {
    Column column{.name = std::move(name)};
    const std::string& n = column.name;
    column.is_precise = n == "time_s" || n == "x_m" || n == "y_m";
    if (n == "time_s") column.merge = Merge::kFirst;
    if (n == "x_m" || n == "y_m" || n == "yaw_rad" || n == "course_rad") {
      column.merge = Merge::kLast;  // mean headings have no meaning across the half turn
    }
    columns_.push_back(std::move(column));
  }
}

void DriveSamples::add(const std::vector<double>& values) {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Column& column = columns_[i];
    if (std::isnan(values[i])) continue;
    if (column.merge == Merge::kFirst && column.count > 0) continue;
    column.sum += values[i];
    column.last = values[i];
    ++column.count;
  }
  if (++pending_ == rows_per_sample_) flush();
}

void DriveSamples::flush() {
  pending_ = 0;
  for (Column& column : columns_) {
    double value = kNotSampled;
    if (column.count > 0) {
      value = column.merge == Merge::kMean ? column.sum / column.count : column.last;
    }
    if (column.is_precise) {
      column.precise.push_back(value);
    } else {
      column.values.push_back(static_cast<float>(value));
    }
    column.sum = 0;
    column.count = 0;
  }
  if (++size_ == samples_max_) halve();
}

void DriveSamples::halve() {
  for (Column& column : columns_) {
    const bool mean = column.merge == Merge::kMean, first = column.merge == Merge::kFirst;
    halve_values(column.precise, mean, first);
    halve_values(column.values, mean, first);
  }
  size_ /= 2;
  rows_per_sample_ *= 2;
}

void DriveSamples::give(DriveRecording& drive) {
  if (pending_ > 0) flush();
  drive.rows_per_sample = rows_per_sample_;
  for (Column& column : columns_) {
    if (column.name == "time_s") {
      drive.time_s = std::move(column.precise);
    } else if (column.name == "x_m") {
      drive.x_m = std::move(column.precise);
    } else if (column.name == "y_m") {
      drive.y_m = std::move(column.precise);
    } else {
      bool any = false;
      for (const float value : column.values) any = any || !std::isnan(value);
      if (any) drive.channels.push_back({std::move(column.name), std::move(column.values)});
    }
  }
}

}  // namespace regoplan
