#include "app/io/printable_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace regoplan {
namespace {

constexpr std::size_t kLengthMax = 1000, kKeptAtTheEnd = 300;

/// How many bytes the UTF-8 character at the front has; 0 where there is none.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xc2 ? 0
                           : first < 0xe0 ? 2
                           : first < 0xf0 ? 3
                           : first < 0xf5 ? 4
                                          : 0;
  if (size == 0 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  return size;
}

std::uint32_t code_point(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return byte(0);
  std::uint32_t code = byte(0) & (0x7fU >> character.size());
  for (std::size_t i = 1; i < character.size(); ++i) code = (code << 6U) | (byte(i) & 0x3fU);
  return code;
}

/// Whether a terminal would obey it instead of showing it.
bool commands(std::uint32_t code) {
  const auto within = [code](std::uint32_t low, std::uint32_t high) {
    return code >= low && code <= high;
  };
  return code < 0x20 || within(0x7f, 0x9f) || within(0x200b, 0x200f) || within(0x2028, 0x202e) ||
         within(0x2066, 0x2069) || within(0xd800, 0xdfff) || code == 0xfeff;
}

/// The largest size up to `size` at which no character is cut.
std::size_t whole_characters(std::string_view text, std::size_t size) {
  while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80) --size;
  return size;
}

}  // namespace

std::string printable(std::string_view text) {
  // What is cut out need not be escaped first.
  std::string shown;
  const std::size_t whole = text.size();
  if (whole > kLengthMax) {
    const std::size_t head = whole_characters(text, kLengthMax - kKeptAtTheEnd);
    const std::size_t tail = whole_characters(text, whole - kKeptAtTheEnd);
    return printable(text.substr(0, head)) + fmt::format(" [... {} bytes ...] ", tail - head) +
           printable(text.substr(tail));
  }
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(size, 1));
    if (character == "\n") {
      shown += ' ';
    } else if (size == 0 || commands(code_point(character))) {
      for (const char byte : character) {
        shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
      }
    } else {
      shown += character;
    }
    text.remove_prefix(character.size());
  }
  return shown;
}

std::string quotable(std::string_view text) {
  constexpr std::size_t kQuotedMax = 40;
  if (text.size() <= kQuotedMax) return std::string(text);
  return fmt::format("{}...", text.substr(0, whole_characters(text, kQuotedMax)));
}

}  // namespace regoplan
