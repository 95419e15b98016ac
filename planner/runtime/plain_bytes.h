#pragma once

#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace regoplan {

/// Writes values as bytes for another process of the same program: plain ones as they lie in
/// memory, strings, vectors and optionals with their size before them.
class ByteWriter {
 public:
  template <class Value>
  void operator()(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    append(&value, sizeof(Value));
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    append(text.data(), text.size());
  }
  template <class Value>
  void operator()(const std::vector<Value>& values) {
    (*this)(values.size());
    for (const Value& value : values) (*this)(value);
  }
  template <class Value>
  void operator()(const std::optional<Value>& value) {
    (*this)(value.has_value());
    if (value) (*this)(*value);
  }

  std::vector<char> take() { return std::move(bytes_); }

 private:
  void append(const void* data, std::size_t size) {
    const auto* first = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }

  std::vector<char> bytes_;
};

/// Reads what a `ByteWriter` wrote, in the same order. \throws std::length_error where the bytes
/// end too early
class ByteReader {
 public:
  /// \param bytes must outlive it
  explicit ByteReader(const std::vector<char>& bytes) : bytes_(bytes) {}

  template <class Value>
  void operator()(Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::memcpy(&value, next(sizeof(Value)), sizeof(Value));
  }
  void operator()(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    text.assign(next(size), size);
  }
  template <class Value>
  void operator()(std::vector<Value>& values) {
    std::size_t size = 0;
    (*this)(size);
    if (size > bytes_.size() - at_) throw std::length_error("bytes cut short");
    values.resize(size);
    for (Value& value : values) (*this)(value);
  }
  template <class Value>
  void operator()(std::optional<Value>& value) {
    bool there = false;
    (*this)(there);
    if (there) (*this)(value.emplace());
  }

 private:
  const char* next(std::size_t size) {
    if (size > bytes_.size() - at_) throw std::length_error("bytes cut short");
    const char* here = bytes_.data() + at_;
    at_ += size;
    return here;
  }

  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
};

/// A value that is read or written field by field.
template <class Value, class Of>
concept FieldsOf = std::is_same_v<std::remove_const_t<Value>, Of>;

/// A value of a type with `each_field(archive, value)`, which hands every field of it to the
/// archive: one list of fields for both directions.
template <class Value>
std::vector<char> bytes_of(const Value& value) {
  ByteWriter writer;
  each_field(writer, value);
  return writer.take();
}

/// \returns nothing where the bytes end too early: the process that wrote them died on the way
template <class Value>
std::optional<Value> from_bytes(const std::vector<char>& bytes) {
  try {
    Value value;
    ByteReader reader(bytes);
    each_field(reader, value);
    return value;
  } catch (const std::length_error&) {
    return std::nullopt;
  }
}

}  // namespace regoplan
