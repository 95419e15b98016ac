#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace regoplan {

struct CampaignSettings {
  std::filesystem::path out;
  std::filesystem::path scenarios = "benchmarks/scenarios";
  std::vector<std::string> names;  ///< of scenarios; empty: all
  std::vector<std::string> planners{"Lattice", "SST", "RRT", "KPIECE1"};
  int seeds = 10;
  int verified = 1 << 30;
  double time_s = 10;
  std::filesystem::path map;  ///< scenario of the large map
};

/// How soon the lattice has its first path, and whether the path passes verification.
void first_path_campaign(const CampaignSettings& settings);

/// What paths cost after the time, ours beside OMPL's own planners, paired by scenario and seed.
void cost_campaign(const CampaignSettings& settings);

/// Random maps: whether any is certified infeasible that a planner finds a verified path on.
void certificates_campaign(const CampaignSettings& settings);

/// In how many soil draws that the plan has not seen its accepted path keeps the margin.
void coverage_campaign(const CampaignSettings& settings);

/// How long a first path of 500 m takes on a large map, from reading it on.
void large_map_campaign(const CampaignSettings& settings);

}  // namespace regoplan
