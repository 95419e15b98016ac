#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/diagnosis/case_results.h"

namespace regoplan::challenge {

/// What one child process does: writes the truth into a sealed folder, forgets it, lets the
/// diagnosis and the baselines judge recording and setup, and writes their outcomes.
/// Gives up after 180 seconds of the processor: a case that waits its turn, or is suspended, is not
/// late.
/// \param folder of this case alone
void run_case(const CaseKey& key, std::uint64_t seed, bool with_baselines,
              const std::filesystem::path& folder);

/// Opens the sealed truth, which nothing did before, and sets it beside the outcomes. A case whose
/// process failed has one outcome, `failed`.
CaseResult collect_case(const CaseKey& key, std::uint64_t seed, const std::string& failure,
                        const std::filesystem::path& folder);

/// Runs every case in a process of its own, some at a time.
struct CaseSeries {
  std::vector<CaseKey> keys;
  int at_a_time = 2;
  std::function<std::vector<std::string>(const CaseKey&)> command;
  std::function<void(const CaseKey&, const std::string& failure)> ended;
  std::function<bool()> stop;  ///< asked between waits
};

/// \returns false where it was stopped; the children then running are ended
bool run_series(const CaseSeries& series);

}  // namespace regoplan::challenge
