#include "python/physics/columns.h"

#include <algorithm>

#include "terramech/basics/input_error.h"

namespace regoplan::python {

Columns::Columns(std::vector<Column> columns) : columns_(std::move(columns)) {
  std::vector<NamedArray> arguments;
  for (const Column& column : columns_) arguments.push_back(column.argument);
  shape_ = common_shape(arguments);
  for (const NamedArray& argument : arguments) readers_.emplace_back(argument, shape_);
}

void Columns::read(std::size_t first, std::size_t count, std::vector<double>& to) const {
  to.resize(columns_.size() * count);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::span<double> values = std::span(to).subspan(i * count, count);
    readers_[i].read(first, values);
    const ValueRange& allowed = columns_[i].allowed;
    const auto bad = std::ranges::find_if_not(
        values, [&allowed](double value) { return allowed.contains(value); });
    if (bad == values.end()) continue;
    const std::size_t row = first + static_cast<std::size_t>(bad - values.begin());
    throw ValueError(columns_[i].argument.name + place_of(row, shape_), *bad, allowed.text());
  }
}

pybind11::array_t<double> new_array(const Shape& shape) {
  return pybind11::array_t<double>(shape);
}

}  // namespace regoplan::python
