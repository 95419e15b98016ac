#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drive_diagnosis/drive_diagnosis.h"
#include "planner/problem/limits.h"

namespace regoplan {

/// A stretch of a drive of which the planner would say otherwise over the corrected map.
struct VerdictFlip {
  std::size_t drive = 0;
  double starts_s = 0, ends_s = 0;
  double x_m = 0, y_m = 0;    ///< in the middle of its first window
  std::string before, after;  ///< why it may not be driven; empty: it may
};

/// Judges what was driven in each window, at stations half a metre apart (places and headings;
/// speed and curvature are the window's), as `plan` and `evaluate` judge a state, over the map and
/// vehicle as they were known and as the drives correct them: a window may be driven where every
/// station keeps the limits at the soils' means, and the one with the smallest margin keeps the
/// margins in as many of 40 draws of the soils as are counted on (95 %, or the limits'
/// probability). Windows that follow each other and flip alike are one stretch. Standing windows
/// and those off the map are left out. Threads change no result. \pre the setup has a vehicle, the
/// diagnosis its effects
std::vector<VerdictFlip> verdict_flips(const DriveSetup& setup, const Limits& limits,
                                       const DriveDiagnosis& diagnosis, std::uint64_t seed,
                                       int threads);

}  // namespace regoplan
