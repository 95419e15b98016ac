#pragma once

#include <vector>

namespace regoplan {

/// Height over distance of one crater.
class CraterProfile {
 public:
  /// The profile ends here, in radii from the centre.
  static constexpr double kReach = 5;

  /// \param height_m at equal distances from the centre to kReach, both included
  explicit CraterProfile(std::vector<double> height_m);

  /// Height over the ground before the impact; 0 beyond kReach.
  /// \param distance from the centre in radii, >= 0
  double height_m(double distance) const;
  /// Depth from rim crest to floor.
  double depth_m() const;
  /// Height of the rim crest over the ground before the impact.
  double rim_height_m() const;

 private:
  std::vector<double> height_m_;
};

/// Shape of a simple impact crater, fresh and as it wears down.
///
/// Fresh, after Pike (1977), D in km: depth from rim crest to floor 0.196 D^1.010, rim height
/// 0.036 D^1.014; parabolic bowl (walls of 37 deg at the rim), ejecta falling with distance as r^-3
/// (McGetchin et al. 1973). It wears down by diffusion of the ground (Soderblom 1970; Fassett &
/// Thomson 2014), the heat equation about the axis, in the age t = diffusivity x time / radius^2.
/// Of Pike's two exponents the first is used for both: 2 % of the rim height at 5 m.
class CraterShape {
 public:
  /// Rim crest rounded over a few hundredths of a radius; depth 4 % and rim 16 % below Pike's.
  static constexpr double kYoungest = 0.001;
  /// Depth has fallen to a sixth, 0.034 diameters: craters older than that are counted as gone.
  static constexpr double kOldest = 0.33;

  CraterShape();

  /// \param age from kYoungest to kOldest
  CraterProfile profile(double diameter_m, double age) const;

 private:
  /// Heights in diameters of a crater of 1 km, by age and distance.
  std::vector<std::vector<double>> heights_;
};

}  // namespace regoplan
