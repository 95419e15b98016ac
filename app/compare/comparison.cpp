#include "app/compare/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "planner/problem/margin_spread.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;

/// `/limits/margin_min` as `limits.margin_min`.
std::string key_of(std::string pointer) {
  pointer.erase(0, 1);
  std::ranges::replace(pointer, '/', '.');
  return pointer;
}

std::vector<ComparedSetting> differing_settings(const ComparedResult& a, const ComparedResult& b) {
  const Json of_a = a.asked.flatten(), of_b = b.asked.flatten();
  std::vector<ComparedSetting> settings;
  for (const auto& [pointer, value] : of_a.items()) {
    const Json other = of_b.value(pointer, Json());
    if (other != value) settings.push_back({key_of(pointer), value, other});
  }
  for (const auto& [pointer, value] : of_b.items()) {
    if (of_a.contains(pointer) || value.is_null()) continue;
    settings.push_back({key_of(pointer), Json(), value});
  }
  if (a.version != b.version) settings.push_back({"version", a.version, b.version});
  return settings;
}

/// What no digest tells counts as another.
std::vector<std::string> differing_inputs(const ComparedResult& a, const ComparedResult& b) {
  std::set<std::string> keys;
  for (const auto& [key, digest] : a.inputs.items()) keys.insert(key);
  for (const auto& [key, digest] : b.inputs.items()) keys.insert(key);
  std::vector<std::string> differing;
  for (const std::string& key : keys) {
    const Json of_a = a.inputs.value(key, Json()), of_b = b.inputs.value(key, Json());
    if (of_a.is_null() || of_a != of_b) differing.push_back(key);
  }
  return differing;
}

std::vector<std::optional<double>> change(const ComparedEntry& a, const ComparedEntry& b) {
  std::vector<std::optional<double>> differences;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    differences.push_back(a.values[i] && b.values[i] ? std::optional(*b.values[i] - *a.values[i])
                                                     : std::nullopt);
  }
  return differences;
}

bool holds(const Interval& interval, double value) {
  return interval[0] <= value && value <= interval[1];
}

bool overlap(const Interval& a, const Interval& b) {
  return a[0] <= b[1] && b[0] <= a[1];
}

/// By metric, whether the sampling errors leave open which of the two is more. Limits that broke in
/// draws are no smaller margin, but another thing.
std::vector<bool> ties(const ComparedEntry& a, const ComparedEntry& b,
                       const std::vector<ComparedMetric>& metrics) {
  const auto is_broken = [](double value) { return value <= MarginSpread::kBroken; };
  std::vector<bool> of_metrics(a.values.size(), false);
  for (std::size_t i = 0; i < std::min(a.intervals.size(), b.intervals.size()); ++i) {
    if (!a.values[i] || !b.values[i] || !a.intervals[i] || !b.intervals[i]) continue;
    const double of_a = *a.values[i], of_b = *b.values[i];
    of_metrics[i] =
        is_broken(of_a) == is_broken(of_b) &&
        (metrics[i].of_few ? overlap(*a.intervals[i], *b.intervals[i])
                           : holds(*a.intervals[i], of_b) || holds(*b.intervals[i], of_a));
  }
  return of_metrics;
}

std::vector<ComparedPair> pairs_of(const ComparedResult& a, const ComparedResult& b) {
  std::vector<ComparedPair> pairs;
  for (const ComparedEntry& entry : a.entries) {
    const auto other = std::ranges::find(b.entries, entry.name, &ComparedEntry::name);
    ComparedPair pair{.name = entry.name, .a = &entry};
    if (other != b.entries.end()) {
      pair.b = &*other;
      pair.change = change(entry, *other);
      pair.tied = ties(entry, *other, metrics_of(a.kind));
    }
    pairs.push_back(std::move(pair));
  }
  for (const ComparedEntry& entry : b.entries) {
    if (std::ranges::find(a.entries, entry.name, &ComparedEntry::name) == a.entries.end()) {
      pairs.push_back({.name = entry.name, .b = &entry});
    }
  }
  return pairs;
}

std::string differences_text(const Comparison& comparison) {
  const std::size_t settings = comparison.settings.size(), inputs = comparison.inputs.size();
  if (settings + inputs == 0) return "The same was asked of both.";
  const auto counted = [](std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  if (inputs == 0) return fmt::format("They differ in {}.", counted(settings, "setting"));
  if (settings == 0) return fmt::format("They differ in {}.", counted(inputs, "input file"));
  return fmt::format("They differ in {} and {}.", counted(settings, "setting"),
                     counted(inputs, "input file"));
}

/// The metric, by its index, that says which of a pair is better: the first, which of plans and
/// evaluations is the margin that soils leave. Fewer than 73 draws leave that 5 % quantile without
/// a lower bound, so that its interval never tells two paths apart; then their medians do.
std::size_t deciding(const ComparedPair& pair, const std::vector<ComparedMetric>& metrics) {
  const auto is_open = [](const ComparedEntry& entry) {
    return entry.intervals.front()->front() <= MarginSpread::kBroken &&
           *entry.values.front() > MarginSpread::kBroken;
  };
  if (!pair.tied.front() || !(is_open(*pair.a) || is_open(*pair.b))) return 0;
  const auto median = std::ranges::find(metrics, "margin_p50", &ComparedMetric::key);
  const auto at = static_cast<std::size_t>(median - metrics.begin());
  return median != metrics.end() && pair.change[at] ? at : 0;
}

/// By what decides of each pair.
std::string outcome_text(const ComparedResult& a, const Comparison& comparison) {
  const std::vector<ComparedMetric>& metrics = metrics_of(a.kind);
  int both = 0, better = 0, worse = 0, same = 0, tied = 0, by_median = 0;
  for (const ComparedPair& pair : comparison.pairs) {
    if (!pair.a || !pair.b) continue;
    ++both;
    if (!pair.change.front()) continue;
    const std::size_t by = deciding(pair, metrics);
    const double change = *pair.change[by];
    const double gain = metrics[by].better == ComparedMetric::Better::kMore ? change : -change;
    ++(gain == 0 ? same : pair.tied[by] ? tied : gain > 0 ? better : worse);
    by_median += by != 0;
  }
  if (both == 0) return "They have nothing of one name.";
  std::vector<std::string> parts;
  const auto tell = [&](std::string_view how, int count) {
    if (count > 0) parts.push_back(fmt::format("{} for {}", how, count));
  };
  tell("better", better);
  tell("worse", worse);
  tell(fmt::format("tied within the {}", sampled(a.kind)), tied);
  tell("the same", same);
  tell("not known", both - better - worse - same - tied);
  const std::string of_medians =
      by_median == 0 ? ""
                     : fmt::format("; for {} by the median, as the draws are too few to bound that",
                                   by_median);
  return fmt::format("Of {} in both, B is {} ({}{}).", both, fmt::join(parts, ", "),
                     metrics.front().words, of_medians);
}

Json entry_json(const ComparedEntry* entry, const std::vector<ComparedMetric>& metrics) {
  if (!entry) return nullptr;
  Json json{{"verdict", entry->verdict}, {"feasible", entry->feasible}};
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    json[std::string(metrics[i].key)] = entry->values[i] ? Json(*entry->values[i]) : Json();
  }
  return json;
}

Json result_json(const ComparedResult& result) {
  return {{"file", result.file.generic_string()},
          {"status", result.status},
          {"version", result.version},
          {"entries", result.entries.size()}};
}

}  // namespace

Comparison compared(const ComparedResult& a, const ComparedResult& b) {
  if (a.kind != b.kind) {
    throw InputError(fmt::format("{} is of {}, {} of {}: only results of one kind can be compared",
                                 a.file.string(), name(a.kind), b.file.string(), name(b.kind)));
  }
  return {.settings = differing_settings(a, b),
          .inputs = differing_inputs(a, b),
          .pairs = pairs_of(a, b)};
}

std::string comparison_headline(const ComparedResult& a, const ComparedResult& b,
                                const Comparison& comparison) {
  const std::string status =
      a.status == b.status ? "" : fmt::format("A is {}, B is {}. ", a.status, b.status);
  return status + outcome_text(a, comparison) + " " + differences_text(comparison);
}

Json comparison_json(const ComparedResult& a, const ComparedResult& b,
                     const Comparison& comparison) {
  const std::vector<ComparedMetric>& metrics = metrics_of(a.kind);
  Json settings = Json::array(), pairs = Json::array();
  for (const ComparedSetting& one : comparison.settings) {
    settings.push_back({{"key", one.key}, {"a", one.a}, {"b", one.b}});
  }
  for (const ComparedPair& pair : comparison.pairs) {
    Json changes = Json::object(), tied = Json::array();
    for (std::size_t i = 0; i < pair.change.size(); ++i) {
      changes[std::string(metrics[i].key)] = pair.change[i] ? Json(*pair.change[i]) : Json();
      if (pair.tied[i]) tied.push_back(metrics[i].key);
    }
    pairs.push_back({{"name", pair.name},
                     {"a", entry_json(pair.a, metrics)},
                     {"b", entry_json(pair.b, metrics)},
                     {"change", pair.change.empty() ? Json() : changes},
                     {"tied", tied}});
  }
  return {{"kind", name(a.kind)}, {"headline", comparison_headline(a, b, comparison)},
          {"a", result_json(a)},  {"b", result_json(b)},
          {"settings", settings}, {"inputs", comparison.inputs},
          {"entries", pairs}};
}

}  // namespace regoplan
