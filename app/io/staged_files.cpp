#include "app/io/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "app/io/result_manifest.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kStagingPrefix = ".regoplan-";

fs::path tidy(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();  // "a/b/" is "a/b"
}

/// The topmost of the folders towards `folder` that do not exist yet; empty where it exists.
fs::path topmost_missing(const fs::path& folder) {
  fs::path missing;
  std::error_code unknown;  // what cannot even be asked for cannot be made either
  for (fs::path at = tidy(folder); !fs::exists(at, unknown); at = at.parent_path()) {
    missing = at;
  }
  return missing;
}

/// An open folder that no other process has locked; -1 where one has, or it is gone.
int locked(const fs::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  struct stat status {};
  // Whoever swept it in between has left a folder without a name.
  if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &status) == 0 &&
      status.st_nlink > 0) {
    return file;
  }
  if (file >= 0) close(file);
  return -1;
}

bool is_staging(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with(kStagingPrefix) && name.size() > kStagingPrefix.size() &&
         name.find_first_not_of("0123456789", kStagingPrefix.size()) == std::string::npos;
}

/// Removes the hidden folders of processes that have ended: nobody holds their locks.
void sweep(const fs::path& folder) {
  std::error_code failed;
  std::vector<fs::path> left;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    if (is_staging(at->path()) && !at->is_symlink(failed)) left.push_back(at->path());
  }
  for (const fs::path& staging : left) {
    const int lock = locked(staging);
    if (lock < 0) continue;
    fs::remove_all(staging, failed);
    close(lock);
  }
}

[[noreturn]] void fail(const fs::path& file, std::string_view what) {
  throw InputError(fmt::format("{}: {}", file.string(), what));
}

[[noreturn]] void refuse(const ResultFolder& folder, const fs::path& at, std::string_view why) {
  throw InputError(fmt::format("{}: {}: {}", folder.option, at.string(), why));
}

/// Made absolute, an empty name would be the working folder.
const fs::path& non_empty(const ResultFolder& folder) {
  if (folder.path.empty())
    throw InputError(fmt::format("{}: empty, names no folder", folder.option));
  return folder.path;
}

void require_replaceable(const ResultFolder& folder, const std::vector<std::string>& names) {
  const ResultManifest manifest(folder.path);
  for (const std::string& name : names) {
    const fs::path file = folder.path / name;
    const fs::file_status there = fs::status(file);
    if (!fs::exists(there)) continue;
    if (!fs::is_regular_file(there)) fail(file, "stands in the way, no regular file");
    if (!folder.force && !manifest.is_own(name)) {
      fail(file, "was not written by regoplan, or was changed since; --force replaces it");
    }
  }
}

}  // namespace

void require_writable_folder(const ResultFolder& folder) {
  // Rights do not tell all: a disk may be full, and root may not write everywhere either.
  const StagedFiles tried(folder);
}

void require_results_fit(const ResultFolder& folder, const std::vector<std::string>& names) {
  require_writable_folder(folder);
  require_replaceable(folder, names);
}

StagedFiles::StagedFiles(const ResultFolder& folder)
    : folder_{tidy(non_empty(folder)), folder.force, folder.option},
      made_(topmost_missing(folder_.path)) {
  const fs::path existing = made_.empty() ? folder_.path : made_.parent_path();
  if (!fs::is_directory(existing)) refuse(folder_, existing, "not a folder");
  if (made_.empty()) sweep(folder_.path);
  // A folder that a killed process of the same number left may still be there, or be swept by
  // another process while it is made; so may one above it that the other made and needs no more.
  staging_ = folder_.path / fmt::format("{}{}", kStagingPrefix, getpid());
  std::error_code failed;
  for (int attempt = 0; attempt < 10 && lock_ < 0; ++attempt) {
    fs::create_directories(staging_, failed);
    if (!failed) lock_ = locked(staging_);
  }
  if (failed) {
    remove_made();
    refuse(
        folder_, folder_.path,
        fmt::format("cannot be {}: {}", made_.empty() ? "written to" : "made", failed.message()));
  }
  if (lock_ < 0) fail(staging_, "is in use by another process");
}

StagedFiles::~StagedFiles() {
  std::error_code ignored;  // nothing can be done about a leftover
  fs::remove_all(staging_, ignored);
  close(lock_);
  remove_made();
}

/// Folders that hold nothing yet go again; the system keeps those that hold something.
void StagedFiles::remove_made() const {
  if (made_.empty()) return;
  for (fs::path at = folder_.path;; at = at.parent_path()) {
    rmdir(at.c_str());
    if (at == made_) return;
  }
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
  if (!stream) fail(target, "cannot be written (disk full?)");
}

void StagedFiles::commit() {
  require_replaceable(folder_, names_);
  ResultManifest manifest(folder_.path);
  // Killed at any moment, each file is one of the two that the manifest then knows.
  for (const std::string& name : names_) manifest.add(name, staging_ / name);
  write_manifest(manifest.text());
  for (const std::string& name : names_) move(name);
  for (const std::string& name : names_) manifest.set(name, folder_.path / name);
  write_manifest(manifest.text());
}

bool StagedFiles::remove(const std::string& name) {
  ResultManifest manifest(folder_.path);
  if (!manifest.is_own(name)) return false;
  std::error_code failed;
  fs::remove(folder_.path / name, failed);
  manifest.remove(name);
  write_manifest(manifest.text());
  return true;
}

void StagedFiles::write_manifest(const std::string& text) {
  std::ofstream stream(staging_ / ResultManifest::kName, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) fail(staging_ / ResultManifest::kName, "cannot be written (disk full?)");
  move(ResultManifest::kName);
}

void StagedFiles::move(const std::string& name) const {
  std::error_code failed;
  fs::rename(staging_ / name, folder_.path / name, failed);
  if (failed) fail(folder_.path / name, failed.message());
}

}  // namespace regoplan
