#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace regoplan {

/// A file that exists in memory only.
struct RenderedFile {
  std::string name;
  std::string content;
};

/// Where results go.
struct ResultFolder {
  std::filesystem::path path;
  bool force = false;            ///< files that others wrote or edited are replaced as well
  std::string option = "--out";  ///< that names it, for messages
};

class ResultManifest;

/// Files on their way into a folder: written to a hidden folder inside it (where it is missing,
/// inside the lowest one above it that exists), moved to their names by `commit()`, and gone
/// without a trace where that is never reached. So there are whole files or none, and a folder only
/// where it holds something. Processes may share a folder: the files of one `commit()` stand
/// together. Hidden folders that killed processes have left are swept. A page replaces only pages
/// of its command: that of another stays beside it, as `kept_page_name` says.
class StagedFiles {
 public:
  /// Finds out whether the folder can be made where it is missing.
  /// \throws InputError where it cannot be made or written to
  explicit StagedFiles(const ResultFolder& folder);
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Where to write the file that shall be called `name`.
  std::string path(const std::string& name);

  /// \throws InputError where the file cannot be written
  void write(const RenderedFile& file);

  /// Makes the folder where it is missing.
  /// \throws InputError where a file cannot be moved to its name, or would replace one that is not
  /// regoplan's own
  void commit();

  /// Takes away a result of an earlier run. \returns whether there was one of regoplan's own
  bool remove(const std::string& name);

 private:
  /// The page of another command, in the folder, and what it is called from now on.
  struct PageMove {
    std::string name, kept;
  };

  void try_missing(const std::filesystem::path& missing, std::error_code& failed) const;
  void remove_staging() const;
  void move_all();
  void write_manifest(const std::string& text);
  std::vector<PageMove> pages_of_others() const;
  void remove_kept(const std::string& name, ResultManifest& manifest) const;

  ResultFolder folder_;
  std::filesystem::path staging_;
  int lock_ = -1;  ///< says to others that the staging folder is in use
  std::vector<std::string> names_;
};

/// Asked before long work: whether `folder` takes files, or can be made where it is missing. Leaves
/// everything as it was.
/// \throws InputError where that fails
void require_writable_folder(const ResultFolder& folder);

/// The command whose page stands where another command will write the page of this name, and so is
/// kept under another; empty where there is none.
std::string other_page(const ResultFolder& folder, std::string_view command,
                       const std::string& page = "report.html");

/// \throws InputError also where one of these files could not be replaced: it is no regular file,
/// or not as regoplan left it
void require_results_fit(const ResultFolder& folder, const std::vector<std::string>& names);

}  // namespace regoplan
