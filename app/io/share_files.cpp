#include "app/io/share_files.h"

#include <filesystem>

namespace regoplan {

std::string share_file(const std::string& name) {
  // Installed, the program finds them beside itself; in its build folder, in the source tree.
  std::error_code none;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", none);
  const std::filesystem::path installed = program.parent_path() / "../share/regoplan" / name;
  if (!none && std::filesystem::exists(installed, none)) return installed.lexically_normal();
  return REGOPLAN_SOURCE_SHARE_DIR "/" + name;
}

}  // namespace regoplan
