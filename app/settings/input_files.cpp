#include "app/settings/input_files.h"

#include <fmt/format.h>

#include <fstream>

#include "app/io/content_digest.h"

namespace regoplan {
namespace {

std::string hexadecimal(const ContentDigest& digest) {
  return fmt::format("{:016x}", digest.value());
}

/// Empty where it is no plain file.
std::string digest_of_bytes(const std::filesystem::path& path) {
  std::error_code none;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, none) || !stream) return {};
  ContentDigest digest;
  std::vector<char> block(1 << 20);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
         stream.gcount() > 0) {
    digest.add(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return hexadecimal(digest);
}

}  // namespace

std::vector<InputDigest> digests_of(const std::vector<InputFile>& inputs) {
  std::vector<InputDigest> digests;
  for (const InputFile& input : inputs) {
    digests.push_back(
        {.key = input.key, .shown = input.shown, .digest = digest_of_bytes(input.path)});
  }
  return digests;
}

std::string joint_digest(const std::vector<InputDigest>& inputs) {
  ContentDigest joint;
  for (const InputDigest& input : inputs) {
    const std::string line = fmt::format("{}: {}\n", input.key, input.digest);
    joint.add(line.data(), line.size());
  }
  return hexadecimal(joint);
}

}  // namespace regoplan
