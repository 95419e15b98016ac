// Mutated input for every reader: what crashes, hangs or takes more memory than it may is kept.
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "benchmarks/robustness/mutation.h"
#include "benchmarks/robustness/readers.h"
#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string reader = "all";
  fs::path seeds = REGOPLAN_SOURCE_DIR "/benchmarks/robustness/seeds";
  fs::path kept = "robustness-findings";
  std::int64_t runs = 1000000000;
  double seconds = 5;
  std::uint64_t seed = 1;
};

/// What a worker leaves behind, whatever becomes of it.
struct Record {
  std::int64_t runs, taken;
  double slowest_s;
  double memory_mb;
  std::size_t size;
  char input[1 << 17];
};

constexpr unsigned kSecondsARun = 10;
constexpr rlim_t kBytesARun = rlim_t{2} << 30;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

std::vector<std::string> seeds_of(const Reader& reader, const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder / reader.name)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::vector<std::string> seeds;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  if (seeds.empty()) throw InputError((folder / reader.name).string() + ": no seeds");
  return seeds;
}

void read_once(const Reader& reader, const std::string& input, Record& record) {
  record.size = std::min(input.size(), sizeof record.input);
  std::memcpy(record.input, input.data(), record.size);
  alarm(kSecondsARun);
  const Clock::time_point begun = Clock::now();
  record.taken += takes(reader, input) ? 1 : 0;
  record.slowest_s = std::max(record.slowest_s, seconds_since(begun));
  alarm(0);
  ++record.runs;
}

/// Reads until the runs or the time are over; whatever goes wrong ends the process.
[[noreturn]] void work(const Reader& reader, const Options& options, std::uint64_t seed,
                       Record& record, Clock::time_point end) {
  const std::vector<std::string> seeds = seeds_of(reader, options.seeds);
  enter_scratch_folder();
#ifndef REGOPLAN_SANITIZED
  const rlimit limit{kBytesARun, kBytesARun};
  setrlimit(RLIMIT_AS, &limit);
#endif
  for (const std::string& good : seeds) {
    if (!takes(reader, good)) std::fputs("a seed is refused\n", stderr);
  }
  Mutator mutator(seeds, seed);
  while (record.runs < options.runs && Clock::now() < end) {
    read_once(reader, mutator.next(), record);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    record.memory_mb = std::max(record.memory_mb, static_cast<double>(usage.ru_maxrss) / 1024);
  }
  _exit(0);
}

std::string end_of(int status) {
  if (!WIFSIGNALED(status)) return fmt::format("status {}", WEXITSTATUS(status));
  return WTERMSIG(status) == SIGALRM ? fmt::format("took more than {} s", kSecondsARun)
                                     : fmt::format("signal {}", WTERMSIG(status));
}

void keep(const Record& record, const Reader& reader, int number, const fs::path& folder) {
  fs::create_directories(folder);
  std::ofstream(folder / fmt::format("{}-{}", reader.name, number), std::ios::binary)
      .write(record.input, static_cast<std::streamsize>(record.size));
}

/// \returns the number of findings
int campaign(const Reader& reader, const Options& options) {
  constexpr int kFindingsMax = 20;
  auto& record = *static_cast<Record*>(
      mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  const Clock::time_point begun = Clock::now();
  const auto end = begun + std::chrono::duration_cast<Clock::duration>(
                               std::chrono::duration<double>(options.seconds));
  int findings = 0;
  for (bool more = true; more && findings < kFindingsMax;) {
    std::fflush(stdout);
    const pid_t worker = fork();
    // After a finding it goes on with other input, else it would meet the same again.
    const auto seed = options.seed + 1000003U * static_cast<std::uint64_t>(findings);
    if (worker == 0) work(reader, options, seed, record, end);
    int status = 0;
    waitpid(worker, &status, 0);
    std::error_code ignored;
    fs::remove_all(fmt::format("/dev/shm/regoplan-robustness-{}", worker), ignored);
    more = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    if (!more) break;
    keep(record, reader, ++findings, options.kept);
    fmt::print("{:10} finding {}: {}\n", reader.name, findings, end_of(status));
    ++record.runs;
  }
  fmt::print(
      "{:10} {:9} runs, {:5.1f} % taken, {} findings, slowest {:.2f} s, {:4.0f} MB, {:.0f} s\n",
      reader.name, record.runs,
      100 * static_cast<double>(record.taken) /
          static_cast<double>(std::max<std::int64_t>(1, record.runs)),
      findings, record.slowest_s, record.memory_mb, seconds_since(begun));
  munmap(&record, sizeof(Record));
  return findings;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App program("Feeds every reader mutated input.");
  program.add_option("READER", options.reader, "one reader, or all")->capture_default_str();
  program.add_option("--runs", options.runs, "at most, of each reader");
  program.add_option("--seconds", options.seconds, "at most, for each reader")
      ->capture_default_str();
  program.add_option("--seed", options.seed, "of the mutations")->capture_default_str();
  program.add_option("--seeds", options.seeds, "folder of good input");
  program.add_option("--keep", options.kept, "folder for input that something is found with");
  std::string once;
  program.add_option("--once", once, "instead: reads this file once, in this process");
  CLI11_PARSE(program, argc, argv);
  options.kept = fs::absolute(options.kept);
  if (!once.empty()) {
    std::ifstream stream(once, std::ios::binary);
    const std::string input{std::istreambuf_iterator<char>(stream),
                            std::istreambuf_iterator<char>()};
    enter_scratch_folder();
    fmt::print("{}\n", takes(reader_named(options.reader), input) ? "taken" : "refused");
    return 0;
  }
  int findings = 0;
  for (const Reader& reader : readers()) {
    if (options.reader == "all" || options.reader == reader.name) {
      findings += campaign(reader, options);
    }
  }
  return findings == 0 ? 0 : 1;
}

}  // namespace
}  // namespace regoplan

int main(int argc, char** argv) {
  try {
    return regoplan::run(argc, argv);
  } catch (const std::exception& bad) {
    fmt::print(stderr, "{}\n", bad.what());
    return 1;
  }
}
