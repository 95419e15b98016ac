#include "app/io/page_command.h"

#include <fmt/format.h>

#include <fstream>

namespace regoplan {
namespace {

constexpr std::string_view kMark = "<meta name=\"generator\" content=\"regoplan ";

}  // namespace

std::string page_mark(std::string_view command) {
  return fmt::format("{}{}\">", kMark, command);
}

std::string page_command(const std::filesystem::path& page) {
  std::ifstream stream(page, std::ios::binary);
  std::string head(1000, '\0');  // the mark is among a page's first lines
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  const std::size_t mark = head.find(kMark);
  if (mark == std::string::npos) return "";
  const std::size_t begin = mark + kMark.size();
  const std::size_t end = head.find_first_not_of("abcdefghijklmnopqrstuvwxyz", begin);
  return end == std::string::npos ? "" : head.substr(begin, end - begin);
}

std::string kept_page_name(const std::string& command, const std::string& page) {
  return fmt::format("{}-{}", command, page);
}

}  // namespace regoplan
