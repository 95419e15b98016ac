#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <istream>
#include <memory>
#include <optional>

#include "app/command/command.h"
#include "app/command/plan_options.h"
#include "app/io/interrupt.h"
#include "app/io/polled_input.h"
#include "app/io/staged_files.h"
#include "app/settings/model_settings.h"
#include "app/wheel/wheel_figures.h"
#include "app/wheel/wheel_rows.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

struct WheelOptions {
  std::string conditions;
  std::string model;
  std::optional<std::filesystem::path> out;
  ResultFolder folder;  ///< its `force` only
  std::optional<std::filesystem::path> figures;
  bool json = false;
  bool quiet = false;
};

ExitStatus write_figures(const WheelOptions& options) {
  StagedFiles staged({*options.figures, options.folder.force, "--figures"});
  for (const RenderedFile& file : render_wheel_figures()) staged.write(file);
  staged.commit();
  notify(fmt::format("figures 6, 7 and 10 (.svg, .csv) are in {}", options.figures->string()),
         options.quiet);
  return kYes;
}

/// Where the table goes; a folder that does not exist is a slip of the hand here.
ResultFolder out_folder(const WheelOptions& options) {
  if (!options.out) return {};
  ResultFolder folder{std::filesystem::absolute(*options.out).parent_path(), options.folder.force};
  if (!std::filesystem::exists(folder.path)) {
    throw InputError(fmt::format("--out: the folder {} does not exist", folder.path.string()));
  }
  return folder;
}

ExitStatus run_wheel(const WheelOptions& options) {
  if (options.figures) return write_figures(options);
  if (options.conditions.empty() || options.model.empty()) {
    throw InputError("CONDITIONS.csv and --model FILE.yaml are needed, or --figures DIR");
  }
  const ModelSettings settings = read_model_file(options.model);
  const WheelModel model(settings.spec);
  if (!std::filesystem::exists(options.conditions)) {
    throw InputError(options.conditions + ": no such file");
  }
  if (std::filesystem::is_directory(options.conditions)) {
    throw InputError(options.conditions + ": cannot be read");
  }
  const ResultFolder folder = out_folder(options);
  if (options.out && std::filesystem::exists(*options.out) &&
      std::filesystem::equivalent(*options.out, options.conditions)) {
    throw InputError("--out: " + options.conditions + " would overwrite its own input");
  }

  for (const std::string& warning : settings.warnings) notify(warning, options.quiet);
  const std::stop_token stop = stop_on_interrupt();
  PolledInput input(options.conditions, stop);
  std::istream conditions(&input);
  std::optional<StagedFiles> staged;
  std::ofstream out;
  WheelRowSinks sinks{.json = options.json ? &std::cout : nullptr};
  if (options.out) {
    staged.emplace(folder);
    out.open(staged->path(options.out->filename().string()), std::ios::binary);
    sinks.csv = &out;
  } else if (!options.json) {
    sinks.csv = &std::cout;
  }
  WheelRowsResult result;
  try {
    result = compute_wheel_rows(conditions, options.conditions, model, sinks, stop);
  } catch (const InputError&) {
    if (stop.stop_requested()) return kInterrupted;  // in the middle of a line
    throw;
  }
  if (staged) {
    out.close();
    if (!out) throw InputError(options.out->string() + ": cannot be written (disk full?)");
    staged->commit();
  }
  if (!result.renamed.empty()) {
    notify(fmt::format("{}: measured columns are kept as {}; the model writes their names",
                       options.conditions, fmt::join(result.renamed, ", ")),
           options.quiet);
  }
  if (result.interrupted) {
    notify(fmt::format("rows until then: {}", result.rows), options.quiet);
    return kInterrupted;
  }
  return kYes;
}

}  // namespace

Command add_wheel_command(CLI::App& program) {
  const auto options = std::make_shared<WheelOptions>();
  CLI::App* parser = program.add_subcommand(
      "wheel",
      "Forces of one wheel for each row of a table.\n"
      "Rows keep their columns and get fx_n, fy_n, torque_nm, sinkage_m, fc_n, fb_n, status;\n"
      "where no sinkage carries the load, status says so and the other cells are empty.");
  CLI::Option* conditions = parser->add_option("CONDITIONS.csv", options->conditions,
                                               "with columns load_n, slip_ratio, slip_angle_deg");
  CLI::Option* model =
      parser->add_option("--model", options->model, "model, wheel, gravity_mps2, soil")
          ->type_name("FILE.yaml");
  CLI::Option* out =
      parser->add_option("--out", options->out, "where the table goes; default: standard output")
          ->type_name("OUT.csv");
  add_force_flag(*parser, options->folder);
  add_output_flags(*parser, options->json, options->quiet);
  // Figures are no table: what says where or how a table goes would be left unheard.
  parser
      ->add_option("--figures", options->figures,
                   "instead: Figs. 6, 7 and 10 of the paper as SVG and CSV")
      ->type_name("DIR")
      ->excludes(conditions)
      ->excludes(model)
      ->excludes(out)
      ->excludes(parser->get_option("--json"));
  return {parser, [options] { return run_wheel(*options); }};
}

}  // namespace regoplan
