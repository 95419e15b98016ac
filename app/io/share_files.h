#pragma once

#include <string>

namespace regoplan {

/// A file that comes with the program, by its name in the source tree.
std::string share_file(const std::string& name);

}  // namespace regoplan
