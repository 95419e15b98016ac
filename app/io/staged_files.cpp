#include "app/io/staged_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <random>
#include <system_error>

#include "app/io/page_command.h"
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

/// The folder itself, or the lowest above it that exists.
fs::path lowest_existing(const fs::path& folder) {
  fs::path at = folder;
  std::error_code unknown;  // what cannot even be asked for cannot be made either
  while (!fs::exists(at, unknown)) at = at.parent_path();
  return at;
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

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::rename(from, to, failed);
  if (failed) fail(to, failed.message());
}

/// Held while results are moved into a folder, taken away or looked at, so that of two processes
/// which end at once each finds the files and the manifest of one, not some of either.
class FolderLock {
 public:
  enum class Missing { kMake, kLeave };

  /// Holds nothing where the folder is missing and shall be left so.
  FolderLock(const fs::path& folder, Missing missing) {
    // A process whose files could not be moved takes away again what it has made.
    for (int attempt = 0; attempt < 100 && file_ < 0; ++attempt) {
      std::error_code failed;
      if (missing == Missing::kMake) fs::create_directories(folder, failed);
      if (failed) fail(folder, failed.message());
      file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      if (file_ < 0 && missing == Missing::kLeave && errno == ENOENT) return;
      if (file_ >= 0 && !(wait() && is_named())) file_ = (close(file_), -1);
    }
    if (file_ < 0) {
      fail(folder, fmt::format("cannot be locked ({})", std::generic_category().message(errno)));
    }
  }
  ~FolderLock() {
    if (file_ >= 0) close(file_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  bool is_held() const { return file_ >= 0; }

 private:
  bool wait() const {
    int failed = 0;
    do failed = flock(file_, LOCK_EX);
    while (failed != 0 && errno == EINTR);
    return failed == 0;
  }
  bool is_named() const {
    struct stat status {};
    return fstat(file_, &status) == 0 && status.st_nlink > 0;
  }

  int file_ = -1;
};

/// Digits that no other hidden folder has, whichever processes, machines and containers share a
/// folder.
std::string unused_number() {
  std::random_device chance;
  return fmt::format("{}{:010}", chance(), chance());
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

std::string other_page(const ResultFolder& folder, std::string_view command,
                       const std::string& page) {
  const std::string there = page_command(folder.path / page);
  return there == command ? "" : there;
}

void require_results_fit(const ResultFolder& folder, const std::vector<std::string>& names) {
  require_writable_folder(folder);
  const FolderLock lock(folder.path, FolderLock::Missing::kLeave);
  // In a missing folder there is nothing to replace. What another process puts there from now on
  // stands beside a manifest that would have to be read together with it, under the lock.
  if (lock.is_held()) require_replaceable(folder, names);
}

StagedFiles::StagedFiles(const ResultFolder& folder)
    : folder_{tidy(non_empty(folder)), folder.force, folder.option} {
  // A folder that is missing is made when there is something to put into it. Made here it would
  // have to be taken away again, and two processes that share it cannot tell which of them may.
  const fs::path existing = lowest_existing(folder_.path);
  if (!fs::is_directory(existing)) refuse(folder_, existing, "not a folder");
  sweep(existing);
  // What was killed before it had made the folder has left its own above it.
  if (existing == folder_.path) sweep(existing.parent_path());
  std::error_code failed;
  // Another process may sweep the hidden folder before it is locked.
  for (int attempt = 0; attempt < 100 && lock_ < 0 && !failed; ++attempt) {
    staging_ = existing / (std::string(kStagingPrefix) + unused_number());
    if (!fs::create_directory(staging_, failed)) continue;
    lock_ = locked(staging_);
    std::error_code ignored;  // whoever swept it has taken it away
    if (lock_ < 0) fs::remove(staging_, ignored);
  }
  if (lock_ >= 0) try_missing(folder_.path.lexically_relative(existing), failed);
  if (failed) {
    remove_staging();
    refuse(folder_, folder_.path,
           fmt::format("cannot be {}: {}", existing == folder_.path ? "written to" : "made",
                       failed.message()));
  }
  if (lock_ < 0) fail(staging_, "cannot be locked");
}

StagedFiles::~StagedFiles() {
  remove_staging();
}

/// Makes the missing folders inside the hidden one, to find out whether the system takes them.
void StagedFiles::try_missing(const fs::path& missing, std::error_code& failed) const {
  if (missing == ".") return;
  if (fs::is_symlink(fs::symlink_status(staging_.parent_path() / *missing.begin()))) {
    failed = std::make_error_code(std::errc::file_exists);  // a link that leads nowhere
    return;
  }
  fs::create_directories(staging_ / missing, failed);
  std::error_code ignored;  // goes with the hidden folder at the latest
  fs::remove_all(staging_ / *missing.begin(), ignored);
}

void StagedFiles::remove_staging() const {
  std::error_code ignored;  // nothing can be done about a leftover
  fs::remove_all(staging_, ignored);
  if (lock_ >= 0) close(lock_);
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
  const FolderLock lock(folder_.path, FolderLock::Missing::kMake);
  try {
    move_all();
  } catch (...) {
    // Folders that hold nothing go again; the system keeps those that hold something.
    const fs::path existing = staging_.parent_path();
    for (fs::path at = folder_.path; at != existing; at = at.parent_path()) rmdir(at.c_str());
    throw;
  }
}

void StagedFiles::move_all() {
  const std::vector<PageMove> pages = pages_of_others();
  std::vector<std::string> replaced = names_;
  for (const PageMove& page : pages) replaced.push_back(page.kept);
  require_replaceable(folder_, replaced);
  ResultManifest manifest(folder_.path);
  // Killed at any moment, each file is one of the two that the manifest then knows.
  for (const PageMove& page : pages) manifest.add(page.kept, folder_.path / page.name);
  for (const std::string& name : names_) manifest.add(name, staging_ / name);
  write_manifest(manifest.text());
  for (const PageMove& page : pages) move_file(folder_.path / page.name, folder_.path / page.kept);
  for (const std::string& name : names_) move_file(staging_ / name, folder_.path / name);
  for (const PageMove& page : pages) manifest.set(page.kept, folder_.path / page.kept);
  for (const std::string& name : names_) manifest.set(name, folder_.path / name);
  for (const std::string& name : names_) remove_kept(name, manifest);
  write_manifest(manifest.text());
}

std::vector<StagedFiles::PageMove> StagedFiles::pages_of_others() const {
  std::vector<PageMove> pages;
  for (const std::string& name : names_) {
    const std::string command = page_command(staging_ / name);
    const std::string other = command.empty() ? "" : other_page(folder_, command, name);
    if (!other.empty()) pages.push_back({.name = name, .kept = kept_page_name(other, name)});
  }
  return pages;
}

/// What was kept of a command's earlier page is out of date once its next one stands.
void StagedFiles::remove_kept(const std::string& name, ResultManifest& manifest) const {
  const std::string command = page_command(folder_.path / name);
  if (command.empty() || !manifest.is_own(kept_page_name(command, name))) return;
  std::error_code failed;  // stays in the manifest where it cannot be taken away
  fs::remove(folder_.path / kept_page_name(command, name), failed);
  if (!failed) manifest.remove(kept_page_name(command, name));
}

bool StagedFiles::remove(const std::string& name) {
  const FolderLock lock(folder_.path, FolderLock::Missing::kLeave);
  if (!lock.is_held()) return false;
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
  move_file(staging_ / ResultManifest::kName, folder_.path / ResultManifest::kName);
}

}  // namespace regoplan
