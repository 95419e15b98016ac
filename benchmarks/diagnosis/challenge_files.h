#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "benchmarks/diagnosis/challenge.h"

namespace regoplan::challenge {

/// The recording as `regoplan diagnose` reads it.
std::string recording_csv(const Recording& recording);

/// The setup as `regoplan diagnose` reads it.
std::string setup_yaml(const DiagnosisSetup& setup);

/// What is kept apart from both until the diagnosis has ended.
nlohmann::json truth_json(const Truth& truth);
Truth truth_from(const nlohmann::json& json);

}  // namespace regoplan::challenge
