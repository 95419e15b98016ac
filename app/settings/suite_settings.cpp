#include "app/settings/suite_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>

#include "app/io/content_digest.h"
#include "app/settings/settings_mapping.h"
#include "app/settings/settings_path.h"

namespace regoplan {
namespace {

constexpr int kMost = 1000000;

/// A number of a problem that a suite may vary.
struct SweepKey {
  std::string key;
  std::function<void(PlanningProblem&, double)> set;
};

std::vector<SweepKey> known_sweep_keys() {
  std::vector<SweepKey> keys{
      {"speed_mps.max", [](PlanningProblem& p, double v) { p.speed_max_mps = v; }},
      {"start.speed_mps", [](PlanningProblem& p, double v) { p.start.speed_mps = v; }},
      {"goal.speed_mps.max", [](PlanningProblem& p, double v) { p.goal.speed_max_mps = v; }},
      {"goal.radius_m", [](PlanningProblem& p, double v) { p.goal.radius_m = v; }},
      {"gravity_mps2", [](PlanningProblem& p, double v) { p.gravity_mps2 = v; }}};
  for (const LimitKey& limit : limit_keys()) {
    keys.push_back({fmt::format("limits.{}", limit.key), [&limit](PlanningProblem& p, double v) {
                      p.limits.*limit.value = v * limit.si_per_shown;
                    }});
  }
  return keys;
}

const std::vector<SweepKey>& sweep_keys() {
  static const std::vector<SweepKey> keys = known_sweep_keys();
  return keys;
}

/// Nothing for a number that cannot be varied.
const SweepKey* sweep_key(std::string_view key) {
  const auto found = std::ranges::find(sweep_keys(), key, &SweepKey::key);
  return found == sweep_keys().end() ? nullptr : &*found;
}

/// A name that may stand in OMPL's logs, file names and shells.
std::string label_of(const SettingsNode& node, const std::string& text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  if (text.empty() || text.front() == '.' || !std::all_of(text.begin(), text.end(), allowed)) {
    throw node.error(text + " is no name (allowed: letters, digits, _, - and .)");
  }
  return text;
}

void require_new(std::set<std::string>& seen, const SettingsNode& node, const std::string& label) {
  if (!seen.insert(label).second) throw node.error(label + " stands twice");
}

SuiteScenario read_suite_scenario(const SettingsNode& node, const std::filesystem::path& folder) {
  const auto file_of = [&](const SettingsNode& name) {
    return placed(name, [&] {
      return with_named_file(name, folder, [](const NamedFile& file) {
        if (!std::filesystem::exists(file.path)) {
          throw InputError(file.path.string() + ": no such file");
        }
        return file.path.string();
      });
    });
  };
  if (node.kind() != SettingsNode::Kind::kMapping) {
    const std::string file = file_of(node);
    return {.label = label_of(node, std::filesystem::path(file).stem().string()), .file = file};
  }
  return read_mapping(node, [&](SettingsMapping& mapping) {
    const SettingsNode& name = mapping.required("name");
    return SuiteScenario{.label = label_of(name, name.text()),
                         .file = file_of(mapping.required("file"))};
  });
}

std::string planner_name_of(const SettingsNode& node) {
  std::vector<std::string> names = planner_names();
  std::erase(names, "auto");
  return names[node.choice(names)];
}

SuitePlanner read_suite_planner(const SettingsNode& node) {
  if (node.kind() != SettingsNode::Kind::kMapping) {
    const std::string name = planner_name_of(node);
    return {.label = name, .planner = name, .parameters = {}};
  }
  return read_mapping(node, [](SettingsMapping& mapping) {
    SuitePlanner planner{
        .label = {}, .planner = planner_name_of(mapping.required("planner")), .parameters = {}};
    const SettingsNode* name = mapping.optional("name");
    planner.label = name ? label_of(*name, name->text()) : planner.planner;
    if (const SettingsNode* parameters = mapping.optional("parameters")) {
      for (const SettingsEntry& entry : parameters->mapping()) {
        planner.parameters[entry.key] = entry.value.text();
      }
    }
    return planner;
  });
}

template <class Item>
std::vector<Item> read_labelled(const SettingsNode& node,
                                const std::function<Item(const SettingsNode&)>& read) {
  std::vector<Item> items;
  std::set<std::string> seen;
  for (const SettingsNode& item : node.list()) {
    items.push_back(read(item));
    require_new(seen, item, items.back().label);
  }
  if (items.empty()) throw node.error("is empty (allowed: at least one)");
  return items;
}

std::vector<std::uint64_t> read_seeds(const SettingsNode& node) {
  std::vector<std::uint64_t> seeds;
  if (node.kind() != SettingsNode::Kind::kList) {
    const std::int64_t count = node.integer(1, kMost);
    for (std::int64_t seed = 1; seed <= count; ++seed) {
      seeds.push_back(static_cast<std::uint64_t>(seed));
    }
    return seeds;
  }
  std::set<std::string> seen;
  for (const SettingsNode& item : node.list()) {
    seeds.push_back(static_cast<std::uint64_t>(item.integer(0, 4000000000)));
    require_new(seen, item, std::to_string(seeds.back()));
  }
  if (seeds.empty()) throw node.error("is empty (allowed: at least one)");
  return seeds;
}

/// Every combination of the values of all keys.
std::vector<SweepPoint> read_sweep(const SettingsNode& node) {
  std::vector<SweepPoint> points{{}};
  for (const SettingsEntry& entry : node.mapping()) {
    if (!sweep_key(entry.key)) {
      std::vector<std::string_view> known;
      for (const SweepKey& key : sweep_keys()) known.push_back(key.key);
      throw entry.value.error(
          fmt::format("cannot be varied (allowed: {})", fmt::join(known, ", ")));
    }
    constexpr std::size_t kPointsMax = 10000;
    if (points.size() * entry.value.list().size() > kPointsMax) {
      throw entry.value.error(fmt::format("more than {} combinations", kPointsMax));
    }
    std::vector<SweepPoint> more;
    for (const SweepPoint& point : points) {
      for (const SettingsNode& value : entry.value.list()) {
        more.push_back(point);
        more.back()[entry.key] = value.number(kAnyNumber);
      }
    }
    if (more.empty()) throw entry.value.error("is empty (allowed: at least one)");
    points = std::move(more);
  }
  return points;
}

}  // namespace

Suite read_suite(const std::string& file) {
  const SettingsNode root = read_settings(file);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return read_mapping(root, [&](SettingsMapping& mapping) {
    Suite suite;
    const SettingsNode& name = mapping.required("name");
    suite.name = label_of(name, name.text());
    suite.scenarios = read_labelled<SuiteScenario>(
        mapping.required("scenarios"),
        [&](const SettingsNode& node) { return read_suite_scenario(node, folder); });
    suite.planners = read_labelled<SuitePlanner>(mapping.required("planners"), read_suite_planner);
    suite.seeds = read_seeds(mapping.required("seeds"));
    suite.bounds.time_s = mapping.number("time_s", {.min = 0, .max = 1e6, .min_excluded = true});
    if (const SettingsNode* iterations = mapping.optional("iterations")) {
      suite.bounds.iterations = iterations->integer(1, 2000000000);
    }
    suite.bounds.memory_mb = mapping.number_or("memory_mb", {.min = 16, .max = 1e7}, 2048);
    suite.bounds.progress_interval_s =
        mapping.number_or("progress_interval_s", {.min = 0.001, .max = 1e4}, 0.05);
    const SettingsNode* draws = mapping.optional("soil_draws");
    suite.bounds.soil_draws = draws ? static_cast<int>(draws->integer(1, kMost)) : 100;
    if (const SettingsNode* sweep = mapping.optional("sweep")) suite.sweep = read_sweep(*sweep);
    return suite;
  });
}

PlanningProblem at_sweep_point(PlanningProblem problem, const Suite& suite, std::size_t scenario,
                               std::size_t sweep_point) {
  for (const auto& [key, value] : suite.sweep[sweep_point]) sweep_key(key)->set(problem, value);
  try {
    validate(problem);
  } catch (const InputError& bad) {
    throw InputError(
        fmt::format("{}: {}", experiment_name(suite, scenario, sweep_point), bad.what()));
  }
  return problem;
}

std::string digest(const std::string& scenario_file, const PlanningProblem& problem) {
  std::ifstream stream(scenario_file, std::ios::binary);
  std::stringstream text;
  text << stream.rdbuf();
  ContentDigest hash;
  hash.add(text.str().data(), text.str().size());
  hash.add(problem.map.elevation().height_m);
  if (problem.map.classes()) hash.add(problem.map.classes()->code);
  for (const MapSoil& soil : problem.map.soils()) {
    hash.add(&soil.soil.mean, sizeof(Soil));
    hash.add(&soil.soil.standard_deviation, sizeof(Soil));
  }
  for (const Rock& rock : problem.map.rocks()) hash.add(&rock, sizeof(Rock));
  return fmt::format("{:016x}", hash.value());
}

}  // namespace regoplan
