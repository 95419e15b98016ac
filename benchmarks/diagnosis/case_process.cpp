#include "benchmarks/diagnosis/case_process.h"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include "benchmarks/diagnosis/baselines.h"
#include "benchmarks/diagnosis/challenge_files.h"
#include "terramech/basics/input_error.h"

namespace regoplan::challenge {
namespace {

constexpr rlim_t kLongest_s = 180;

void write_json(const std::filesystem::path& file, const nlohmann::json& json) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << json.dump();
  if (!out.flush()) throw InputError(fmt::format("{}: cannot be written", file.string()));
}

nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

std::filesystem::path sealed_truth(const std::filesystem::path& folder) {
  return folder / "sealed" / "truth.json";
}

/// Of this process: what a diagnosis takes on one thread of a machine that has other work too.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Child {
  pid_t id;
  CaseKey key;
};

pid_t spawn(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0) {
    throw InputError(fmt::format("{}: cannot be started", command[0]));
  }
  return child;
}

std::string said_failure(const std::filesystem::path& folder) {
  std::ifstream in(folder / "failure.txt");
  std::string text;
  std::getline(in, text);
  return text;
}

std::string failure_of(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    return fmt::format("over {} s of the processor", kLongest_s);
  }
  if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) != 0) return fmt::format("exit status {}", WEXITSTATUS(status));
  return "";
}

}  // namespace

void run_case(const CaseKey& key, std::uint64_t seed, bool with_baselines,
              const std::filesystem::path& folder) {
  const rlimit longest{.rlim_cur = kLongest_s, .rlim_max = kLongest_s + 5};
  setrlimit(RLIMIT_CPU, &longest);
  Challenge challenge = generate(key.stratum, seed, key.index);
  write_json(sealed_truth(folder), truth_json(challenge.truth));
  challenge.truth = {};
  const Recording& recording = challenge.recording;
  const double start_s = processor_seconds();
  Diagnosis diagnosis;
  try {
    diagnosis = diagnose(recording, challenge.setup, {.seed = 1, .threads = 1});
  } catch (const std::exception& error) {
    std::ofstream(folder / "failure.txt") << error.what() << '\n';
    throw;
  }
  nlohmann::json outcomes{
      outcome_json(outcome_of(diagnosis, recording.runs.size(), processor_seconds() - start_s))};
  if (with_baselines) {
    for (const Outcome& outcome : baseline_outcomes(recording, challenge.setup)) {
      outcomes.push_back(outcome_json(outcome));
    }
  }
  write_json(folder / "outcomes.json", outcomes);
}

CaseResult collect_case(const CaseKey& key, std::uint64_t seed, const std::string& failure,
                        const std::filesystem::path& folder) {
  CaseResult result;
  if (failure.empty()) {
    for (const auto& json : read_json(folder / "outcomes.json")) {
      result.outcomes.push_back(outcome_from(json));
    }
    result.truth = truth_from(read_json(sealed_truth(folder)));
  } else {
    const std::string said = said_failure(folder);
    result.outcomes = {
        {.method = "diagnosis", .verdict = "failed", .sentence = said.empty() ? failure : said}};
    result.truth = generate(key.stratum, seed, key.index).truth;
  }
  std::filesystem::remove_all(folder);
  return result;
}

bool run_series(const CaseSeries& series) {
  std::vector<Child> running;
  auto next = series.keys.begin();
  while (next != series.keys.end() || !running.empty()) {
    if (series.stop()) {
      for (const Child& child : running) kill(child.id, SIGKILL);
      for (const Child& child : running) waitpid(child.id, nullptr, 0);
      return false;
    }
    while (next != series.keys.end() && static_cast<int>(running.size()) < series.at_a_time) {
      running.push_back({spawn(series.command(*next)), *next});
      ++next;
    }
    for (std::size_t i = 0; i < running.size();) {
      int status = 0;
      if (waitpid(running[i].id, &status, WNOHANG) != running[i].id) {
        ++i;
        continue;
      }
      const Child over = running[i];
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      series.ended(over.key, failure_of(status));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace regoplan::challenge
