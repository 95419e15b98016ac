#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace regoplan {

/// What the head of a page says of the command that made it.
std::string page_mark(std::string_view command);

/// The command that made a page; empty of what is no page of regoplan's.
std::string page_command(const std::filesystem::path& page);

/// Where the page of a command is kept once another command's takes its name: `report.html` of
/// `plan` as `plan-report.html`.
std::string kept_page_name(const std::string& command, const std::string& page);

}  // namespace regoplan
