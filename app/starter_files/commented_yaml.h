#pragma once

#include <string>

namespace regoplan {

/// YAML of a vehicle or a soil with a comment behind each key of which it is known what it is.
std::string commented_yaml(const std::string& yaml);

}  // namespace regoplan
