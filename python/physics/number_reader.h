#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace regoplan::python {

using Shape = std::vector<pybind11::ssize_t>;

/// An argument with its name, for errors.
struct NamedArray {
  std::string name;
  pybind11::array array;
};

/// The shape that the arrays broadcast to, by numpy's rules.
/// \throws InputError naming the arguments and their shapes where they do not
Shape common_shape(std::span<const NamedArray> arrays);

/// How many rows a shape has: 1 for a scalar, 0 where any length is 0.
std::size_t rows_of(const Shape& shape);

/// Where a row stands: `[3, 5]`; nothing for a scalar.
std::string place_of(std::size_t row, const Shape& shape);

/// The numbers of an array as loops over rows read them, broadcast to a shape, whatever their
/// strides, type and byte order. Copies nothing and needs no lock: the array must outlive it.
class NumberReader {
 public:
  /// \throws InputError where the type is not one of real numbers of at most 64 bits
  NumberReader(const NamedArray& argument, const Shape& shape);

  /// The numbers of rows `first` to `first + to.size()`, counted in C order.
  void read(std::size_t first, std::span<double> to) const;

 private:
  using Copy = void (*)(const char* from, std::ptrdiff_t stride, std::span<double> to);
  static Copy copy_of(const NamedArray& argument);

  Copy copy_;
  const char* data_;
  std::vector<std::size_t> lengths_;     ///< of the shape
  std::vector<std::ptrdiff_t> strides_;  ///< in bytes, 0 where broadcast
  std::size_t run_ = 1;                  ///< rows of one constant stride
  std::ptrdiff_t run_stride_ = 0;        ///< within them
  std::size_t outer_axes_ = 0;           ///< axes before those that make a run
};

}  // namespace regoplan::python
