#pragma once

#include <string>

namespace regoplan {

/// \throws InputError where a VRT, or one that it names, names anything but files of the folder in
/// which the first one stands, or below
void require_own_sources(const std::string& vrt);

}  // namespace regoplan
