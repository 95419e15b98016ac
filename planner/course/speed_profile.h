#pragma once

#include <array>
#include <vector>

namespace regoplan {

/// Speed along a path: the square of the speed is linear between nodes, that is, the acceleration
/// is constant there.
class SpeedProfile {
 public:
  struct Node {
    double s_m = 0;
    double speed_mps = 0;
  };
  struct Value {
    double speed_mps = 0;
    double acceleration_mps2 = 0;
  };

  /// \pre at least two nodes, s_m rises strictly, speeds are not negative, and of two neighbours
  /// one at least moves
  explicit SpeedProfile(std::vector<Node> nodes);

  Value at(double s_m) const;
  double duration_s(double s_m) const;  ///< from the start to s_m
  double speed_max_mps() const;
  /// Where within a stretch speed is lost and where it is gathered hardest, each at the fastest
  /// place of that piece. \pre 0 <= from_m < to_m <= the end
  std::array<double, 2> hardest_m(double from_m, double to_m) const;
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  std::size_t interval(double s_m) const;

  std::vector<Node> nodes_;
  std::vector<double> time_s_;  ///< at each node
};

/// The fastest profile below given speeds that the acceleration allows, from a start speed to a
/// speed at the end. Where the start is faster than could be braked for, it starts slower.
/// \param most what may be driven, linear between; at least two nodes
SpeedProfile limited_by_acceleration(const std::vector<SpeedProfile::Node>& most,
                                     double start_speed_mps, double end_speed_mps,
                                     double acceleration_max_mps2);

}  // namespace regoplan
