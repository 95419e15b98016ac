#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/settings/settings_node.h"

namespace regoplan {

/// A file that a settings value names: relative to the folder of the settings, with `${NAME}`
/// standing for an environment variable. Only those whose names begin with `REGOPLAN_` do: a file
/// from elsewhere could else send away what others hold.
struct NamedFile {
  std::filesystem::path path;
  std::filesystem::path shown;  ///< for people: as written, variables not expanded
  std::vector<std::pair<std::string, std::string>> variables;  ///< value, `${NAME}`

  /// `text` with whatever was expanded as it was written.
  std::string unexpanded(std::string text) const;
};

/// \throws SettingsError where a variable may not stand there or is not set
NamedFile named_file(const SettingsNode& name, const std::filesystem::path& folder);

/// Calls `read(NamedFile)`; what it throws shows the name as it was written.
template <class Read>
auto with_named_file(const SettingsNode& name, const std::filesystem::path& folder, Read read) {
  const NamedFile file = named_file(name, folder);
  try {
    return read(file);
  } catch (const SettingsError& bad) {
    throw SettingsError(file.unexpanded(bad.what()));
  } catch (const InputError& bad) {
    throw InputError(file.unexpanded(bad.what()));
  } catch (const std::filesystem::filesystem_error& bad) {  // as a name of too many letters
    throw InputError(fmt::format("{}: {}", file.shown.string(), bad.code().message()));
  }
}

}  // namespace regoplan
