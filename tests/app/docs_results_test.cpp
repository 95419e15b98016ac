// Every key and column that the program writes stands in docs/. The keys are those of the writers
// themselves, given results that have something of everything.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "app/benchmark/benchmark_files.h"
#include "app/compare/comparison.h"
#include "app/diagnose/diagnosis_files.h"
#include "app/evaluate/evaluation_files.h"
#include "app/map/map_summary.h"
#include "app/plan/plan_files.h"
#include "app/wheel/wheel_rows.h"
#include "maps/terrain_summary.h"
#include "tests/app/diagnosis_fixture.h"
#include "tests/app/documents.h"
#include "tests/app/drive_fixture.h"
#include "tests/app/plan_report_fixture.h"
#include "tests/benchmarking/made_up_runs.h"
#include "tests/terramech/wheel_specs.h"

namespace regoplan {
namespace {

using Json = nlohmann::json;
using Keys = std::set<std::string>;

/// Keys whose values have names of things for keys: of columns, channels, soils, parameters.
const Keys kNamesOfThings{
    "region", "parameters", "conditions",         "fit",      "soil",
    "soils",  "scenarios",  "manoeuvre_vehicles", "planners", "smallest_detectable",
    "wheels"};

void add_keys(const Json& json, Keys& keys, bool names_of_things = false) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      if (!names_of_things) keys.insert(key);
      if (key != "settings") add_keys(value, keys, kNamesOfThings.contains(key));
    }
  } else if (json.is_array()) {
    for (const Json& item : json) add_keys(item, keys);
  }
}

Keys keys_of(const std::string& text) {
  Keys keys;
  add_keys(Json::parse(text), keys);
  return keys;
}

/// The columns of a table.
Keys columns_of(const std::string& table) {
  Keys columns;
  std::stringstream header(table.substr(0, table.find('\n')));
  for (std::string column; std::getline(header, column, ',');) columns.insert(column);
  return columns;
}

TEST(DocsOfResults, HoldEveryKeyOfPlanJson) {
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const PlanResult result = report_test_result(problem);
  const Json plan = Json::parse(plan_json(problem, result));
  ASSERT_FALSE(plan.at("candidates").empty());
  ASSERT_FALSE(plan.at("overturned").empty());
  ASSERT_FALSE(plan.at("what_ifs").empty());
  ASSERT_FALSE(plan.at("relaxed").empty());
  EXPECT_EQ(undocumented(keys_of(plan.dump()), {"plan-json.md", "scenario.md"}), Keys{});
  Keys settings;
  add_keys(plan.at("settings"), settings);
  EXPECT_EQ(undocumented(settings, {"scenario.md", "vehicle-and-soil.md"}), Keys{});
  EXPECT_EQ(
      undocumented(columns_of(candidate_csv(problem, result.candidates.front())), {"plan-json.md"}),
      Keys{});
}

TEST(DocsOfResults, HoldEveryKeyOfEvaluationJson) {
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  PathEvaluation evaluation{.name = "path", .refusal = Refusal{.reason = Rejection::kSlope}};
  evaluation.cornering_limit = CorneringLimit{.wheel = "front_left", .fold_n = 1};
  evaluation.spread = SoilSpread{.influences = {{.soil = "mare", .parameter = "kphi"}}};
  const EvaluatedPath given{.evaluation = evaluation, .recorded_margin_min = 0.5};
  const EvaluatedPath manoeuvre{
      .evaluation = evaluation, .plane = ManoeuvrePlane{}, .recorded_margin_min = {}};
  const std::string text = evaluation_json(problem, {.paths = {given, manoeuvre}, .settings = {}});
  EXPECT_EQ(undocumented(keys_of(text), {"evaluation-json.md", "plan-json.md"}), Keys{});
  Keys settings;
  add_keys(Json::parse(text).at("settings"), settings);
  EXPECT_EQ(undocumented(settings, {"evaluation-json.md", "scenario.md", "vehicle-and-soil.md"}),
            Keys{});
}

TEST(DocsOfResults, HoldEveryKeyAndColumnOfADrive) {
  const PlanningProblem problem = report_test_problem(report_test_map(40));
  const DriveRecord drive = made_up_drive(problem, 20);
  EXPECT_EQ(undocumented(keys_of(drive_json(drive, problem)), {"drive.md"}), Keys{});
  EXPECT_EQ(undocumented(keys_of(truth_json(drive, TrueWorld(problem, {}))), {"drive.md"}), Keys{});
  Keys columns;
  for (std::string column : columns_of(drive_csv(drive, problem.vehicle))) {
    for (const WheelMount& wheel : problem.vehicle.wheels) {
      column = std::regex_replace(column, std::regex("_" + wheel.name + "_"), "_<wheel>_");
    }
    columns.insert(column);
  }
  EXPECT_GE(columns.size(), 11U);
  EXPECT_EQ(undocumented(columns, {"drive.md"}), Keys{});
}

TEST(DocsOfResults, HoldEveryKeyOfDiagnosisJson) {
  Keys keys = keys_of(diagnosis_json(claimed_diagnosis()));
  keys.merge(keys_of(diagnosis_json(consistent_diagnosis())));
  keys.merge(keys_of(diagnosis_json(unexplained_diagnosis())));
  for (const char* list : {"mechanisms", "next_experiment", "where", "ranking"}) {
    EXPECT_FALSE(Json::parse(diagnosis_json(claimed_diagnosis())).at(list).empty()) << list;
  }
  EXPECT_EQ(undocumented(keys, {"diagnosis.md"}), Keys{});
}

/// The keys that a schema allows: of its properties, and of theirs.
void add_schema_keys(const Json& json, Keys& keys) {
  if (json.is_array() || json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      if (key == "properties") {
        for (const auto& property : value.items()) keys.insert(property.key());
      }
      add_schema_keys(value, keys);
    }
  }
}

/// What the program writes is held to its schema, which allows no further keys.
Keys keys_of_schema(const std::string& name) {
  Keys keys;
  add_schema_keys(Json::parse(page("docs/schemas/" + name + ".schema.json")), keys);
  return keys;
}

TEST(DocsOfResults, HoldEveryKeyOfLoopJsonAndOfMechanisms) {
  EXPECT_EQ(undocumented(keys_of_schema("loop"), {"demo.md", "drive.md", "drive-diagnosis.md"}),
            Keys{});
  EXPECT_EQ(undocumented(keys_of_schema("mechanisms"), {"mechanisms.md"}), Keys{});
}

TEST(DocsOfResults, HoldEveryKeyOfDiagnosisJsonOfDrives) {
  const Keys keys = keys_of_schema("drive-diagnosis");
  for (const char* key : {"kind", "sigmas", "starts_ci95_s", "next_drive", "noise_floor"}) {
    EXPECT_TRUE(keys.contains(key)) << key;
  }
  EXPECT_EQ(undocumented(keys, {"drive-diagnosis.md"}), Keys{});
}

TEST(DocsOfResults, HoldEveryKeyOfBenchmarkJson) {
  JournalContents journal{.origins = {made_up_origin()}, .runs = {}};
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {  // fewer are not compared
    for (const char* planner : {"RRT", "SST"}) {
      journal.runs.push_back(verified_run("a", planner, seed, 1.5, 30));
    }
  }
  const std::string text = benchmark_json({.journal = journal});
  ASSERT_FALSE(Json::parse(text).at("comparisons").empty());
  EXPECT_EQ(undocumented(keys_of(text), {"benchmark.md"}), Keys{});
  Keys settings;
  add_keys(Json::parse(text).at("settings"), settings);
  EXPECT_EQ(undocumented(settings, {"benchmark.md"}), Keys{});
}

TEST(DocsOfResults, HoldEveryKeyOfComparisonJson) {
  for (const ResultKind kind : {ResultKind::kPlan, ResultKind::kBenchmark}) {
    ComparedResult a{.kind = kind, .asked = {{"limits", 1}}, .inputs = nlohmann::ordered_json()};
    a.entries = {{.name = "one"}};
    a.entries.front().values.assign(metrics_of(kind).size(), 0.5);
    ComparedResult b = a;
    b.asked["limits"] = 2;
    const Comparison comparison = compared(a, b);
    ASSERT_FALSE(comparison.settings.empty());
    EXPECT_EQ(undocumented(keys_of(comparison_json(a, b, comparison).dump()), {"compare.md"}),
              Keys{});
  }
}

TEST(DocsOfResults, HoldEveryKeyOfAMapsSummary) {
  const std::string text = summary_json(summarize(report_test_map(40)), true).dump();
  EXPECT_EQ(undocumented(keys_of(text), {"map.md"}), Keys{});
}

TEST(DocsOfResults, HoldEveryColumnAndStatusOfTheWheel) {
  std::istringstream rows("load_n,slip_ratio,slip_angle_deg\n60,0.2,5\n");
  std::ostringstream table;
  compute_wheel_rows(rows, "rows.csv", WheelModel(wheel_specs::ishigami2007()), {.csv = &table},
                     {});
  Keys names = columns_of(table.str());
  for (int i = 0; i <= static_cast<int>(WheelStatus::kOutsideCorrection); ++i) {
    names.emplace(name(static_cast<WheelStatus>(i)));
  }
  EXPECT_EQ(undocumented(names, {"wheel.md"}), Keys{});
}

TEST(DocsOfResults, HoldEveryReasonForARejection) {
  Keys reasons;
  for (int i = 0; i < kRejectionCount; ++i) reasons.emplace(name(static_cast<Rejection>(i)));
  EXPECT_EQ(undocumented(reasons, {"plan-json.md"}), Keys{});
}

/// The pages of the tree that people read.
std::vector<std::filesystem::path> all_pages() {
  std::vector<std::filesystem::path> pages;
  for (const auto& entry : std::filesystem::directory_iterator(".")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  for (const char* folder :
       {"app", "benchmarking", "benchmarks", "diagnosis", "docs", "drive_diagnosis", "driving",
        "maps", "planner", "python", "scenarios", "terramech", "tests"}) {
    for (auto entry = std::filesystem::recursive_directory_iterator(folder);
         entry != std::filesystem::recursive_directory_iterator(); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (entry->path().extension() == ".md") pages.push_back(entry->path());
    }
  }
  return pages;
}

/// The anchors that a repository browser gives to a page's headings.
Keys anchors_of(const std::filesystem::path& file) {
  Keys anchors;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("#")) continue;
    std::string anchor;
    for (const char c : line.substr(line.find_first_not_of("# "))) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      } else if (c == ' ') {
        anchor += '-';
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

TEST(Docs, EveryLinkLeadsSomewhere) {
  static const std::regex link(R"(\]\(([^)\s#]*)(?:#([^)\s]*))?\))");
  std::size_t links = 0;
  for (const std::filesystem::path& file : all_pages()) {
    const std::string text = page(file);
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const std::string target = (*at)[1].str(), anchor = (*at)[2].str();
      if (target.find("://") != std::string::npos) continue;
      const std::filesystem::path to = target.empty() ? file : file.parent_path() / target;
      EXPECT_TRUE(std::filesystem::exists(to)) << file << ": " << target;
      if (!anchor.empty()) {
        EXPECT_TRUE(anchors_of(to).contains(anchor)) << file << ": " << target << "#" << anchor;
      }
      ++links;
    }
  }
  EXPECT_GT(links, 50u);
}

/// The tests that there are, `Suite.Name`, and `Suite.*` of each suite.
Keys all_tests() {
  static const std::regex begins(R"(\nTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\))");
  Keys tests;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string source = page(entry.path());
    for (std::sregex_iterator at(source.begin(), source.end(), begins), end; at != end; ++at) {
      tests.insert((*at)[1].str() + "." + (*at)[2].str());
      tests.insert((*at)[1].str() + ".*");
    }
  }
  return tests;
}

TEST(Docs, EveryTestThatTheyNameIsThere) {
  // `Suite.Name`; after it `.Name`, of the same suite.
  static const std::regex named(R"(`([A-Z]\w*)?\.([A-Z]\w*|\*)`)");
  const Keys tests = all_tests();
  std::size_t found = 0;
  for (const std::filesystem::path& file : all_pages()) {
    const std::string text = page(file);
    std::string suite;
    for (std::sregex_iterator at(text.begin(), text.end(), named), end; at != end; ++at) {
      if ((*at)[1].matched) suite = (*at)[1].str();
      const std::string test = suite + "." + (*at)[2].str();
      EXPECT_TRUE(tests.contains(test)) << file << ": " << test;
      ++found;
    }
  }
  EXPECT_GT(found, 50u);
}

}  // namespace
}  // namespace regoplan
