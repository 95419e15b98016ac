#pragma once

#include <string>

#include "benchmarking/run_journal.h"

namespace regoplan {

/// A verified run with the given search time and path length.
inline RunRecord verified_run(const std::string& experiment, const std::string& planner,
                              std::uint64_t seed, double time_s, double length_m) {
  return {.key = {.experiment = experiment, .planner = planner, .seed = seed},
          .outcome = {.settings = {{"goal_bias", "0.1"}},
                      .properties = {{"time REAL", std::to_string(time_s)},
                                     {"path length m REAL", std::to_string(length_m)},
                                     {"status ENUM", "6"},
                                     {"verified BOOLEAN", "1"},
                                     {"random seed INTEGER", std::to_string(seed)}},
                      .progress_names = {"time REAL", "best cost REAL"},
                      .progress = {{"0.05", "30"}, {"0.1", "25"}, {"0.1", "24"}},
                      .path = {{0, 0, 0.5}, {1, 2, 0.4}}}};
}

inline JournalOrigin made_up_origin() {
  return {.suite = "made_up",
          .bounds = {.time_s = 2,
                     .iterations = std::nullopt,
                     .memory_mb = 512,
                     .progress_interval_s = 0.05,
                     .soil_draws = 10},
          .version = "1",
          .host = "here",
          .cpu = "one",
          .started = "2026-01-01 00:00:00",
          .scenarios = {{"a", "11"}, {"b", "22"}},
          .planners = {{.label = "RRT", .planner = "RRT", .parameters = {}},
                       {.label = "SST", .planner = "SST", .parameters = {}}}};
}

}  // namespace regoplan
