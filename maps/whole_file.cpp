#include "maps/whole_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <system_error>

#include "terramech/basics/input_error.h"

namespace regoplan {

namespace fs = std::filesystem;

void write_whole_file(const std::string& file,
                      const std::function<void(const std::string& unfinished)>& write) {
  const fs::path target(file);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: the folder {} does not exist", file, folder.string()));
  }
  if (fs::is_directory(target)) throw InputError(fmt::format("{}: is a folder", file));
  static std::atomic<unsigned> count = 0;
  const fs::path unfinished =
      folder / fmt::format(".{}.{}.{}.unfinished", target.filename().string(), getpid(), ++count);
  std::error_code ignored;
  try {
    write(unfinished.string());
    fs::rename(unfinished, target);
  } catch (const fs::filesystem_error& error) {
    fs::remove(unfinished, ignored);
    throw InputError(fmt::format("{}: cannot be written: {}", file, error.code().message()));
  } catch (...) {
    fs::remove(unfinished, ignored);
    throw;
  }
}

}  // namespace regoplan
