#include "python/physics/number_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "terramech/basics/input_error.h"

namespace regoplan::python {
namespace {

std::string shape_text(const pybind11::array& array) {
  std::string text = "(";
  for (pybind11::ssize_t i = 0; i < array.ndim(); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", array.shape(i));
  }
  return text + (array.ndim() == 1 ? ",)" : ")");
}

template <class Number, bool kSwapped>
void copy_as(const char* from, std::ptrdiff_t stride, std::span<double> to) {
  for (double& value : to) {
    Number number;
    std::memcpy(&number, from, sizeof number);
    if constexpr (kSwapped) {
      auto* bytes = reinterpret_cast<unsigned char*>(&number);
      std::reverse(bytes, bytes + sizeof number);
    }
    value = static_cast<double>(number);
    from += stride;
  }
}

}  // namespace

Shape common_shape(std::span<const NamedArray> arrays) {
  Shape shape;
  for (const NamedArray& argument : arrays) {
    const auto axes = static_cast<std::size_t>(argument.array.ndim());
    if (axes > shape.size()) shape.insert(shape.begin(), axes - shape.size(), 1);
    for (std::size_t i = 0; i < axes; ++i) {
      auto& length = shape[shape.size() - axes + i];
      const auto own = argument.array.shape(static_cast<pybind11::ssize_t>(i));
      if (own == length || own == 1) continue;
      if (length != 1) {
        std::string shapes;
        for (const NamedArray& each : arrays) {
          shapes +=
              fmt::format("{}{} {}", shapes.empty() ? "" : ", ", each.name, shape_text(each.array));
        }
        throw InputError(fmt::format("{}: shape does not broadcast with the others ({})",
                                     argument.name, shapes));
      }
      length = own;
    }
  }
  return shape;
}

std::size_t rows_of(const Shape& shape) {
  std::size_t rows = 1;
  for (const auto length : shape) rows *= static_cast<std::size_t>(length);
  return rows;
}

std::string place_of(std::size_t row, const Shape& shape) {
  std::string text;
  for (auto length = shape.rbegin(); length != shape.rend(); ++length) {
    const auto of = static_cast<std::size_t>(*length);
    text = fmt::format("{}{}{}", row % of, text.empty() ? "" : ", ", text);
    row /= of;
  }
  return text.empty() ? text : "[" + text + "]";
}

NumberReader::Copy NumberReader::copy_of(const NamedArray& argument) {
  const pybind11::dtype type = argument.array.dtype();
  const char order = type.attr("byteorder").cast<std::string>().front();
  const bool swapped = order == (std::endian::native == std::endian::little ? '>' : '<');
  const auto pick = [swapped](auto number) -> Copy {
    using Number = decltype(number);
    return swapped ? copy_as<Number, true> : copy_as<Number, false>;
  };
  switch (type.kind()) {
    case 'f':
      if (type.itemsize() == 8) return pick(double{});
      if (type.itemsize() == 4) return pick(float{});
      break;
    case 'i':
      if (type.itemsize() == 8) return pick(std::int64_t{});
      if (type.itemsize() == 4) return pick(std::int32_t{});
      if (type.itemsize() == 2) return pick(std::int16_t{});
      if (type.itemsize() == 1) return pick(std::int8_t{});
      break;
    case 'u':
      if (type.itemsize() == 8) return pick(std::uint64_t{});
      if (type.itemsize() == 4) return pick(std::uint32_t{});
      if (type.itemsize() == 2) return pick(std::uint16_t{});
      if (type.itemsize() == 1) return pick(std::uint8_t{});
      break;
    default:
      break;
  }
  throw InputError(
      fmt::format("{}: dtype {} is not valid (allowed: float32, float64, integers)", argument.name,
                  pybind11::str(static_cast<pybind11::object>(type)).cast<std::string>()));
}

NumberReader::NumberReader(const NamedArray& argument, const Shape& shape)
    : copy_(copy_of(argument)), data_(static_cast<const char*>(argument.array.data())) {
  const auto own_axes = static_cast<std::size_t>(argument.array.ndim());
  const std::size_t missing = shape.size() - own_axes;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    lengths_.push_back(static_cast<std::size_t>(shape[i]));
    const auto axis = static_cast<pybind11::ssize_t>(i) - static_cast<pybind11::ssize_t>(missing);
    const bool broadcast = axis < 0 || argument.array.shape(axis) == 1;
    strides_.push_back(broadcast ? 0 : argument.array.strides(axis));
  }
  // From the last axis inward: as long as one step more of an axis goes on where the last ended,
  // the axes are walked as one.
  outer_axes_ = shape.size();
  while (outer_axes_ > 0) {
    const std::size_t axis = outer_axes_ - 1;
    if (run_ == 1) {
      run_stride_ = strides_[axis];
    } else if (lengths_[axis] != 1 &&
               strides_[axis] != run_stride_ * static_cast<std::ptrdiff_t>(run_)) {
      break;
    }
    run_ *= lengths_[axis];
    outer_axes_ = axis;
  }
}

void NumberReader::read(std::size_t first, std::span<double> to) const {
  std::size_t done = 0;
  while (done < to.size()) {
    const std::size_t row = first + done, within = row % run_;
    std::size_t outer = row / run_;
    std::ptrdiff_t offset = run_stride_ * static_cast<std::ptrdiff_t>(within);
    for (std::size_t axis = outer_axes_; axis-- > 0;) {
      offset += strides_[axis] * static_cast<std::ptrdiff_t>(outer % lengths_[axis]);
      outer /= lengths_[axis];
    }
    const std::size_t count = std::min(run_ - within, to.size() - done);
    copy_(data_ + offset, run_stride_, to.subspan(done, count));
    done += count;
  }
}

}  // namespace regoplan::python
