#pragma once

#include <pybind11/numpy.h>

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "python/physics/number_reader.h"
#include "terramech/basics/value_range.h"

namespace regoplan::python {

/// What stands in a column of results where a row has no answer.
inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Columns of numbers that are read row by row: the arguments of a function over arrays.
class Columns {
 public:
  struct Column {
    NamedArray argument;
    ValueRange allowed;
  };

  explicit Columns(std::vector<Column> columns);

  const Shape& shape() const { return shape_; }
  std::size_t rows() const { return rows_of(shape_); }

  /// A block of all columns, checked; the span of column i begins at i * count.
  /// \throws ValueError naming argument, place, value and range
  void read(std::size_t first, std::size_t count, std::vector<double>& to) const;

 private:
  std::vector<Column> columns_;
  Shape shape_;
  std::vector<NumberReader> readers_;
};

/// A new array of doubles, not yet written.
pybind11::array_t<double> new_array(const Shape& shape);

}  // namespace regoplan::python
