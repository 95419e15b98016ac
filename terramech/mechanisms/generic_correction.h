#pragma once

#include <array>
#include <vector>

namespace regoplan {

/// What a recording shows beyond the model, without a name: a smooth surface to be added to each
/// channel, learned in a box of conditions and silent outside.
///
/// A sum of Gaussian bumps g(b) = exp(-(ds^2/Ls^2 + (b - b_k)^2/Lb^2 + dl^2/Ll^2)/2) over slip
/// ratio s, |slip angle| b and the logarithm l of the load. The side force's bumps are g(b) -
/// g(-b): odd in the slip angle, without a step at 0. Towards each side of the region the sum fades
/// to 0 as a smooth step over `fade_share` of the region's width (not towards slip angle 0, where
/// the region begins there), so that forces are continuous and solvers may cross it.
struct GenericCorrection {
  struct Node {
    double slip_ratio = 0;
    double slip_angle_rad = 0;  ///< >= 0
    double load_n = 0;
    double fx_n = 0, fy_n = 0, torque_nm = 0, sinkage_m = 0;  ///< heights of the bump
  };

  double slip_scale = 0.2;
  double slip_angle_scale_rad = 0.2;
  double log_load_scale = 0.5;
  std::array<double, 2> slip_ratio_region{};      ///< from, to
  std::array<double, 2> slip_angle_rad_region{};  ///< of |slip angle|
  std::array<double, 2> load_n_region{};
  double fade_share = 0;  ///< 0: the correction ends in a step
  std::vector<Node> nodes;
};

/// \throws ValueError naming the first field out of range: scales above 0, regions that go upwards
/// within slip ratio -1 to 1, slip angle 0 to 90 deg and loads above 0, fade_share 0 to 0.5, nodes
/// finite with loads above 0
void validate(const GenericCorrection& correction);

/// Where a wheel is, in the coordinates of a correction.
struct CorrectionPoint {
  double slip_ratio = 0;
  double slip_angle_rad = 0;  ///< >= 0
  double load_n = 0;
};

/// What is added to a wheel that goes forward with a slip angle above 0.
struct CorrectionValue {
  double fx_n = 0, fy_n = 0, torque_nm = 0, sinkage_m = 0;
};

/// Value and slopes.
struct SlopedCorrection {
  CorrectionValue value, by_slip_ratio, by_slip_angle, by_log_load;
};

/// Whether the correction was learned here; its edges count.
bool is_inside(const GenericCorrection& correction, const CorrectionPoint& point);

/// A node's bump with the fade, per unit of height: what a fit of the heights is linear in.
struct CorrectionBump {
  double even = 0;  ///< for fx, torque and sinkage
  double side = 0;  ///< for fy
};

/// 0 outside the region.
CorrectionBump bump(const GenericCorrection& correction, const GenericCorrection::Node& node,
                    const CorrectionPoint& point);

/// The sum over the nodes; all 0 outside the region. The slopes are exact (test: GenericCorrection.
/// SlopesAreThoseOfItsValues).
SlopedCorrection correction_at(const GenericCorrection& correction, const CorrectionPoint& point);

}  // namespace regoplan
