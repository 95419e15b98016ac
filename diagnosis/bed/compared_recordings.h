#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "diagnosis/bed/condensed_recording.h"
#include "diagnosis/recording/setup.h"

namespace regoplan {

/// A test and its references, read so that they differ in nothing but what was measured.
struct ComparedRecordings {
  Recording recording;  ///< the test, with what is compared of it alone
  CondensedRecording test;
  std::vector<CondensedRecording> references;  ///< in the order given
  std::vector<std::string> notes;              ///< warnings of the test, and what was left out
};

/// Which of the test's channels are not compared, for a person; empty where all are.
/// \param references channels of each
std::string not_compared(const std::vector<Channel>& test,
                         const std::vector<std::vector<Channel>>& references);

/// Keeps the channels that test and references measure, and the passes that a reference drove where
/// the test drove others too. One run is taken to scatter alike on all of them: a recording without
/// replicates takes the scatter of those that have them, and is as sure of it as they are; where
/// all have too few, they tell it together; where they have none, what a smooth difference of both
/// leaves may tell it (`scatter_of_difference`); none is given less scatter than all have together.
/// \throws InputError where a recording has fewer than 3 conditions, or no channel is common;
/// Interrupted
ComparedRecordings read_alike(const Recording& test, const DiagnosisSetup& setup,
                              const std::vector<Reference>& references,
                              const std::stop_token& stop);

}  // namespace regoplan
