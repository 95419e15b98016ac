#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/diagnosis/case_results.h"

namespace regoplan::challenge {

/// A share that a campaign measures, against its target.
struct Measure {
  std::string stratum, what;
  int hits = 0, trials = 0;
  double target = 0;
  bool at_most = false;  ///< the target is a ceiling
  double share() const { return trials == 0 ? 0 : static_cast<double>(hits) / trials; }
  bool met() const { return trials > 0 && (at_most ? share() <= target : share() >= target); }
};

/// The measures of one method over all results.
std::vector<Measure> measures(const std::vector<CaseResult>& results, const std::string& method);

/// Tables for a person: measures with Wilson's intervals beside the baselines', held-out errors,
/// reliability, confusion, every case that went wrong.
std::string summary_markdown(const std::vector<CaseResult>& results, const std::string& label);

/// The same figures for programs.
nlohmann::json summary_json(const std::vector<CaseResult>& results, const std::string& label);

}  // namespace regoplan::challenge
