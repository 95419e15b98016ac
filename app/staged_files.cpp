#include "app/staged_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "terramech/input_error.h"

namespace regoplan {
namespace fs = std::filesystem;
namespace {

fs::path tidy(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();  // "a/b/" is "a/b"
}

/// The topmost of the folders towards `folder` that do not exist yet; empty where it exists.
fs::path topmost_missing(const fs::path& folder) {
  fs::path missing;
  for (fs::path at = tidy(folder); !fs::exists(at); at = at.parent_path()) {
    missing = at;
  }
  return missing;
}

}  // namespace

void require_writable_folder(const fs::path& folder) {
  const fs::path missing = topmost_missing(folder);
  const fs::path existing = missing.empty() ? folder : missing.parent_path();
  if (!fs::is_directory(existing)) throw InputError(existing.string() + ": not a folder");
  if (access(existing.c_str(), W_OK | X_OK) != 0) {
    throw InputError(existing.string() + ": not writable");
  }
}

StagedFiles::StagedFiles(const fs::path& folder)
    : folder_(tidy(folder)), made_(topmost_missing(folder)) {
  require_writable_folder(folder_);
  staging_ = folder_ / fmt::format(".regoplan-{}", getpid());
  std::error_code failed;
  fs::create_directories(staging_, failed);
  if (failed) throw InputError(fmt::format("{}: {}", staging_.string(), failed.message()));
}

StagedFiles::~StagedFiles() {
  std::error_code ignored;  // nothing can be done about a leftover
  fs::remove_all(staging_, ignored);
  if (made_.empty()) return;
  // Folders that hold nothing yet go again.
  for (fs::path at = folder_; fs::remove(at, ignored) && at != made_;) at = at.parent_path();
}

std::string StagedFiles::path(const std::string& name) {
  if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
  return (staging_ / name).string();
}

void StagedFiles::write(const RenderedFile& file) {
  const std::string target = path(file.name);
  std::ofstream stream(target, std::ios::binary);
  stream << file.content;
  stream.close();
  if (!stream) throw InputError(target + ": cannot be written (disk full?)");
}

void StagedFiles::commit() {
  for (const std::string& name : names_) {
    const fs::file_status there = fs::status(folder_ / name);
    if (fs::exists(there) && !fs::is_regular_file(there)) {
      throw InputError((folder_ / name).string() + ": stands in the way, no regular file");
    }
  }
  for (const std::string& name : names_) {
    std::error_code failed;
    fs::rename(staging_ / name, folder_ / name, failed);
    if (failed) {
      throw InputError(fmt::format("{}: {}", (folder_ / name).string(), failed.message()));
    }
  }
}

}  // namespace regoplan
