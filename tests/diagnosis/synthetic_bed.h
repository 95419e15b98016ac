#pragma once

#include <cstdint>
#include <functional>

#include "diagnosis/diagnosis.h"

namespace regoplan {

/// A wheel on soil integrated by other means than the model's (midpoints and bisection), with
/// changes in other forms than the ones the tool carries. Every factor is 1 and every addition 0
/// unless set.
struct TrueWheel {
  using At = const WheelRun&;
  std::function<double(At)> stiffness = [](At) { return 1.0; };
  std::function<double(double h)> depth_stiffness = [](double) { return 1.0; };
  std::function<double(At)> limit = [](At) { return 1.0; };  ///< on c and tan(phi)
  std::function<double(At)> kx = [](At) { return 1.0; };
  std::function<double(At)> ky = [](At) { return 1.0; };
  std::function<double(At)> rear = [](At) { return 0.0; };  ///< added to lambda
  std::function<double(At)> load = [](At) { return 1.0; };
  std::function<double(At)> radius = [](At) { return 1.0; };
  std::function<double(At, double h0)> sinkage = [](At, double h0) { return h0; };
  std::function<double(At)> tilt_rad = [](At) { return 0.0; };  ///< inner side deeper
  bool friction_circle = false;  ///< shear cut back to one Mohr-Coulomb limit
  std::function<double(At, double h)> fx_n = [](At, double) { return 0.0; };
  std::function<double(At, double h)> fy_n = [](At, double) { return 0.0; };  ///< opposing
  std::function<double(At, double h)> torque_nm = [](At, double) { return 0.0; };
};

std::array<double, kChannelCount> true_channels(const TrueWheel& truth, const DiagnosisSetup& setup,
                                                const Soil& soil, const WheelRun& run);

/// The simulant of the paper's authors with the uncertainty of plausible soil tests.
DiagnosisSetup simulant_setup();

struct BedPlan {
  std::vector<double> slips{-0.3, 0, 0.15, 0.3, 0.5, 0.8};
  std::vector<double> angles_deg{0, 5, 10, 16};
  std::vector<double> loads_n{45, 64.7, 90};
  std::size_t conditions = 44;  ///< drawn from the grid
  int replicates = 3;
  double noise = 1;        ///< times 1 N, 1 N, 0.09 Nm, 0.5 mm
  double day = 0.3;        ///< of the noise
  double outliers = 0.01;  ///< share of values that are off by 6 and more
  bool ruts = false, passes = false, speeds = false;
  bool positions = false;  ///< along a bed of 1 m, evenly, in no order of slip, angle or load
  std::function<void(WheelRun&)> instruments = [](WheelRun&) {};
};

Recording record(const TrueWheel& truth, const DiagnosisSetup& setup, const Soil& soil,
                 const BedPlan& plan, std::uint64_t seed);

}  // namespace regoplan
