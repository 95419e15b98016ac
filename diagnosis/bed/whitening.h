#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "diagnosis/bed/wheel_bed.h"

namespace regoplan {

/// The Cholesky factor of each channel's noise.
class NoiseFactors {
 public:
  explicit NoiseFactors(const TestBed& bed) {
    for (const ChannelData& data : bed.channels) of_channel_.emplace_back(data.noise);
  }
  const Eigen::LLT<Eigen::MatrixXd>& operator()(std::size_t channel) const {
    return of_channel_[channel];
  }

 private:
  std::vector<Eigen::LLT<Eigen::MatrixXd>> of_channel_;
};

/// Values over all channels, the rows of each channel multiplied by the inverse of its Cholesky
/// factor: noise with that covariance becomes white noise of unit variance.
/// \param factor factor(c) is the Eigen::LLT of channel c
/// \param values a vector or a matrix with bed.size() rows
template <class FactorOf, class Values>
Values whitened(const TestBed& bed, const FactorOf& factor, Values values) {
  if (values.cols() == 0) return values;  // Eigen would bind a reference to the first element
  for (std::size_t c = 0; c < bed.channels.size(); ++c) {
    auto rows = values.middleRows(bed.offset(c), bed.channels[c].mean.size());
    factor(c).matrixL().solveInPlace(rows);
  }
  return values;
}

}  // namespace regoplan
