#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regoplan {

/// A file that exists in memory only.
struct RenderedFile {
  std::string name;
  std::string content;
};

/// Files on their way into a folder: written to a hidden folder inside it, moved to their names by
/// `commit()`, and gone without a trace where that is never reached. So there are whole files or
/// none.
class StagedFiles {
 public:
  /// Makes the folder where it is missing.
  /// \throws InputError where it cannot be made or written to
  explicit StagedFiles(const std::filesystem::path& folder);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Where to write the file that shall be called `name`.
  std::string path(const std::string& name);

  /// \throws InputError where the file cannot be written
  void write(const RenderedFile& file);

  /// \throws InputError where a file cannot be moved to its name
  void commit();

 private:
  std::filesystem::path folder_;
  std::filesystem::path staging_;
  std::filesystem::path made_;  ///< the topmost folder that was missing, empty where none was
  std::vector<std::string> names_;
};

/// \throws InputError where `folder` could never take files: it, or what it would stand in, is no
/// folder or not writable. Asked before long work.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace regoplan
