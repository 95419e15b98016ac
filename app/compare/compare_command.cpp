#include <fmt/format.h>

#include <memory>

#include "app/command/command.h"
#include "app/command/kept_page_notice.h"
#include "app/command/plan_options.h"
#include "app/compare/comparison_report.h"
#include "app/io/staged_files.h"

namespace regoplan {
namespace {

struct CompareOptions {
  std::filesystem::path a, b;
  ResultFolder folder;
  bool json = false;
  bool quiet = false;
};

/// A number as it is told, with as many digits as say something.
std::string value_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

/// A line for each entry and metric that changed.
std::string changes_text(const ComparedResult& a, const Comparison& comparison) {
  const std::vector<ComparedMetric>& metrics = metrics_of(a.kind);
  std::string text;
  for (const ComparedPair& pair : comparison.pairs) {
    if (!pair.a || !pair.b) {
      text += fmt::format("{}: only in {}\n", pair.name, pair.a ? "A" : "B");
      continue;
    }
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      if (!pair.change[i] || *pair.change[i] == 0) continue;
      text += fmt::format("{}: {} {} -> {} ({:+.3g}){}{}{}\n", pair.name, metrics[i].words,
                          value_text(pair.a->values[i]), value_text(pair.b->values[i]),
                          *pair.change[i], metrics[i].unit.empty() ? "" : " ", metrics[i].unit,
                          pair.tied[i] ? fmt::format(", tied within the {}", sampled(a.kind)) : "");
    }
  }
  return text;
}

std::string asked_text(const Comparison& comparison) {
  std::string text;
  for (const ComparedSetting& one : comparison.settings) {
    text += fmt::format("asked: {} {} -> {}\n", one.key, one.a.dump(), one.b.dump());
  }
  for (const std::string& input : comparison.inputs) text += fmt::format("input: {}\n", input);
  return text;
}

/// The page of a comparison would replace that of a result in the same folder.
void require_other_folder(const CompareOptions& options) {
  for (const std::filesystem::path& result : {options.a, options.b}) {
    std::error_code none;
    const bool is_folder = std::filesystem::is_directory(result, none);
    if (std::filesystem::equivalent(options.folder.path, is_folder ? result : result.parent_path(),
                                    none)) {
      throw InputError(fmt::format("--out: {} holds one of the results (allowed: another folder)",
                                   options.folder.path.string()));
    }
  }
}

void require_named(const char* which, const std::filesystem::path& result) {
  if (result.empty()) throw InputError(fmt::format("{}: empty, names no folder", which));
}

ExitStatus run(const CompareOptions& options) {
  require_named("A", options.a);
  require_named("B", options.b);
  if (!options.folder.path.empty()) {
    require_other_folder(options);
    require_results_fit(options.folder, {"comparison.json", "report.html"});
    notify_of_kept_page(options.folder, "compare", options.quiet);
  }
  const ComparedResult a = read_compared_result(options.a), b = read_compared_result(options.b);
  const Comparison comparison = compared(a, b);
  const std::string json = comparison_json(a, b, comparison)
                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
                           "\n";
  if (!options.folder.path.empty()) {
    StagedFiles staged(options.folder);
    staged.write({"comparison.json", json});
    staged.write({"report.html", comparison_report(a, b, comparison)});
    staged.commit();
  }
  if (options.json) {
    fmt::print("{}", json);
  } else if (!options.quiet) {
    fmt::print("{}\n{}{}", comparison_headline(a, b, comparison), changes_text(a, comparison),
               asked_text(comparison));
    if (!options.folder.path.empty()) {
      fmt::print("report: {}\n", (options.folder.path / "report.html").string());
    }
  }
  return kYes;
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* parser = program.add_subcommand(
      "compare",
      "Say what differs between two plans, two evaluations or two benchmark runs.\n"
      "Prints it, and with --out writes comparison.json and report.html.");
  parser->add_option("A", options->a, "folder that plan, evaluate or benchmark wrote")->required();
  parser->add_option("B", options->b, "another of the same command")->required();
  parser->add_option("--out", options->folder.path, "folder for page and JSON")->type_name("DIR");
  add_force_flag(*parser, options->folder);
  add_output_flags(*parser, options->json, options->quiet);
  return {parser, [options] { return run(*options); }};
}

}  // namespace regoplan
