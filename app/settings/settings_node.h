#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"

namespace regoplan {

/// Bad input whose message already names the file, and the line where there is one.
class SettingsError : public InputError {
 public:
  using InputError::InputError;
};

/// The largest seed, in files and on the command line.
inline constexpr std::int64_t kSeedMax = INT64_MAX;

/// What is allowed where a number is wanted and something else is given: "a number, 1 to 5".
std::string number_text(const ValueRange& allowed);

/// What is allowed where a whole number is wanted, in words: "a whole number, 1 to 5".
std::string whole_number_text(std::int64_t min, std::int64_t max);

struct SettingsEntry;

/// A value of a YAML settings file that knows where it stands. Every reading is strict and throws a
/// SettingsError of the form `scenario.yaml:12: vehicle.mass_kg: -5 is not valid (allowed: above
/// 0)`.
class SettingsNode {
 public:
  enum class Kind { kEmpty, kScalar, kList, kMapping };

  Kind kind() const { return kind_; }
  const std::string& file() const { return *file_; }
  int line() const { return line_; }
  /// Keys from the root of the file, `wheels[2].x_m`; empty for the root.
  const std::string& path() const { return path_; }

  /// A scalar as it stands, empty or not; empty for any other kind.
  const std::string& scalar() const { return scalar_; }
  /// Whether a scalar stands in quotes: then it is text, whatever it looks like.
  bool quoted() const { return quoted_; }

  double number(const ValueRange& allowed) const;
  std::int64_t integer(std::int64_t min, std::int64_t max) const;
  /// `true` or `false`.
  bool truth() const;
  /// Any scalar, not empty.
  std::string text() const;
  /// The index in `choices` of the scalar.
  std::size_t choice(const std::vector<std::string>& choices) const;
  const std::vector<SettingsNode>& list() const;
  const std::vector<SettingsEntry>& mapping() const;

  /// An error about this value: place, path and `what`.
  SettingsError error(std::string_view what) const;
  /// An error about this value as it was written.
  SettingsError not_allowed(std::string_view allowed) const;

  /// The value that a domain check calls `field`, below this one: `goal.radius_m`,
  /// `wheels.front_left.x_m` (an item of a list by its `name`), or the first key of that name at
  /// any depth. Where the file does not give the whole of it, the deepest part that it gives; null
  /// where it gives none.
  const SettingsNode* find(std::string_view field) const;

 private:
  friend struct SettingsTree;
  const SettingsNode* child(std::string_view name) const;
  const SettingsNode* first_key(std::string_view key) const;

  std::shared_ptr<const std::string> file_;
  int line_ = 0;
  std::string path_;
  Kind kind_ = Kind::kEmpty;
  std::string scalar_;
  bool quoted_ = false;
  std::vector<SettingsNode> list_;
  std::vector<SettingsEntry> mapping_;
};

struct SettingsEntry {
  std::string key;
  int line = 0;
  SettingsNode value;
};

/// \throws SettingsError where the file cannot be read, is not one YAML document, is empty, gives a
/// key twice, has an anchor or alias, is nested deeper than 20 levels, or has more than a million
/// bytes or 100 000 values
SettingsNode read_settings(const std::string& file);

/// The text that `read_settings` reads, once: pipes give it only once.
std::string settings_text(const std::string& file);

/// As `read_settings`, for text that stands in `file`.
SettingsNode parse_settings(const std::string& text, const std::string& file);

}  // namespace regoplan
