#include "app/io/share_files.h"

#include <filesystem>

namespace regoplan {

std::string share_file(const std::string& name) {
  // Installed, the program finds them beside itself and nowhere else, lest a file that is not
  // installed be missing only where there is no source tree; in its build folder, in that tree.
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path installed = program.parent_path() / "../share/regoplan";
  if (!none && std::filesystem::is_directory(installed, none)) {
    return (installed / name).lexically_normal();
  }
  return REGOPLAN_SOURCE_SHARE_DIR "/" + name;
}

}  // namespace regoplan
