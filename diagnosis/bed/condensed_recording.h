#pragma once

#include <string>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"
#include "diagnosis/recording/course.h"

namespace regoplan {

/// Different conditions that a recording needs to be diagnosed.
inline constexpr std::size_t kFewestConditions = 8;

/// A recording as it is analysed.
struct CondensedRecording {
  TestBed bed;
  std::vector<std::size_t> used;              ///< runs that can be judged
  std::vector<ChannelNoise> noise;            ///< per channel of the bed
  Eigen::MatrixXd correlation;                ///< of the noise between channels
  std::vector<std::vector<double>> adjusted;  ///< per channel, per run: at its condition's means
  std::vector<std::size_t> condition;         ///< per run; those not used: condition_count
  std::vector<double> day;                    ///< per run: as told, or else as replicates tell it
  std::optional<Course> course;               ///< what replicates follow, if anything
  std::vector<Channel> turned;                ///< measured with the other sign, and turned
  std::vector<std::string> notes;
};

/// Groups replicates, measures the noise and condenses runs to conditions. Runs that the model
/// cannot be trusted for (slip outside [-0.9, 0.95], slip angle beyond 60 deg, no forces at the
/// prior means) are left out and noted. Where replicates differ by a course in time, time is a
/// place: runs of different times are no replicates, and the noise is what the course leaves. A
/// channel whose sign opposes the convention is turned and noted (`turned_channels`).
/// \param fewest different conditions that are needed
/// \param stop of this work, and of all work on the bed that comes of it
/// \throws InputError with fewer different conditions, no channel, or replicates that are all
/// identical; Interrupted
CondensedRecording condense(const Recording& recording, const DiagnosisSetup& setup,
                            std::size_t fewest = kFewestConditions, std::stop_token stop = {});

/// Means of one channel over the replicates, and their covariance: each run's own scatter, outliers
/// weighted down, and what the runs of one day share.
/// \param day per run
/// \param adjusted per run: the value moved to its condition's mean load, slip and slip angle
ChannelData means_of(const std::vector<double>& day, const std::vector<Condition>& conditions,
                     const ChannelNoise& noise, const std::vector<double>& adjusted);

}  // namespace regoplan
