#pragma once

#include <string_view>

#include "app/io/staged_files.h"

namespace regoplan {

/// Said before long work where the page of another command stands in the folder: its name goes to
/// the page of `command`.
/// \throws InputError where the name that it is kept under is taken by a file of others
void notify_of_kept_page(const ResultFolder& folder, std::string_view command, bool quiet);

}  // namespace regoplan
