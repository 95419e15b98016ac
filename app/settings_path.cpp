#include "app/settings_path.h"

#include <fmt/format.h>

#include <cstdlib>

namespace regoplan {

std::filesystem::path named_file(const SettingsNode& name, const std::filesystem::path& folder) {
  std::string file = name.text();
  for (std::size_t from = file.find("${"); from != std::string::npos; from = file.find("${")) {
    const std::size_t to = file.find('}', from);
    if (to == std::string::npos) throw name.error(file + ": ${ without }");
    const std::string variable = file.substr(from + 2, to - from - 2);
    const char* value = std::getenv(variable.c_str());
    if (!value || *value == '\0') {
      throw name.error(fmt::format("{}: the environment variable {} is not set", file, variable));
    }
    if (std::string_view(value).find("${") != std::string_view::npos) {
      throw name.error(fmt::format("{}: the environment variable {} holds ${{", file, variable));
    }
    file.replace(from, to - from + 1, value);
  }
  return folder / file;
}

}  // namespace regoplan
