#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/export/nav2_files.h"
#include "app/export/qgis_style.h"
#include "app/settings/earlier_plan.h"
#include "planner/chart/margin_rasters.h"

namespace regoplan {
namespace {

struct ExportOptions {
  std::filesystem::path result;
  ResultFolder nav2{.path = {}, .option = "--nav2"}, qgis{.path = {}, .option = "--qgis"};
  double spacing_m = 2;
  bool json = false;
  bool quiet = false;
};

constexpr const char* kPath = "candidate-1.geojson";
constexpr const char* kMargin = "margin.tif";

std::vector<std::string> names_of(const std::vector<RenderedFile>& files) {
  std::vector<std::string> names;
  for (const RenderedFile& file : files) names.push_back(file.name);
  return names;
}

/// The best path of the result, nothing where it has none.
std::optional<nlohmann::ordered_json> best_path(const std::filesystem::path& result) {
  std::ifstream stream(result / kPath, std::ios::binary);
  if (!stream) return std::nullopt;
  try {
    return nlohmann::ordered_json::parse(stream);
  } catch (const nlohmann::json::exception&) {
    throw InputError((result / kPath).string() + ": is no path that plan wrote");
  }
}

/// The masks are made anew, from the scenario as it is now.
std::vector<std::string> export_nav2(const ExportOptions& options, const EarlierPlan& plan) {
  const Scenario scenario = read_scenario(plan.scenario, plan.overrides);
  for (const std::string& key : changes_since(plan, digests_of(scenario.inputs))) {
    notify(fmt::format("{} has changed since the plan; the masks are of what it is now", key),
           options.quiet);
  }
  std::vector<RenderedFile> files = nav2_masks(scenario.problem, terrain_rasters(scenario.problem));
  if (const auto path = best_path(options.result)) {
    files.push_back(nav2_route(*path, options.spacing_m));
  }
  StagedFiles staged(options.nav2);
  for (const RenderedFile& file : files) staged.write(file);
  staged.commit();
  return names_of(files);
}

/// The plan's own raster, in the colours of the least margin that it was planned with.
std::vector<std::string> export_qgis(const ExportOptions& options, const EarlierPlan& plan) {
  const std::filesystem::path margin = options.result / kMargin;
  if (!std::filesystem::exists(margin)) {
    throw InputError(margin.string() + ": no such file (an infeasible or cut plan has none)");
  }
  StagedFiles staged(options.qgis);
  std::filesystem::copy_file(margin, staged.path(kMargin));
  staged.write({"margin.qml", qgis_margin_style(plan.margin_min)});
  staged.commit();
  return {kMargin, "margin.qml"};
}

ExitStatus run_export(const ExportOptions& options) {
  if (options.nav2.path.empty() && options.qgis.path.empty()) {
    throw InputError("export: --nav2 DIR or --qgis DIR is needed");
  }
  for (const ResultFolder* folder : {&options.nav2, &options.qgis}) {
    if (!folder->path.empty()) require_writable_folder(*folder);
  }
  const std::filesystem::path plan_file = options.result / "plan.json";
  std::error_code none;
  if (!std::filesystem::is_regular_file(plan_file, none)) {
    throw InputError(fmt::format("RESULT: {}: no result of plan (allowed: a folder with plan.json)",
                                 options.result.string()));
  }
  const EarlierPlan plan = read_earlier_plan(plan_file.string());
  nlohmann::ordered_json written = nlohmann::ordered_json::object();
  if (!options.nav2.path.empty()) written["nav2"] = export_nav2(options, plan);
  if (!options.qgis.path.empty()) written["qgis"] = export_qgis(options, plan);
  if (options.json) {
    fmt::print("{}\n", written.dump(2));
  } else if (!options.quiet) {
    for (const auto& [what, files] : written.items()) {
      for (const auto& file : files) fmt::print("{}: {}\n", what, file.get<std::string>());
    }
  }
  return kYes;
}

}  // namespace

Command add_export_command(CLI::App& program) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* parser = program.add_subcommand(
      "export",
      "Write a plan's result for other programs: masks and route for Nav2, a style for QGIS.\n"
      "Takes --nav2, --qgis or both.");
  parser->add_option("RESULT", options->result, "folder that plan wrote")->required();
  parser
      ->add_option("--nav2", options->nav2.path,
                   "keepout and speed masks (PGM, YAML), the best path as route.geojson")
      ->type_name("DIR");
  parser->add_option("--qgis", options->qgis.path, "margin.tif with its colours, margin.qml")
      ->type_name("DIR");
  parser
      ->add_option("--spacing-m", options->spacing_m,
                   "most distance between nodes of the route; default: 2")
      ->type_name("M")
      ->check(in_range({.min = 0.01}));
  parser->add_flag_callback(
      "--force", [options] { options->nav2.force = options->qgis.force = true; },
      "replace files that others wrote or edited as well");
  add_network_flag(*parser);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options] { return run_export(*options); }};
}

}  // namespace regoplan
