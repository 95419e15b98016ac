#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "benchmarking/run_record.h"
#include "benchmarking/suite.h"

namespace regoplan {

/// Where and under what a part of a journal was written.
struct JournalOrigin {
  std::string suite;
  RunBounds bounds;
  std::string version;
  std::string host;
  std::string cpu;
  std::string started;                           ///< UTC, `2026-11-20 09:44:17`
  std::map<std::string, std::string> scenarios;  ///< label: digest of what it read
  std::vector<SuitePlanner> planners;
  std::optional<Shard> shard = {};  ///< unknown of journals from before they told it
};

/// Everything that a journal holds.
struct JournalContents {
  std::vector<JournalOrigin> origins;
  std::vector<RunRecord> runs;  ///< each run once, by key
};

/// A journal's name in its folder.
inline constexpr const char* kJournalName = "runs.jsonl";

/// The runs of a suite that have ended, in the file `runs.jsonl` of a folder: a line each, on the
/// disk before `append` returns. A line that was cut short, by a kill or a full disk, counts as
/// never begun.
class RunJournal {
 public:
  /// Opens the journal of a folder, made where it is missing, for this process alone.
  /// \throws InputError where it cannot be opened, another process has it, or it holds runs under
  /// other bounds, or of other planners or scenarios under the same labels
  RunJournal(const std::filesystem::path& folder, const JournalOrigin& origin);
  ~RunJournal();
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;

  bool holds(const RunKey& key) const { return keys_.contains(key); }
  std::size_t size() const { return keys_.size(); }

  /// \throws InputError where it cannot be written; the journal is then as before
  void append(const RunRecord& run);

 private:
  void append_line(const std::string& line);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::set<RunKey> keys_;
};

/// \throws InputError where the folder has no journal, or one with a line that no journal writes
JournalContents read_journal(const std::filesystem::path& folder);

/// The runs of several journals, each once. The first of two that hold the same run counts.
/// \throws InputError where they were written under different bounds, planners or scenarios
JournalContents merged(const std::vector<JournalContents>& parts);

/// The runs that `contents` lacks: of every experiment that it has a run of, those of a planner
/// with a seed that other runs have. None where a whole suite has ended.
std::vector<RunKey> missing_runs(const JournalContents& contents);

/// The shards, from 1, that no part of `contents` is; none where its parts do not tell, or are of
/// different counts.
std::vector<Shard> missing_shards(const JournalContents& contents);

/// The file of a journal that holds `contents`.
std::string journal_text(const JournalContents& contents);

}  // namespace regoplan
