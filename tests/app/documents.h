#pragma once

#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace regoplan {

/// A page of the tree; tests run from the source root.
inline std::string page(const std::filesystem::path& file) {
  std::stringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

/// What stands as code on pages of docs/: between backticks, in spans and in fenced blocks.
inline std::string code_of(const std::vector<std::string>& names) {
  std::string code;
  for (const std::string& name : names) {
    bool inside = false;
    for (const char c : page(std::filesystem::path("docs") / name)) {
      if (c == '`') {
        inside = !inside;
        code += '\n';
      } else if (inside) {
        code += c;
      }
    }
    code += '\n';
  }
  return code;
}

/// Whether a key stands in code as a whole word.
inline bool names_key(const std::string& code, const std::string& key) {
  const auto part_of_word = [&code](std::size_t at) {
    return at < code.size() &&
           (std::isalnum(static_cast<unsigned char>(code[at])) != 0 || code[at] == '_');
  };
  for (std::size_t at = code.find(key); at != std::string::npos; at = code.find(key, at + 1)) {
    if ((at == 0 || !part_of_word(at - 1)) && !part_of_word(at + key.size())) return true;
  }
  return false;
}

/// Those of the keys that none of the pages names.
inline std::set<std::string> undocumented(const std::set<std::string>& keys,
                                          const std::vector<std::string>& pages) {
  const std::string code = code_of(pages);
  std::set<std::string> missing;
  for (const std::string& key : keys) {
    if (!names_key(code, key)) missing.insert(key);
  }
  return missing;
}

}  // namespace regoplan
