#pragma once

#include <cstdint>
#include <optional>

#include "diagnosis/checks/detection.h"
#include "diagnosis/findings/findings.h"

namespace regoplan {

/// Where measurement and fitted model differ: boxes and half-lines of every column that varies and
/// of the slip of the run before, and corners of two columns, are scanned in every channel for the
/// mean residual. Its significance is judged against the largest such mean, over all channels and
/// regions, that noise leaves in seeded draws, so that 5 % of recordings without mismatch show any
/// region at all. The run before counts by what a smooth surface over each run's own conditions
/// does not tell. Of regions that share most of their conditions only the strongest stays.
std::vector<MismatchRegion> locate(const CondensedRecording& recording, const FitRemainder& fit,
                                   std::uint64_t seed);

/// The last third, or the stretch, of a course that replicates follow, in its own column: by how
/// much the channel in which it is clearest lies there off the first third, or all else, its noise
/// at hand. Nothing without a course.
std::optional<MismatchRegion> last_part_of(const CondensedRecording& recording);

}  // namespace regoplan
