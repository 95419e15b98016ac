#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "app/settings/settings_node.h"

namespace regoplan {

/// The keys of a mapping, each asked for by name. Made by `read_mapping` only, so that no key goes
/// unread.
class SettingsMapping {
 public:
  const SettingsNode& node() const { return node_; }

  bool has(std::string_view key) { return optional(key) != nullptr; }
  /// Null where the key is not given.
  const SettingsNode* optional(std::string_view key);
  /// \throws SettingsError where the key is not given
  const SettingsNode& required(std::string_view key);

  double number(std::string_view key, const ValueRange& allowed);
  double number_or(std::string_view key, const ValueRange& allowed, double fallback);

 private:
  template <class Read>
  friend auto read_mapping(const SettingsNode& node, Read read);

  explicit SettingsMapping(const SettingsNode& node);
  void reject_unread_keys() const;

  const SettingsNode& node_;
  std::set<std::string, std::less<>> asked_;
};

/// What a domain check says, with the place below `node` of the field that it names.
SettingsError placed_error(const SettingsNode& node, const ValueError& bad);
SettingsError placed_error(const SettingsNode& node, const InputError& bad);

/// Puts file and line of the offending key in front of what `check` throws of a value that was read
/// from `node`.
template <class Check>
auto placed(const SettingsNode& node, Check check) {
  try {
    return check();
  } catch (const SettingsError&) {
    throw;
  } catch (const ValueError& bad) {
    throw placed_error(node, bad);
  } catch (const InputError& bad) {
    throw placed_error(node, bad);
  }
}

/// Reads a mapping: `read(SettingsMapping&)` asks for every key that may stand in it; any other is
/// an error, and so is what `read` throws.
template <class Read>
auto read_mapping(const SettingsNode& node, Read read) {
  return placed(node, [&] {
    SettingsMapping mapping(node);
    auto value = read(mapping);
    mapping.reject_unread_keys();
    return value;
  });
}

}  // namespace regoplan
