#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace regoplan {

/// What regoplan has put into a folder: names and digests, kept there in `.regoplan-files`. So it
/// knows its own files from those that somebody wrote, or has edited since.
class ResultManifest {
 public:
  static constexpr const char* kName = ".regoplan-files";

  /// Reads what the folder holds; lines that are none of its own say nothing.
  explicit ResultManifest(std::filesystem::path folder);

  /// Whether the file of this name is as regoplan left it.
  bool is_own(const std::string& name) const;

  /// From now on the file may also be as `content` is.
  void add(const std::string& name, const std::filesystem::path& content);
  /// From now on the file is as `content` is, and no longer as it was.
  void set(const std::string& name, const std::filesystem::path& content);
  void remove(const std::string& name) { digests_.erase(name); }

  std::string text() const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::set<std::uint64_t>> digests_;
};

}  // namespace regoplan
