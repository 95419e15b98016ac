#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/diagnosis/challenge.h"
#include "benchmarks/diagnosis/outcome.h"

namespace regoplan::challenge {

/// One case of a campaign, over and done.
struct CaseResult {
  Truth truth;
  std::vector<Outcome> outcomes;  ///< the diagnosis first, then the baselines
};

/// A case of a campaign.
struct CaseKey {
  Stratum stratum = Stratum::kNulls;
  std::uint64_t index = 0;
  auto operator<=>(const CaseKey&) const = default;
};

/// One result a line, only ever appended, whole lines at a time. A line that a crash cut short is
/// dropped on opening, and its case runs again.
class ResultLog {
 public:
  /// \param label what the results depend on (seed, build); kept in the first line
  /// \throws InputError where the file belongs to another label
  ResultLog(std::filesystem::path file, const std::string& label);

  /// Appends and waits for the disk. \throws InputError where the file cannot be written
  void append(const CaseResult& result);

  bool contains(const CaseKey& key) const { return done_.contains(key); }
  const std::vector<CaseResult>& results() const { return results_; }

 private:
  std::filesystem::path file_;
  std::vector<CaseResult> results_;
  std::set<CaseKey> done_;
};

}  // namespace regoplan::challenge
