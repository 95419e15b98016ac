#include "app/io/result_manifest.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <fstream>
#include <optional>

#include "app/io/content_digest.h"

namespace regoplan {
namespace {

/// Nothing where it cannot be read to its end.
std::optional<std::uint64_t> digest_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  ContentDigest digest;
  std::array<char, 65536> part{};
  do {
    stream.read(part.data(), part.size());
    digest.add(part.data(), static_cast<std::size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) return {};
  return digest.value();
}

}  // namespace

ResultManifest::ResultManifest(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::ifstream stream(folder_ / kName);
  for (std::string line; std::getline(stream, line);) {
    std::uint64_t digest = 0;
    constexpr std::size_t kDigits = 16, kNameAt = kDigits + 2;
    if (line.size() <= kNameAt) continue;
    const char* end = line.data() + kDigits;
    if (std::from_chars(line.data(), end, digest, 16).ptr != end) continue;
    digests_[line.substr(kNameAt)].insert(digest);
  }
}

bool ResultManifest::is_own(const std::string& name) const {
  const auto known = digests_.find(name);
  if (known == digests_.end()) return false;
  const std::optional<std::uint64_t> digest = digest_of(folder_ / name);
  return digest && known->second.contains(*digest);
}

void ResultManifest::add(const std::string& name, const std::filesystem::path& content) {
  if (const auto digest = digest_of(content)) digests_[name].insert(*digest);
}

void ResultManifest::set(const std::string& name, const std::filesystem::path& content) {
  digests_.erase(name);
  add(name, content);
}

std::string ResultManifest::text() const {
  std::string text = "# What regoplan wrote here: it replaces these while they are unchanged.\n";
  for (const auto& [name, digests] : digests_) {
    for (const std::uint64_t digest : digests) text += fmt::format("{:016x}  {}\n", digest, name);
  }
  return text;
}

}  // namespace regoplan
