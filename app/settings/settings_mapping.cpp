#include "app/settings/settings_mapping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include "terramech/basics/nearest_name.h"

namespace regoplan {
namespace {

/// `mass_kg` is all of `vehicle.mass_kg`.
bool means_all_of(const SettingsNode& value, std::string_view field) {
  return fmt::format(".{}", value.path()).ends_with(fmt::format(".{}", field));
}

/// The parts of a key between its underscores.
std::vector<std::string_view> parts_of(std::string_view key) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at != std::string_view::npos;) {
    const std::size_t end = key.find('_', at);
    parts.push_back(key.substr(at, end == std::string_view::npos ? end : end - at));
    at = end == std::string_view::npos ? end : end + 1;
  }
  return parts;
}

/// Keys of a family differ in one part, as long in both, that is an index or a short word: `x_m`
/// and `y_m`, `x_min_m` and `x_max_m`, `kx0_m` and `kx1_m`, `a0` and `a1`. They are no slips of
/// each other, as `gosl` is one of `goal`.
bool are_of_one_family(std::string_view a, std::string_view b) {
  const auto of_a = parts_of(a), of_b = parts_of(b);
  const auto differing = std::ranges::mismatch(of_a, of_b);
  if (of_a.size() != of_b.size() || differing.in1 == of_a.end()) return false;
  const std::string_view one = *differing.in1, other = *differing.in2;
  if (!std::equal(differing.in1 + 1, of_a.end(), differing.in2 + 1)) return false;
  constexpr std::size_t kShort = 3;
  const bool is_indexed = std::ranges::any_of(one, [](unsigned char c) { return std::isdigit(c); });
  return one.size() == other.size() && (is_indexed || (of_a.size() > 1 && one.size() <= kShort));
}

/// Whether a key that is given may be one that is missing.
bool may_misspell(std::string_view given, std::string_view missing) {
  constexpr std::size_t kEditsMax = 2;
  const std::size_t edits = edits_between(given, missing);
  return edits <= kEditsMax && 2 * edits <= missing.size() && !are_of_one_family(given, missing);
}

/// Whether a key that is given is one that is missing, in another unit: `heading_rad` and
/// `heading_deg`.
bool has_other_unit(std::string_view given, std::string_view missing) {
  static const std::set<std::string_view> units{
      "m",   "cm",  "mm",  "km",  "ft",   "in", "deg", "rad", "mps", "kmh", "kph", "mph",
      "s",   "ms",  "min", "h",   "kg",   "g",  "lb",  "t",   "n",   "kn",  "nm",  "pa",
      "kpa", "mpa", "psi", "bar", "mps2", "w",  "kw",  "j",   "kj",  "wh"};
  const std::vector<std::string_view> of_given = parts_of(given), of_missing = parts_of(missing);
  return of_given.size() > 1 && of_given.size() == of_missing.size() && given != missing &&
         std::equal(of_given.begin(), of_given.end() - 1, of_missing.begin()) &&
         units.contains(of_given.back()) && units.contains(of_missing.back());
}

}  // namespace

SettingsError placed_error(const SettingsNode& node, const ValueError& bad) {
  const SettingsNode* value = node.find(bad.field());
  const std::string what = fmt::format("{} is not valid (allowed: {})", bad.value(), bad.allowed());
  return value && means_all_of(*value, bad.field()) ? value->error(what)
                                                    : (value ? *value : node).error(bad.what());
}

SettingsError placed_error(const SettingsNode& node, const InputError& bad) {
  // Checks begin with the field: "start.x_m: ...", "wheels: ...".
  const std::string_view what = bad.what();
  const std::size_t colon = what.find(": ");
  const SettingsNode* value =
      colon == std::string_view::npos ? nullptr : node.find(what.substr(0, colon));
  if (!value) return node.error(what);
  return value->error(means_all_of(*value, what.substr(0, colon)) ? what.substr(colon + 2) : what);
}

SettingsMapping::SettingsMapping(const SettingsNode& node) : node_(node) {
  node.mapping();
}

const SettingsNode* SettingsMapping::optional(std::string_view key) {
  asked_.emplace(key);
  for (const SettingsEntry& entry : node_.mapping()) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

const SettingsNode& SettingsMapping::required(std::string_view key) {
  if (const SettingsNode* value = optional(key)) return *value;
  for (const SettingsEntry& entry : node_.mapping()) {
    if (asked_.contains(entry.key) || !has_other_unit(entry.key, key)) continue;
    throw node_.error(fmt::format("{} is missing ({} on line {} is in another unit)", key,
                                  entry.key, entry.line));
  }
  // A misspelt key is the likeliest other reason.
  const SettingsEntry* nearest = nullptr;
  for (const SettingsEntry& entry : node_.mapping()) {
    if (asked_.contains(entry.key) || !may_misspell(entry.key, key)) continue;
    if (!nearest || edits_between(entry.key, key) < edits_between(nearest->key, key)) {
      nearest = &entry;
    }
  }
  if (!nearest) throw node_.error(fmt::format("{} is missing", key));
  throw node_.error(fmt::format("{} is missing ({} on line {}: did you mean {}?)", key,
                                nearest->key, nearest->line, key));
}

double SettingsMapping::number(std::string_view key, const ValueRange& allowed) {
  return required(key).number(allowed);
}

double SettingsMapping::number_or(std::string_view key, const ValueRange& allowed,
                                  double fallback) {
  const SettingsNode* value = optional(key);
  return value ? value->number(allowed) : fallback;
}

void SettingsMapping::reject_unread_keys() const {
  const auto& given = node_.mapping();
  const auto unread = std::ranges::find_if(
      given, [&](const SettingsEntry& entry) { return !asked_.contains(entry.key); });
  if (unread == given.end()) return;
  std::vector<std::string> not_given(asked_.begin(), asked_.end());
  for (const SettingsEntry& entry : given) std::erase(not_given, entry.key);
  const auto nearest = nearest_name(unread->key, not_given);
  const std::string hint = nearest ? fmt::format("did you mean {}?", *nearest)
                                   : fmt::format("known: {}", fmt::join(asked_, ", "));
  throw SettingsError(fmt::format("{}:{}: {}: unknown key ({})", node_.file(), unread->line,
                                  unread->value.path(), hint));
}

}  // namespace regoplan
