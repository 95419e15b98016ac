#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace regoplan {

/// Where real measurements and maps lie, which are no part of this tree: REGOPLAN_DATA, else a
/// folder beside the source.
inline std::filesystem::path measured_data() {
  const char* folder = std::getenv("REGOPLAN_DATA");
  return std::filesystem::absolute(folder ? folder : "../shared/data");
}

/// Why a test that reads a file or folder of them is skipped; nothing where it is there.
inline std::optional<std::string> absence_of(const std::filesystem::path& needed) {
  if (std::filesystem::exists(needed)) return std::nullopt;
  return needed.lexically_normal().string() +
         " is absent (measured data are not part of the source; REGOPLAN_DATA names their folder)";
}

}  // namespace regoplan
