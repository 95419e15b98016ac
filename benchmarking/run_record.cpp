#include "benchmarking/run_record.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace regoplan {

BenchmarkRecord crashed_run(std::uint64_t seed, const std::string& failure) {
  return {.settings = {},
          .properties = {{"status ENUM", std::to_string(ompl_crash_status())},
                         {"solved BOOLEAN", "0"},
                         {"verified BOOLEAN", "0"},
                         {"random seed INTEGER", std::to_string(seed)},
                         {"failure STRING", failure}},
          .progress_names = {},
          .progress = {},
          .path = {}};
}

nlohmann::json to_json(const BenchmarkRecord& record) {
  return {{"settings", record.settings},
          {"properties", record.properties},
          {"progress_names", record.progress_names},
          {"progress", record.progress},
          {"path", record.path}};
}

nlohmann::json to_json(const RunRecord& record) {
  nlohmann::json json = to_json(record.outcome);
  json["experiment"] = record.key.experiment;
  json["planner"] = record.key.planner;
  json["seed"] = record.key.seed;
  return json;
}

BenchmarkRecord benchmark_record_of(const nlohmann::json& json) {
  BenchmarkRecord record;
  json.at("settings").get_to(record.settings);
  json.at("properties").get_to(record.properties);
  json.at("progress_names").get_to(record.progress_names);
  json.at("progress").get_to(record.progress);
  json.at("path").get_to(record.path);
  return record;
}

RunRecord run_record_of(const nlohmann::json& json) {
  RunRecord record{.outcome = benchmark_record_of(json)};
  json.at("experiment").get_to(record.key.experiment);
  json.at("planner").get_to(record.key.planner);
  json.at("seed").get_to(record.key.seed);
  return record;
}

std::optional<double> number(const BenchmarkRecord& record, const std::string& property) {
  const auto found = record.properties.find(property);
  if (found == record.properties.end()) return std::nullopt;
  const std::string& text = found->second;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<double> first_solution_s(const BenchmarkRecord& record) {
  const auto told = number(record, "first solution s REAL");
  if (told) return told;
  return solved_and_verified(record) ? number(record, "time REAL") : std::nullopt;
}

bool solved_and_verified(const BenchmarkRecord& record) {
  return number(record, "verified BOOLEAN") == 1;
}

}  // namespace regoplan
