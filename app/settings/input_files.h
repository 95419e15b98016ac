#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regoplan {

/// A file that a scenario was read from.
struct InputFile {
  std::string key;              ///< `scenario`, `map.elevation`, `vehicle`, `model`
  std::filesystem::path path;   ///< where it lies
  std::filesystem::path shown;  ///< as it was written, variables not expanded
};

/// What an input file held.
struct InputDigest {
  std::string key;
  std::filesystem::path shown;
  std::string digest;  ///< of its bytes, hexadecimal; empty where it is no plain file
};

/// Reads each file to its end.
std::vector<InputDigest> digests_of(const std::vector<InputFile>& inputs);

/// One digest of all, by their keys and digests: the same wherever the files lie.
std::string joint_digest(const std::vector<InputDigest>& inputs);

}  // namespace regoplan
