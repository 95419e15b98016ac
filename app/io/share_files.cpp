#include "app/io/share_files.h"

namespace regoplan {

std::string share_file(const std::string& name) {
  return REGOPLAN_SHARE_DIR "/" + name;
}

}  // namespace regoplan
