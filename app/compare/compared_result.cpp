#include "app/compare/compared_result.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include "benchmarking/summary.h"
#include "terramech/basics/input_error.h"
#include "terramech/tables/csv_table.h"

namespace regoplan {
namespace {

using Json = nlohmann::ordered_json;
using Better = ComparedMetric::Better;

struct KindFile {
  ResultKind kind;
  std::string_view name;
  const char* file;
};
constexpr auto kKinds = std::to_array<KindFile>({
    {ResultKind::kPlan, "plan", "plan.json"},
    {ResultKind::kEvaluation, "evaluation", "evaluation.json"},
    {ResultKind::kBenchmark, "benchmark", "benchmark.json"},
});

std::optional<double> number_at(const Json& entry, std::string_view key) {
  const auto found = entry.find(std::string(key));
  if (found == entry.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::vector<std::optional<double>> values_of(const Json& entry, ResultKind kind) {
  std::vector<std::optional<double>> values;
  for (const ComparedMetric& metric : metrics_of(kind)) {
    values.push_back(number_at(entry, metric.key));
  }
  return values;
}

std::vector<std::optional<Interval>> intervals_of(const Json& entry, ResultKind kind) {
  std::vector<std::optional<Interval>> intervals;
  for (const ComparedMetric& metric : metrics_of(kind)) {
    std::optional<Interval>& interval = intervals.emplace_back();
    const auto found = entry.find(std::string(metric.interval_key));
    if (metric.interval_key.empty()) continue;
    if (found != entry.end() && found->is_array()) {
      interval = {found->at(0).get<double>(), found->at(1).get<double>()};
    } else if (metric.of_few) {
      // Runs too few for an interval leave open how far chance reaches.
      constexpr double kOpen = std::numeric_limits<double>::infinity();
      interval = {-kOpen, kOpen};
    }
  }
  return intervals;
}

ComparedPath path_of(CsvTable& table, std::size_t x, std::size_t y) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto margin = table.find_column("margin");
  ComparedPath path;
  while (const auto cells = table.next()) {
    path.x_m.push_back(table.number(*cells, x, kAnyNumber));
    path.y_m.push_back(table.number(*cells, y, kAnyNumber));
    if (!margin) continue;
    path.margin.push_back(cells->at(*margin).empty() ? kNone
                                                     : table.number(*cells, *margin, kAnyNumber));
  }
  return path;
}

/// A path file that has gone or changed its columns takes nothing from the numbers: then no path.
std::optional<ComparedPath> read_compared_path(const std::filesystem::path& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  try {
    CsvTable table(stream, file.string());
    const auto x = table.find_column("x_m"), y = table.find_column("y_m");
    if (!x || !y) return std::nullopt;
    ComparedPath path = path_of(table, *x, *y);
    if (path.x_m.size() >= 2) return path;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

/// What was asked, and the files that say the rest of it.
void read_asked(const Json& json, ComparedResult& result) {
  result.asked = json.at("settings");
  result.asked["model"] = json.at("model");
  for (const Json& input : json.at("inputs")) {
    result.inputs[input.at("key").get<std::string>()] = input.at("digest");
  }
}

void read_plan(const Json& json, ComparedResult& result) {
  read_asked(json, result);
  for (const Json& candidate : json.at("candidates")) {
    result.entries.push_back({.name = fmt::format("candidate {}", candidate.at("rank").get<int>()),
                              .verdict = "feasible",
                              .feasible = true,
                              .values = values_of(candidate, ResultKind::kPlan),
                              .intervals = intervals_of(candidate, ResultKind::kPlan),
                              .path = read_compared_path(result.file.parent_path() /
                                                         candidate.at("file").get<std::string>())});
  }
}

void read_evaluation(const Json& json, ComparedResult& result) {
  read_asked(json, result);
  result.asked["steering_law"] = json.at("steering_law");
  for (const Json& path : json.at("paths")) {
    const bool feasible = path.at("feasible").get<bool>();
    const bool of_file = path.contains("file");
    const auto shown = path.at(of_file ? "file" : "manoeuvre").get<std::string>();
    ComparedEntry entry{.name = of_file ? std::filesystem::path(shown).filename().string() : shown,
                        .verdict = feasible ? "feasible" : path.at("reason").get<std::string>(),
                        .feasible = feasible,
                        .values = values_of(path, ResultKind::kEvaluation),
                        .intervals = intervals_of(path, ResultKind::kEvaluation)};
    if (of_file) entry.path = read_compared_path(shown);
    result.entries.push_back(std::move(entry));
  }
}

/// `1-20, 25`: one setting, however many there are.
std::string seeds_text(const Json& seeds) {
  std::string text;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const auto first = seeds.at(i).get<std::uint64_t>();
    std::uint64_t last = first;
    while (i + 1 < seeds.size() && seeds.at(i + 1).get<std::uint64_t>() == last + 1) ++i, ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", first);
    if (last > first) text += fmt::format("-{}", last);
  }
  return text;
}

/// A planner's summary with its counts as shares of its runs, which tell planners apart whose runs
/// are not as many, and with the intervals of its medians beside them.
Json with_intervals(Json planner) {
  const int runs = planner.at("runs").get<int>();
  for (const std::string count : {"verified", "overturned"}) {
    const int hits = planner.at(count).get<int>();
    planner[count + "_share"] = static_cast<double>(hits) / runs;
    planner[count + "_share_ci95"] = wilson_ci95(hits, runs);
  }
  const Json intervals = planner.value("medians_ci95", Json::object());
  for (const auto& [key, interval] : intervals.items()) planner[key + "_ci95"] = interval;
  return planner;
}

void read_benchmark(const Json& json, ComparedResult& result) {
  result.asked = json.at("settings");
  result.asked["seeds"] = seeds_text(json.at("settings").at("seeds"));
  result.asked["suite"] = json.at("suite");
  for (const auto& [label, digest] : json.at("scenarios").items()) {
    result.inputs["scenario " + label] = digest.get<std::string>().empty() ? Json() : digest;
  }
  for (const Json& experiment : json.at("experiments")) {
    for (const Json& planner : experiment.at("planners")) {
      const int runs = planner.at("runs").get<int>(), verified = planner.at("verified").get<int>();
      const Json summary = with_intervals(planner);
      result.entries.push_back(
          {.name = fmt::format("{}, {}", experiment.at("name").get<std::string>(),
                               planner.at("planner").get<std::string>()),
           .verdict = fmt::format("{} of {} verified", verified, runs),
           .feasible = verified > 0,
           .values = values_of(summary, ResultKind::kBenchmark),
           .intervals = intervals_of(summary, ResultKind::kBenchmark)});
    }
  }
}

void read_entries(const Json& json, ComparedResult& result) {
  switch (result.kind) {
    case ResultKind::kPlan:
      return read_plan(json, result);
    case ResultKind::kEvaluation:
      return read_evaluation(json, result);
    case ResultKind::kBenchmark:
      return read_benchmark(json, result);
  }
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  try {
    return Json::parse(stream);
  } catch (const Json::parse_error& bad) {
    throw InputError(fmt::format("{}: not valid JSON from byte {} on; remedy: make it again",
                                 file.string(), bad.byte));
  }
}

/// The file of a result, and what it is of by its name.
std::pair<std::filesystem::path, ResultKind> file_of(const std::filesystem::path& result) {
  std::error_code none;
  for (const KindFile& kind : kKinds) {
    if (result.filename() == kind.file) return {result, kind.kind};
    if (std::filesystem::is_regular_file(result / kind.file, none)) {
      return {result / kind.file, kind.kind};
    }
  }
  // Under any other name, too, a text that was cut short is told as such.
  if (result.extension() == ".json" && std::filesystem::is_regular_file(result, none)) {
    read_json(result);
  }
  throw InputError(fmt::format(
      "{}: no result (allowed: a folder with plan.json, evaluation.json or benchmark.json)",
      result.string()));
}

}  // namespace

std::string_view name(ResultKind kind) {
  return kKinds.at(static_cast<std::size_t>(kind)).name;
}

std::string_view sampled(ResultKind kind) {
  return kind == ResultKind::kBenchmark ? "runs" : "draws";
}

const std::vector<ComparedMetric>& metrics_of(ResultKind kind) {
  static const std::vector<ComparedMetric> kPaths{
      {"margin_p05", "margin, 5 % of soils", "", Better::kMore, "margin_p05_ci95"},
      {"margin_p50", "margin, median of soils", "", Better::kMore, "margin_p50_ci95", true},
      {"probability_feasible", "probability", "", Better::kMore, "probability_feasible_ci95"},
      {"margin_min", "margin, mean soils", "", Better::kMore},
      {"duration_s", "time", "s", Better::kLess},
      {"length_m", "length", "m", Better::kLess},
      {"energy_j", "energy", "J", Better::kLess}};
  static const std::vector<ComparedMetric> kPlanners{
      {"verified_share", "share of runs verified", "", Better::kMore, "verified_share_ci95", true},
      {"overturned_share", "share of runs overturned", "", Better::kLess, "overturned_share_ci95",
       true},
      {"time_median_s", "search time, median", "s", Better::kLess, "time_median_s_ci95", true},
      {"duration_median_s", "duration, median", "s", Better::kLess, "duration_median_s_ci95", true},
      {"length_median_m", "length, median", "m", Better::kLess, "length_median_m_ci95", true},
      {"energy_median_j", "energy, median", "J", Better::kLess, "energy_median_j_ci95", true},
      {"margin_median", "margin, median", "", Better::kMore, "margin_median_ci95", true}};
  return kind == ResultKind::kBenchmark ? kPlanners : kPaths;
}

ComparedResult read_compared_result(const std::filesystem::path& folder) {
  const auto [file, kind] = file_of(folder);
  ComparedResult result{.kind = kind, .file = file, .inputs = Json::object()};
  try {
    const Json json = read_json(file);
    result.version = json.at("version").get<std::string>();
    result.status = json.value("status", "");
    read_entries(json, result);
  } catch (const Json::exception&) {
    throw InputError(
        fmt::format("{}: is not as {} writes it; remedy: make it again with this version",
                    file.string(), name(kind)));
  }
  return result;
}

}  // namespace regoplan
