#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace regoplan {

/// Bytes as base64 (RFC 4648, padded).
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace regoplan
