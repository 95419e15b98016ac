#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

#include "terramech/basics/value_range.h"

namespace regoplan {

/// What a program run ends with.
enum ExitStatus : int {
  kYes = 0,
  kFailure = 1,  ///< bad input
  kNo = 2,
  kInterrupted = 130,  ///< 143 where it was SIGTERM
};

/// A command of the program: its options, and what it does once they are read.
struct Command {
  CLI::App* parser = nullptr;
  std::function<ExitStatus()> run;
};

Command add_plan_command(CLI::App& program);
Command add_evaluate_command(CLI::App& program);
Command add_drive_command(CLI::App& program);
Command add_benchmark_command(CLI::App& program);
Command add_diagnose_command(CLI::App& program);
Command add_wheel_command(CLI::App& program);
Command add_mechanisms_command(CLI::App& program);
Command add_map_make_command(CLI::App& map);
Command add_map_info_command(CLI::App& map);
Command add_map_import_command(CLI::App& map);
Command add_demo_command(CLI::App& program);
Command add_vehicle_command(CLI::App& program);
Command add_soil_command(CLI::App& program);
Command add_scenario_command(CLI::App& program);
Command add_completion_command(CLI::App& program);
Command add_export_command(CLI::App& program);
Command add_compare_command(CLI::App& program);

/// An option takes finite numbers in this range only.
CLI::Validator in_range(const ValueRange& allowed);

/// An option takes whole numbers in this range only, in digits: what CLI11 makes an integer of.
CLI::Validator whole_in_range(const ValueRange& allowed);

/// An option takes a seed only: a whole number that a scenario could hold too.
CLI::Validator a_seed();

/// An option takes one of these words only.
CLI::Validator one_of(std::vector<std::string> words);

/// Prints one line to standard error, whatever stands in it. Where standard error takes nothing,
/// nobody can be told.
void print_line(std::string_view text);

/// Prints a notice to standard error unless `quiet`.
void notify(const std::string& notice, bool quiet);

}  // namespace regoplan
