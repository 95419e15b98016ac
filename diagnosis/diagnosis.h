#pragma once

/// Diagnosis of single-wheel recordings: what `find_package(regoplan COMPONENTS diagnosis)` gives.
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string_view>

#include "diagnosis/findings/findings.h"
#include "diagnosis/recording/setup.h"

namespace regoplan {

struct DiagnosisOptions {
  std::uint64_t seed = 1;
  int threads = 2;
  /// A request ends the diagnosis within a second with the stages that are complete, marked
  /// interrupted.
  std::stop_token stop = {};
  /// Told what is being done and how much of it is, in [0, 1].
  std::function<void(std::string_view, double)> progress = {};
};

/// Locates where the wheel model and a recording differ, says what physics was left out, models it
/// and shows on held-out conditions how far that goes.
/// \throws InputError for a recording that cannot be judged (fewer than 8 different conditions,
/// all replicates identical, ...)
Diagnosis diagnose(const Recording& recording, const DiagnosisSetup& setup,
                   const DiagnosisOptions& options = {});

}  // namespace regoplan
