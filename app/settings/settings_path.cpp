#include "app/settings/settings_path.h"

#include <fmt/format.h>

#include <cstdlib>

namespace regoplan {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string NamedFile::unexpanded(std::string text) const {
  if (variables.empty()) return text;
  replace_all(text, path.string(), shown.string());
  // Others may have said a part of the name; a value of a few letters would be found anywhere.
  constexpr std::size_t kLettersMin = 4;
  for (const auto& [value, variable] : variables) {
    if (value.size() >= kLettersMin) replace_all(text, value, variable);
  }
  return text;
}

NamedFile named_file(const SettingsNode& name, const std::filesystem::path& folder) {
  const std::string written = name.text();
  NamedFile named{.path = {}, .shown = folder / written, .variables = {}};
  std::string file;
  std::size_t done = 0;
  for (std::size_t from = written.find("${"); from != std::string::npos;
       from = written.find("${", done)) {
    const std::size_t to = written.find('}', from);
    if (to == std::string::npos) throw name.error(written + ": ${ without }");
    const std::string variable = written.substr(from + 2, to - from - 2);
    if (!variable.starts_with("REGOPLAN_")) {
      throw name.error(
          fmt::format("{}: the environment variable {} may not stand here (allowed: REGOPLAN_...)",
                      written, variable));
    }
    const char* value = std::getenv(variable.c_str());
    if (!value || *value == '\0') {
      throw name.error(
          fmt::format("{}: the environment variable {} is not set", written, variable));
    }
    file += written.substr(done, from - done) + value;
    named.variables.emplace_back(value, written.substr(from, to + 1 - from));
    done = to + 1;
  }
  const std::filesystem::path expanded = file + written.substr(done);
  named.path = folder / expanded;
  if (expanded.is_absolute()) named.shown = written;
  return named;
}

}  // namespace regoplan
