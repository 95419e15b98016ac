#include "diagnosis/run_differences.h"

#include <cmath>

namespace regoplan {

std::vector<RunDifference> run_differences(const CalibratedRecording& calibrated,
                                           const CandidateFit& fit) {
  const TestBed& bed = calibrated.bed();
  const Eigen::VectorXd& base = calibrated.base().prediction;
  std::vector<RunDifference> all;
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    const ChannelData& data = bed.channels[c];
    for (Eigen::Index i = 0; i < data.mean.size(); ++i) {
      const Eigen::Index row = bed.offset(c) + i;
      const std::size_t k = data.conditions[static_cast<std::size_t>(i)];
      for (const std::size_t run : bed.conditions[k].runs) {
        const double left = calibrated.recording().adjusted[c][run];
        if (!std::isfinite(left)) continue;
        all.push_back({.run = run,
                       .channel = data.channel,
                       .difference = left - base[row],
                       .standard_deviation = std::sqrt(data.noise(i, i)),
                       .by_names = fit.prediction[row] - base[row]});
      }
    }
  }
  return all;
}

}  // namespace regoplan
