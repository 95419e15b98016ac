#pragma once

#include <array>
#include <vector>

namespace regoplan {

/// What a recording shows beyond the model, without a name: a smooth surface to be added to each
/// channel, learned in a box of conditions and silent outside. A sum of Gaussian bumps
/// exp(-(ds^2/Ls^2 + db^2/Lb^2 + dl^2/Ll^2)/2) over slip ratio, |slip angle| and the logarithm of
/// the load.
struct GenericCorrection {
  struct Node {
    double slip_ratio = 0;
    double slip_angle_rad = 0;  ///< >= 0; the side force's part is odd in the slip angle
    double load_n = 0;
    double fx_n = 0, fy_n = 0, torque_nm = 0, sinkage_m = 0;  ///< heights of the bump
  };

  double slip_scale = 0.2;
  double slip_angle_scale_rad = 0.2;
  double log_load_scale = 0.5;
  std::array<double, 2> slip_ratio_region{};      ///< from, to
  std::array<double, 2> slip_angle_rad_region{};  ///< of |slip angle|
  std::array<double, 2> load_n_region{};
  std::vector<Node> nodes;
};

}  // namespace regoplan
