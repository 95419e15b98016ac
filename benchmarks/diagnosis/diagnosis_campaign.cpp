// Runs the diagnosis on sealed challenges of every stratum, each in a process of its own, and sets
// what it said against the truth. Killed and started again it goes on where it was.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <fstream>
#include <map>

#include "benchmarks/diagnosis/campaign_summary.h"
#include "benchmarks/diagnosis/case_process.h"
#include "terramech/basics/input_error.h"

namespace {

using namespace regoplan;
using namespace regoplan::challenge;

volatile std::sig_atomic_t interrupted = 0;

/// Tells builds apart, so that results of two are never mixed.
std::string fingerprint(const std::filesystem::path& program) {
  std::ifstream in(program, std::ios::binary);
  std::uint64_t x = 0xcbf29ce484222325ULL;
  for (std::istreambuf_iterator<char> at(in), end; at != end; ++at) {
    x = (x ^ static_cast<unsigned char>(*at)) * 0x100000001b3ULL;
  }
  return fmt::format("{:016x}", x);
}

std::string text_of(const CaseKey& key) {
  return fmt::format("{}-{:03}", name(key.stratum), key.index);
}

struct Plan {
  std::string out = "diagnosis-campaign";
  std::uint64_t seed = 20260101;
  std::uint64_t nulls = 150, others = 42;
  std::vector<std::string> only;
  int jobs = 2;
  bool baselines = true;
};

/// In turn over the strata, so that an interrupted campaign has some of each.
std::vector<CaseKey> keys_of(const Plan& plan) {
  std::vector<CaseKey> keys;
  for (std::uint64_t index = 0; index < std::max(plan.nulls, plan.others); ++index) {
    for (const Stratum stratum : strata()) {
      const std::uint64_t count = is_null(stratum) ? plan.nulls : plan.others;
      const bool wanted =
          plan.only.empty() || std::ranges::count(plan.only, std::string(name(stratum)));
      if (wanted && index < count) keys.push_back({stratum, index});
    }
  }
  return keys;
}

void write_summary(const ResultLog& log, const std::string& label,
                   const std::filesystem::path& out) {
  const std::string text = summary_markdown(log.results(), label);
  std::ofstream(out / "summary.md") << text;
  std::ofstream(out / "summary.json") << summary_json(log.results(), label).dump(2) << '\n';
  fmt::print("{}", text);
}

int campaign(const Plan& plan) {
  for (const std::string& stratum : plan.only) stratum_named(stratum);
  const std::filesystem::path out = plan.out,
                              program = std::filesystem::read_symlink("/proc/self/exe");
  std::filesystem::create_directories(out);
  const std::string label = fmt::format("seed {}, build {}", plan.seed, fingerprint(program));
  ResultLog log(out / "results.jsonl", label);
  const auto folder = [&](const CaseKey& key) { return out / "running" / text_of(key); };
  std::vector<CaseKey> keys = keys_of(plan);
  const std::size_t all = keys.size();
  std::erase_if(keys, [&](const CaseKey& key) { return log.contains(key); });
  std::size_t done = all - keys.size();
  const bool whole = run_series({
      .keys = keys,
      .at_a_time = plan.jobs,
      .command =
          [&](const CaseKey& key) {
            std::vector<std::string> words{program.string(), "case",
                                           "--stratum",      std::string(name(key.stratum)),
                                           "--index",        std::to_string(key.index),
                                           "--seed",         std::to_string(plan.seed),
                                           "--folder",       folder(key).string()};
            if (!plan.baselines) words.emplace_back("--no-baselines");
            return words;
          },
      .ended =
          [&](const CaseKey& key, const std::string& failure) {
            log.append(collect_case(key, plan.seed, failure, folder(key)));
            ++done;
            if (isatty(STDERR_FILENO))
              fmt::print(stderr, "\r{}/{} {:<24}", done, all, text_of(key));
          },
      .stop = [] { return interrupted != 0; },
  });
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\n");
  std::filesystem::remove_all(out / "running");
  write_summary(log, label, out);
  return whole ? 0 : 130;
}

}  // namespace

int main(int argc, char** argv) {
  Plan plan;
  CLI::App app{"Scores the diagnosis on sealed challenges"};
  app.add_option("--out", plan.out, "folder of results and summary")->capture_default_str();
  app.add_option("--seed", plan.seed, "of the challenges")->capture_default_str();
  app.add_option("--nulls", plan.nulls, "null cases")->capture_default_str();
  app.add_option("--others", plan.others, "cases in every other stratum")->capture_default_str();
  app.add_option("--only", plan.only, "these strata only");
  app.add_option("--jobs", plan.jobs, "processes at a time")->capture_default_str();
  app.add_flag("!--no-baselines", plan.baselines, "the diagnosis alone");
  CLI::App* one = app.add_subcommand("case", "one case; what the campaign starts")->group("");
  std::string stratum, folder;
  std::uint64_t index = 0;
  bool baselines = true;
  one->add_option("--stratum", stratum)->required();
  one->add_option("--index", index)->required();
  one->add_option("--seed", plan.seed)->required();
  one->add_option("--folder", folder)->required();
  one->add_flag("!--no-baselines", baselines);
  CLI11_PARSE(app, argc, argv);
  try {
    if (one->parsed()) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);  // a killed campaign leaves nobody behind
      run_case({stratum_named(stratum), index}, plan.seed, baselines, folder);
      return 0;
    }
    std::signal(SIGINT, [](int) { interrupted = 1; });
    std::signal(SIGTERM, [](int) { interrupted = 1; });
    return campaign(plan);
  } catch (const std::exception& error) {
    fmt::print(stderr, "diagnosis_campaign: {}\n", error.what());
    return 1;
  }
}
