#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace regoplan {

/// Tells one content from another (FNV-1a of 64 bits): against chance, not against intent.
class ContentDigest {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ULL;
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    if (!values.empty()) add(values.data(), values.size() * sizeof(Value));
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace regoplan
