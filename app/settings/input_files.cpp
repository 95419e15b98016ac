#include "app/settings/input_files.h"

#include <fmt/format.h>

#include <fstream>

#include "app/io/content_digest.h"

namespace regoplan {

InputFile input_file(const std::string& key, const std::filesystem::path& path,
                     const std::filesystem::path& shown) {
  InputFile input{.key = key, .shown = shown, .digest = {}};
  std::error_code none;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, none) || !stream) return input;
  ContentDigest digest;
  std::vector<char> block(1 << 20);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
         stream.gcount() > 0) {
    digest.add(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  input.digest = fmt::format("{:016x}", digest.value());
  return input;
}

}  // namespace regoplan
