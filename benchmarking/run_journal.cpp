#include "benchmarking/run_journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "terramech/basics/input_error.h"

namespace regoplan {
namespace {

nlohmann::json to_json(const JournalOrigin& origin) {
  nlohmann::json planners = nlohmann::json::array();
  for (const SuitePlanner& planner : origin.planners) {
    planners.push_back({{"label", planner.label},
                        {"planner", planner.planner},
                        {"parameters", planner.parameters}});
  }
  const RunBounds& bounds = origin.bounds;
  nlohmann::json shard;
  if (origin.shard) shard = {{"index", origin.shard->index}, {"count", origin.shard->count}};
  return {{"suite", origin.suite},
          {"time_s", bounds.time_s},
          {"iterations", bounds.iterations ? nlohmann::json(*bounds.iterations) : nullptr},
          {"memory_mb", bounds.memory_mb},
          {"progress_interval_s", bounds.progress_interval_s},
          {"soil_draws", bounds.soil_draws},
          {"version", origin.version},
          {"host", origin.host},
          {"cpu", origin.cpu},
          {"started", origin.started},
          {"scenarios", origin.scenarios},
          {"planners", planners},
          {"shard", shard}};
}

JournalOrigin origin_of(const nlohmann::json& json) {
  JournalOrigin origin{.suite = json.at("suite"),
                       .bounds = {.time_s = json.at("time_s"),
                                  .iterations = std::nullopt,
                                  .memory_mb = json.at("memory_mb"),
                                  .progress_interval_s = json.at("progress_interval_s"),
                                  .soil_draws = json.at("soil_draws")},
                       .version = json.at("version"),
                       .host = json.at("host"),
                       .cpu = json.at("cpu"),
                       .started = json.at("started"),
                       .scenarios = json.at("scenarios"),
                       .planners = {}};
  if (!json.at("iterations").is_null()) origin.bounds.iterations = json.at("iterations");
  for (const auto& planner : json.at("planners")) {
    origin.planners.push_back({.label = planner.at("label"),
                               .planner = planner.at("planner"),
                               .parameters = planner.at("parameters")});
  }
  if (const auto shard = json.find("shard"); shard != json.end() && !shard->is_null()) {
    origin.shard = {.index = shard->at("index"), .count = shard->at("count")};
  }
  return origin;
}

/// \throws InputError where the two cannot stand in one journal
void require_compatible(const JournalOrigin& a, const JournalOrigin& b, const std::string& where) {
  const auto differ = [&](const std::string& what) {
    throw InputError(fmt::format(
        "{}: holds runs with another {}; take another folder for the results", where, what));
  };
  if (a.suite != b.suite) differ("suite name");
  if (!(a.bounds == b.bounds)) differ("time, iteration or memory limit, interval or soil draws");
  for (const SuitePlanner& planner : a.planners) {
    for (const SuitePlanner& other : b.planners) {
      if (planner.label == other.label && !(planner == other)) differ("planner " + planner.label);
    }
  }
  for (const auto& [label, digest] : a.scenarios) {
    const auto other = b.scenarios.find(label);
    if (other != b.scenarios.end() && other->second != digest) differ("scenario " + label);
  }
}

struct ParsedJournal {
  JournalContents contents;
  std::uintmax_t whole_bytes = 0;  ///< up to the end of the last whole line
};

ParsedJournal parse(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  std::stringstream text;
  text << stream.rdbuf();
  const std::string all = text.str();
  ParsedJournal parsed;
  std::set<RunKey> seen;
  std::size_t line_start = 0;
  for (int line = 1; line_start < all.size(); ++line) {
    const std::size_t end = all.find('\n', line_start);
    if (end == std::string::npos) break;
    try {
      const nlohmann::json json =
          nlohmann::json::parse(all.begin() + static_cast<std::ptrdiff_t>(line_start),
                                all.begin() + static_cast<std::ptrdiff_t>(end));
      if (json.contains("origin")) {
        parsed.contents.origins.push_back(origin_of(json.at("origin")));
      } else {
        RunRecord run = run_record_of(json);
        if (seen.insert(run.key).second) parsed.contents.runs.push_back(std::move(run));
      }
    } catch (const nlohmann::json::exception&) {
      throw InputError(fmt::format("{}:{}: no line of a run journal", file.string(), line));
    }
    line_start = end + 1;
    parsed.whole_bytes = line_start;
  }
  return parsed;
}

std::string errno_text() {
  return std::strerror(errno);
}

/// \returns whether the file is this process's. The runs of a benchmark that was just killed hold
/// its file until they, too, have ended: they are waited for.
bool lock(int descriptor) {
  constexpr int kTries = 40;
  for (int i = 0; i < kTries; ++i) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

}  // namespace

RunJournal::RunJournal(const std::filesystem::path& folder, const JournalOrigin& origin)
    : file_(folder / kJournalName) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    throw InputError(fmt::format("{}: cannot be opened ({})", file_.string(), errno_text()));
  }
  try {
    if (!lock(descriptor_)) {
      throw InputError(file_.string() + ": another benchmark is writing to it");
    }
    const ParsedJournal before = parse(file_);
    for (const JournalOrigin& other : before.contents.origins) {
      require_compatible(origin, other, file_.string());
    }
    for (const RunRecord& run : before.contents.runs) keys_.insert(run.key);
    // What a kill cut short goes.
    if (ftruncate(descriptor_, static_cast<off_t>(before.whole_bytes)) != 0 ||
        lseek(descriptor_, 0, SEEK_END) < 0) {
      throw InputError(fmt::format("{}: cannot be written ({})", file_.string(), errno_text()));
    }
    append_line(nlohmann::json{{"origin", to_json(origin)}}.dump());
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

RunJournal::~RunJournal() {
  close(descriptor_);
}

void RunJournal::append(const RunRecord& run) {
  append_line(to_json(run).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  keys_.insert(run.key);
}

void RunJournal::append_line(const std::string& line) {
  const off_t before = lseek(descriptor_, 0, SEEK_END);
  const std::string bytes = line + '\n';
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t n = write(descriptor_, bytes.data() + written, bytes.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    written += static_cast<std::size_t>(n);
  }
  if (written == bytes.size() && fdatasync(descriptor_) == 0) return;
  const std::string why = errno_text();
  const bool restored = ftruncate(descriptor_, before) == 0;
  throw InputError(fmt::format("{}: cannot be written ({}){}", file_.string(), why,
                               restored ? "; the runs before are kept" : ""));
}

JournalContents read_journal(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kJournalName;
  if (!std::filesystem::exists(file)) {
    throw InputError(folder.string() + ": holds no benchmark (runs.jsonl is missing)");
  }
  JournalContents contents = parse(file).contents;
  if (contents.origins.empty()) throw InputError(file.string() + ": is empty");
  return contents;
}

JournalContents merged(const std::vector<JournalContents>& parts) {
  JournalContents all;
  std::set<RunKey> seen;
  for (const JournalContents& part : parts) {
    for (const JournalOrigin& origin : part.origins) {
      for (const JournalOrigin& other : all.origins) {
        require_compatible(origin, other, "one of the folders");
      }
    }
    all.origins.insert(all.origins.end(), part.origins.begin(), part.origins.end());
    for (const RunRecord& run : part.runs) {
      if (seen.insert(run.key).second) all.runs.push_back(run);
    }
  }
  std::sort(all.runs.begin(), all.runs.end(),
            [](const RunRecord& a, const RunRecord& b) { return a.key < b.key; });
  return all;
}

std::vector<RunKey> missing_runs(const JournalContents& contents) {
  std::set<RunKey> held;
  std::set<std::string> experiments, planners;
  std::set<std::uint64_t> seeds;
  for (const JournalOrigin& origin : contents.origins) {
    for (const SuitePlanner& planner : origin.planners) planners.insert(planner.label);
  }
  for (const RunRecord& run : contents.runs) {
    held.insert(run.key);
    experiments.insert(run.key.experiment);
    seeds.insert(run.key.seed);
  }
  std::vector<RunKey> missing;
  for (const std::string& experiment : experiments) {
    for (const std::string& planner : planners) {
      for (const std::uint64_t seed : seeds) {
        const RunKey key{.experiment = experiment, .planner = planner, .seed = seed};
        if (!held.contains(key)) missing.push_back(key);
      }
    }
  }
  return missing;
}

std::vector<Shard> missing_shards(const JournalContents& contents) {
  std::set<int> counts, held;
  for (const JournalOrigin& origin : contents.origins) {
    if (!origin.shard) return {};
    counts.insert(origin.shard->count);
    held.insert(origin.shard->index);
  }
  if (counts.size() != 1) return {};
  std::vector<Shard> missing;
  for (Shard shard{.index = 1, .count = *counts.begin()}; shard.index <= shard.count;
       ++shard.index) {
    if (!held.contains(shard.index)) missing.push_back(shard);
  }
  return missing;
}

std::string journal_text(const JournalContents& contents) {
  std::string text;
  const auto add_line = [&](const nlohmann::json& line) {
    text += line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
  };
  for (const JournalOrigin& origin : contents.origins) add_line({{"origin", to_json(origin)}});
  for (const RunRecord& run : contents.runs) add_line(regoplan::to_json(run));
  return text;
}

}  // namespace regoplan
