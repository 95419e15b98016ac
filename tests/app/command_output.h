#pragma once

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace regoplan {

/// What a shell command writes to standard output; empty where it cannot be run.
inline std::string output_of(const std::string& command) {
  std::string text;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  if (!pipe) return text;
  std::array<char, 65536> part{};
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe.get()))
    text.append(part.data(), count);
  return text;
}

}  // namespace regoplan
