#pragma once

#include <optional>
#include <span>
#include <vector>

#include "terramech/margins/supply.h"

namespace regoplan {

/// Lateral forces that trims can give, newtons, left positive.
struct SupplyInterval {
  double right_n = 0;
  double left_n = 0;
};

/// Supply and traction of one vehicle on one soil over curvature, force and load, for searches that
/// ask millions of times: trilinear between steady manoeuvres that are solved when it is built.
/// Forward driving. Answers nothing outside its grid and next to manoeuvres without supply: on the
/// safe side for whoever rejects what has no answer.
class SupplyTable {
 public:
  /// \param law the wheel's forces on the soil \param weight_n m g \param tilt_max_rad steepest
  /// ground asked for \param threads that build it; the table is the same for any number
  SupplyTable(const Vehicle& vehicle, const WheelLaw& law, const TrimLimits& limits,
              double weight_n, double tilt_max_rad, int threads);

  /// As `cornering_supply`, less `overestimate_bound` at either end.
  std::optional<SupplyInterval> supply(double curvature_1pm, double forward_n,
                                       double normal_n) const;

  /// As `largest_traction_n`, less `overestimate_bound`, whatever the forward force at which the
  /// branch starts.
  std::optional<double> traction_n(double curvature_1pm, double left_n, double normal_n) const;

  /// What is taken off at either end, over the normal load: half as much again as the most that
  /// interpolation promised above solved manoeuvres, in `kChecksPerInterval` random states of each
  /// interval of curvatures; beyond 2 %, in those of the interval and of the two beside it.
  /// Measured, not proven: of thousands of fresh states none is promised more than it has
  /// (SupplyTable tests).
  double overestimate_bound(double curvature_1pm) const;
  static constexpr int kChecksPerInterval = 20;

  /// How far answers lie below solved manoeuvres, over the normal load, in the same states.
  struct Loss {
    double median = 0;
    double at_99_percent = 0;
  };
  const Loss& loss() const { return loss_; }

 private:
  struct Cell {  ///< of one grid axis: the node below and the share of the next
    std::size_t low = 0;
    double share = 0;
  };
  static std::optional<Cell> locate(const std::vector<double>& nodes, double value);
  static std::optional<double> interpolate(const std::vector<double>& values, std::size_t middle,
                                           std::size_t inner, const Cell& a, const Cell& b,
                                           const Cell& c);
  std::optional<SupplyInterval> interpolated_supply(double curvature_1pm, double forward_n,
                                                    double normal_n) const;
  std::optional<double> interpolated_traction_n(double curvature_1pm, double left_n,
                                                double normal_n) const;
  /// Of interpolated over solved manoeuvres, over the normal load.
  std::vector<double> excesses(const Vehicle& vehicle, const LoadSharing& sharing,
                               std::span<const WheelLaw> laws, const TrimLimits& limits,
                               std::size_t interval) const;

  double weight_n_;
  std::vector<double> curvatures_1pm_;
  std::vector<double> forces_;   ///< along (supply) or across (traction), over the normal load
  std::vector<double> normals_;  ///< over the weight
  std::vector<double> right_, left_, traction_;  ///< over the normal load; NaN: none
  std::vector<double> overestimate_bounds_;      ///< of each interval of curvatures
  Loss loss_;
};

}  // namespace regoplan
