#include "app/settings/suite_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/settings/settings_mapping.h"
#include "app/settings/settings_path.h"
#include "app/settings/sweep_keys.h"

namespace regoplan {
namespace {

constexpr int kMost = 1000000;

/// `suite.yaml:3: planners[1]`
std::string place_of(const SettingsNode& node) {
  return fmt::format("{}:{}: {}", node.file(), node.line(), node.path());
}

std::string label_of(const SettingsNode& node, const std::string& text) {
  if (!is_label(text))
    throw node.error(fmt::format("{} is no name (allowed: {})", text, kLabelRule));
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

std::string planner_name_of(const SettingsNode& node, const std::vector<std::string>& own) {
  std::vector<std::string> names = planner_names();
  std::erase(names, "auto");
  names.insert(names.end(), own.begin(), own.end());
  return names[node.choice(names)];
}

/// A planner for each value of a parameter that is given as a list, and each combination of them:
/// `RRT-goal_bias-0.1`.
std::vector<SuitePlanner> with_parameter(const std::vector<SuitePlanner>& planners,
                                         const SettingsEntry& entry) {
  std::vector<SuitePlanner> all;
  for (SuitePlanner planner : planners) {
    if (entry.value.kind() != SettingsNode::Kind::kList) {
      planner.parameters[entry.key] = entry.value.text();
      all.push_back(std::move(planner));
      continue;
    }
    if (entry.value.list().empty()) throw entry.value.error("is empty (allowed: at least one)");
    for (const SettingsNode& value : entry.value.list()) {
      SuitePlanner& varied = all.emplace_back(planner);
      varied.parameters[entry.key] = value.text();
      varied.label = label_of(value, planner.label + "-" + entry.key + "-" + value.text());
    }
  }
  return all;
}

std::vector<SuitePlanner> read_suite_planner(const SettingsNode& node,
                                             const std::vector<std::string>& own) {
  if (node.kind() != SettingsNode::Kind::kMapping) {
    const std::string name = planner_name_of(node, own);
    return {{.label = name, .planner = name, .parameters = {}}};
  }
  return read_mapping(node, [&own](SettingsMapping& mapping) {
    const std::string known = planner_name_of(mapping.required("planner"), own);
    const SettingsNode* name = mapping.optional("name");
    std::vector<SuitePlanner> planners{{.label = name ? label_of(*name, name->text()) : known,
                                        .planner = known,
                                        .parameters = {}}};
    if (const SettingsNode* parameters = mapping.optional("parameters")) {
      for (const SettingsEntry& entry : parameters->mapping()) {
        planners = with_parameter(planners, entry);
      }
    }
    return planners;
  });
}

void read_planners(const SettingsNode& node, const std::vector<std::string>& own, Suite& suite) {
  std::set<std::string> seen;
  for (const SettingsNode& item : node.list()) {
    for (SuitePlanner& planner : read_suite_planner(item, own)) {
      require_new(seen, item, planner.label);
      suite.planner_places[planner.label] = place_of(item);
      suite.planners.push_back(std::move(planner));
    }
  }
  if (suite.planners.empty()) throw node.error("is empty (allowed: at least one)");
}

std::vector<SuiteScenario> read_scenarios(const SettingsNode& node,
                                          const std::filesystem::path& folder) {
  std::vector<SuiteScenario> scenarios;
  std::set<std::string> seen;
  for (const SettingsNode& item : node.list()) {
    scenarios.push_back(read_suite_scenario(item, folder));
    require_new(seen, item, scenarios.back().label);
  }
  if (scenarios.empty()) throw node.error("is empty (allowed: at least one)");
  return scenarios;
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
void read_sweep(const SettingsNode& node, Suite& suite) {
  suite.sweep_places[""] = place_of(node);
  for (const SettingsEntry& entry : node.mapping()) {
    const SettingsNode& values = entry.value;
    const SweepKey key = placed(values, [&] { return sweep_key(entry.key); });
    suite.sweep_places[entry.key] = place_of(values);
    constexpr std::size_t kPointsMax = 10000;
    if (suite.sweep.size() * values.list().size() > kPointsMax) {
      throw values.error(fmt::format("more than {} combinations", kPointsMax));
    }
    std::vector<double> numbers;
    for (const SettingsNode& value : values.list()) {
      const double number = value.number(key.allowed);
      if (std::ranges::find(numbers, number) != numbers.end()) {
        throw value.error(fmt::format("{} stands twice", number));
      }
      numbers.push_back(number);
    }
    if (numbers.empty()) throw values.error("is empty (allowed: at least one)");
    std::vector<SweepPoint> more;
    for (const SweepPoint& point : suite.sweep) {
      for (const double number : numbers) {
        more.push_back(point);
        more.back()[entry.key] = number;
      }
    }
    suite.sweep = std::move(more);
  }
}

}  // namespace

bool is_label(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  return !text.empty() && text.front() != '.' && std::all_of(text.begin(), text.end(), allowed);
}

Suite read_suite(const std::string& file, const std::vector<std::string>& own_planners) {
  const SettingsNode root = read_settings(file);
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  return read_mapping(root, [&](SettingsMapping& mapping) {
    Suite suite;
    const SettingsNode& name = mapping.required("name");
    suite.name = label_of(name, name.text());
    suite.scenarios = read_scenarios(mapping.required("scenarios"), folder);
    read_planners(mapping.required("planners"), own_planners, suite);
    suite.seeds = read_seeds(mapping.required("seeds"));
    suite.bounds.time_s = mapping.number("time_s", {.min = 0, .max = 1e6, .min_excluded = true});
    if (const SettingsNode* iterations = mapping.optional("iterations")) {
      suite.bounds.iterations = iterations->integer(1, kIterationsMax);
    }
    suite.bounds.memory_mb = mapping.number_or("memory_mb", {.min = 16, .max = 1e7}, 2048);
    suite.bounds.progress_interval_s =
        mapping.number_or("progress_interval_s", {.min = 0.001, .max = 1e4}, 0.05);
    const SettingsNode* draws = mapping.optional("soil_draws");
    suite.bounds.soil_draws = draws ? static_cast<int>(draws->integer(1, kMost)) : 100;
    if (const SettingsNode* sweep = mapping.optional("sweep")) read_sweep(*sweep, suite);
    return suite;
  });
}

PlanningProblem at_sweep_point(PlanningProblem problem, const Suite& suite, std::size_t scenario,
                               std::size_t sweep_point) {
  const auto refused = [&](const std::string& key, const InputError& bad) {
    const auto place = suite.sweep_places.find(key);
    return InputError(fmt::format("{}{}: {}",
                                  place == suite.sweep_places.end() ? "" : place->second + ": ",
                                  experiment_name(suite, scenario, sweep_point), bad.what()));
  };
  for (const auto& [key, value] : suite.sweep[sweep_point]) {
    try {
      sweep_key(key).set(problem, value);
    } catch (const InputError& bad) {
      throw refused(key, bad);
    }
  }
  try {
    for (const MapSoil& soil : problem.map.soils()) validate(soil.soil.mean);
    validate(problem);
  } catch (const InputError& bad) {
    throw refused("", bad);
  }
  return problem;
}

}  // namespace regoplan
