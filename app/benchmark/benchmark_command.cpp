#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include "app/benchmark/benchmark_files.h"
#include "app/benchmark/benchmark_main.h"
#include "app/benchmark/benchmark_report.h"
#include "app/command/command.h"
#include "app/command/kept_page_notice.h"
#include "app/command/plan_options.h"
#include "app/command/program_run.h"
#include "app/command/suite_progress_line.h"
#include "app/io/interrupt.h"
#include "app/io/staged_files.h"
#include "app/settings/scenario_settings.h"
#include "app/settings/suite_settings.h"
#include "benchmarking/suite_run.h"

namespace regoplan {
namespace {

struct BenchmarkOptions {
  OwnPlanners own;
  std::string suite;
  ResultFolder out;
  std::string shard = "1/1";
  int processes = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::filesystem::path> parts;
  bool json = false;
  bool quiet = false;
};

/// `I/N`.
Shard shard_of(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
  if (!slash || second.ec != std::errc() || second.ptr != end || shard.count < 1 ||
      shard.index < 1 || shard.index > shard.count) {
    throw InputError(fmt::format("--shard: {} is not valid (allowed: I/N with 1 <= I <= N)", text));
  }
  return shard;
}

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

std::string processor() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (line.starts_with("model name") && colon + 2 < line.size()) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &utc);
  return text;
}

std::vector<std::string> names_of(const OwnPlanners& own) {
  std::vector<std::string> names;
  for (const auto& [name, maker] : own) names.push_back(name);
  return names;
}

/// What is needed of every scenario, read once.
struct ReadScenarios {
  std::map<std::string, std::string> digests;  ///< of all its files, by label
  ScenarioMaps maps;
};

/// Sets every sweep point too, so that bad input shows before the first run.
ReadScenarios read_scenarios(const Suite& suite) {
  ReadScenarios read;
  for (std::size_t i = 0; i < suite.scenarios.size(); ++i) {
    const SuiteScenario& scenario = suite.scenarios[i];
    Scenario whole = read_scenario(scenario.file, {});
    read.digests[scenario.label] = joint_digest(digests_of(whole.inputs));
    PlanningProblem problem = std::move(whole.problem);
    read.maps.emplace(scenario.label, problem.map);
    for (std::size_t point = 0; point < suite.sweep.size(); ++point) {
      problem = at_sweep_point(std::move(problem), suite, i, point);
    }
  }
  return read;
}

JournalOrigin origin_of(const Suite& suite, const ReadScenarios& read, const Shard& shard) {
  return {.suite = suite.name,
          .bounds = suite.bounds,
          .version = REGOPLAN_VERSION,
          .host = host_name(),
          .cpu = processor(),
          .started = utc_now(),
          .scenarios = read.digests,
          .planners = suite.planners,
          .shard = shard};
}

void print_outcome(const SuiteResults& results, const BenchmarkOptions& options) {
  if (options.json) {
    fmt::print("{}", benchmark_json(results));
  } else if (!options.quiet) {
    fmt::print("{}\nreport: {}\n", benchmark_headline(results),
               (options.out.path / "report.html").string());
  }
}

ExitStatus run_benchmark(const BenchmarkOptions& options) {
  if (options.suite.empty() || options.out.path.empty()) {
    throw InputError("SUITE.yaml and --out DIR are needed, or merge");
  }
  const Shard shard = shard_of(options.shard);
  const Suite suite = read_suite(options.suite, names_of(options.own));
  require_results_fit(options.out, benchmark_file_names());
  notify_of_kept_page(options.out, "benchmark", options.quiet);
  const ReadScenarios read = read_scenarios(suite);
  const std::stop_token stop = stop_on_interrupt();
  const auto problem_of = [&suite](std::size_t scenario, std::size_t point) {
    return at_sweep_point(read_scenario(suite.scenarios[scenario].file, {}).problem, suite,
                          scenario, point);
  };
  SuiteSession session{.processes = options.processes, .planners = options.own, .stop = stop};
  require_parameters(suite, problem_of(0, 0), session);
  {
    RunJournal journal(options.out.path, origin_of(suite, read, shard));
    SuiteProgressLine line(options.quiet);
    session.on_progress = [&line](const SuiteProgress& progress) { line.show(progress); };
    run_suite(suite, runs_of(suite, shard), journal, problem_of, session);
  }
  const SuiteResults results{.journal = read_journal(options.out.path),
                             .interrupted = stop.stop_requested()};
  write_benchmark_files(results, read.maps, options.out);
  print_outcome(results, options);
  return results.interrupted ? kInterrupted : kYes;
}

/// What shards that are merged lack of a suite; empty where that is nothing.
std::string lacking_text(const JournalContents& merged) {
  std::vector<std::string> shards;
  for (const Shard& shard : missing_shards(merged)) {
    shards.push_back(fmt::format("{}/{}", shard.index, shard.count));
  }
  const std::string no_folder = fmt::format("no folder is of shard {}", fmt::join(shards, ", "));
  const std::vector<RunKey> runs = missing_runs(merged);
  if (runs.empty()) return shards.empty() ? "" : no_folder;
  const RunKey& first = runs.front();
  return fmt::format("{} of {} runs are missing (the first: {}, {}, seed {}): {}", runs.size(),
                     runs.size() + merged.runs.size(), first.experiment, first.planner, first.seed,
                     shards.empty()
                         ? "a shard has not come to its end; its command goes on from where it was"
                         : no_folder);
}

ExitStatus run_merge(const BenchmarkOptions& options) {
  require_results_fit(options.out, benchmark_file_names());
  notify_of_kept_page(options.out, "benchmark", options.quiet);
  std::vector<JournalContents> parts;
  if (std::filesystem::exists(options.out.path / kJournalName)) {
    throw InputError(options.out.path.string() + ": holds a benchmark already (" + kJournalName +
                     ")");
  }
  for (const std::filesystem::path& part : options.parts) parts.push_back(read_journal(part));
  JournalContents whole = merged(parts);
  const std::string lacking = lacking_text(whole);
  if (!lacking.empty()) notify(lacking, options.quiet);
  const SuiteResults results{.journal = std::move(whole), .interrupted = !lacking.empty()};
  write_benchmark_files(results, {}, options.out);
  // Last, since a folder that holds one is merged.
  StagedFiles journal(options.out);
  journal.write({.name = kJournalName, .content = journal_text(results.journal)});
  journal.commit();
  print_outcome(results, options);
  return kYes;
}

/// The command's options on `parser`, which may be the whole program.
Command benchmark_command(CLI::App& parser, const OwnPlanners& own) {
  const auto options = std::make_shared<BenchmarkOptions>();
  options->own = own;
  parser.add_option("SUITE.yaml", options->suite, "scenarios, planners, seeds, bounds, sweep");
  parser.add_option("--out", options->out.path, "folder for the results")->type_name("DIR");
  parser.add_option("--shard", options->shard, "the I-th of N disjoint parts")
      ->type_name("I/N")
      ->capture_default_str();
  parser.add_option("--processes", options->processes, "runs at once; default: all cores")
      ->type_name("N")
      ->check(whole_in_range({.min = 1, .max = kThreadsMax}));
  add_force_flag(parser, options->out);
  add_network_flag(parser);
  add_output_flags(parser, options->json, options->quiet);

  CLI::App* merge = parser.add_subcommand("merge", "Join the results of shards.");
  merge->add_option("DIR", options->parts, "folders of shards")->required();
  merge->add_option("--out", options->out.path, "folder for the whole")
      ->type_name("DIR")
      ->required();
  add_force_flag(*merge, options->out);
  add_output_flags(*merge, options->json, options->quiet);
  return {&parser, [options, merge] {
            return merge->parsed() ? run_merge(*options) : run_benchmark(*options);
          }};
}

/// \throws InputError for a name that a suite cannot hold, or that means another planner
void require_new_names(const OwnPlanners& own) {
  const std::vector<std::string>& known = planner_names();
  for (const auto& [name, maker] : own) {
    if (std::ranges::find(known, name) != known.end()) {
      throw InputError(name + ": a planner of regoplan has this name already");
    }
    if (!is_label(name)) {
      throw InputError(
          fmt::format("\"{}\" is no name of a planner (allowed: {})", name, kLabelRule));
    }
    if (!maker) throw InputError(name + ": no function that makes it");
  }
}

}  // namespace

Command add_benchmark_command(CLI::App& program) {
  return benchmark_command(
      *program.add_subcommand(
          "benchmark",
          "Run scenarios x planners x seeds through OMPL's benchmark tool.\n"
          "Writes EXPERIMENT.log, benchmark.db, benchmark.json and report.html. "
          "Started again with the\n"
          "same folder after a kill, it goes on where it was."),
      {});
}

int benchmark_main(int argc, const char* const* argv, const OwnPlanners& own) {
  return run_program(argc, argv, [&](CLI::App& program) {
    require_new_names(own);
    const std::vector<std::string> names = names_of(own);
    program.description(
        fmt::format("Run scenarios x planners x seeds of a suite, as `regoplan benchmark` does, "
                    "with planners beside regoplan's: {}.",
                    fmt::join(names, ", ")));
    return std::vector<Command>{benchmark_command(program, own)};
  });
}

}  // namespace regoplan
