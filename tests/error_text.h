#pragma once

#include <string>

#include "terramech/basics/input_error.h"

namespace regoplan {

/// What `action` says is wrong; empty where it finds nothing wrong.
template <class Action>
std::string error_text(Action action) {
  try {
    action();
  } catch (const InputError& bad) {
    return bad.what();
  }
  return "";
}

/// `text` with the one occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

}  // namespace regoplan
