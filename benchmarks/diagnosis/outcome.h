#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace regoplan::challenge {

struct OutcomeClaim {
  std::vector<std::string> ids;  ///< the name, then those that the data cannot tell apart from it
  double probability = 0;
};

struct OutcomeFit {
  std::string channel;
  double noise_floor = 0, calibrated_rmse = 0, corrected_rmse = 0;  ///< on held-out conditions
};

/// What a method said of one recording, as far as it is scored.
struct Outcome {
  std::string method;   ///< "diagnosis" or a baseline
  std::string verdict;  ///< as in diagnosis.json; "failed"
  std::vector<OutcomeClaim> claims;
  std::vector<OutcomeFit> fit;
  std::size_t rows = 0;
  double largest_angle_from_deg = 0;    ///< of the located regions: where the outermost one begins
  std::vector<std::string> located_in;  ///< columns of the located regions
  std::vector<std::string> further_sensors;  ///< that the next experiments ask for
  double share_explained = 0;
  double p_before = 1, p_after = 1;
  std::string tests;  ///< of the diagnosis: what they say of the calibrated model
  double best_gain_nats = 0, log_odds = 0;  ///< as NameSupport has them
  double seconds = 0;                       ///< of the processor
  std::string sentence;
  std::vector<std::string> notes;
};

Outcome outcome_of(const Diagnosis& diagnosis, std::size_t rows, double seconds);

nlohmann::json outcome_json(const Outcome& outcome);
Outcome outcome_from(const nlohmann::json& json);

}  // namespace regoplan::challenge
