#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regoplan {

/// A file that a scenario was read from.
struct InputFile {
  std::string key;              ///< `scenario`, `map.elevation`, `vehicle`, `model`
  std::filesystem::path shown;  ///< as it was written, variables not expanded
  std::string digest;           ///< of its bytes, hexadecimal; empty where it is no plain file
};

/// \param path where it lies
InputFile input_file(const std::string& key, const std::filesystem::path& path,
                     const std::filesystem::path& shown);

}  // namespace regoplan
