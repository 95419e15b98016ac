#include "app/starter_files/commented_yaml.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

namespace regoplan {
namespace {

using Comments = std::map<std::string_view, std::string_view>;

const Comments& comments() {
  static const Comments all{
      // A vehicle; frame: x forward, y left, origin on the ground below the centre of gravity.
      {"yaw_inertia_kgm2", "about the vertical axis through the centre of gravity"},
      {"mass_kg", "of the whole vehicle, load included"},
      {"cg_height_m", "centre of gravity above the ground"},
      {"turn_centre_x_m", "x of the line of turn centres; 0: below the centre of gravity"},
      {"speed_max_mps", "fastest, forward"},
      {"acceleration_max_mps2", "of the commanded speed, driving and braking"},
      {"curvature_max_1pm", "of the tightest commanded path, 1/radius"},
      {"curvature_rate_max_1pms", "how fast the steering changes it, per second"},
      {"steer_angle_max_deg", "of each steered wheel, either side; 0: skid steering"},
      {"slip_angle_max_deg", "limit where a scenario states none"},
      {"slip_max", "limit where a scenario states none"},
      {"sinkage_max_m", "limit where a scenario states none"},
      {"slope_max_deg", "limit where a scenario states none"},
      {"step_max_m", "rocks up to this height are driven over"},
      {"wheel", "all wheels are equal"},
      {"wheels", "three or more"},
      {"suspension", "equal_springs | rocker_bogie"},
      {"rocker_bogie", "pivots of rocker and bogie, with six wheels"},
      {"drive_law", "kinematic | equal_torque | equal_speed"},
      {"steering", "ackermann | crab | skid"},
      {"torque_max_nm", "of each wheel's motor"},
      {"body", "the box that stays clear of rocks and ground"},
      {"clearance_m", "of its underside above the ground"},
      {"height_m", "from its underside to its top"},
      // A soil.
      {"cohesion_pa", "c"},
      {"friction_angle_deg", "phi"},
      {"kc", "pressure-sinkage modulus, N/m^(n+1)"},
      {"kphi", "pressure-sinkage modulus, N/m^(n+2)"},
      {"n", "sinkage exponent"},
      {"a0", "normal stress peaks at (a0 + a1 slip) of the entry angle"},
      {"a1", "see a0"},
      {"lambda", "rear contact height over sinkage"},
      {"density_kgpm3", "rho"},
      {"kx0_m", "shear deformation modulus along, at slip angle 0"},
      {"kx1_m", "its growth per radian of slip angle"},
      {"ky0_m", "shear deformation modulus across, at slip angle 0"},
      {"ky1_m", "its growth per radian of slip angle"},
      {"c0_m", "slip sinkage, of yoshida2004 only"}};
  return all;
}

/// `    kc: 1400` -> `kc`; empty where the line is no key.
std::string_view key_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  const std::size_t colon = line.find(':');
  return colon == std::string_view::npos ? std::string_view() : line.substr(0, colon);
}

}  // namespace

std::string commented_yaml(const std::string& yaml) {
  constexpr std::size_t kColumn = 40;
  std::istringstream lines(yaml);
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    if (const auto comment = comments().find(key_of(line)); comment != comments().end()) {
      line.resize(std::max(line.size() + 2, kColumn), ' ');
      line += "# ";
      line += comment->second;
    }
    all += line + "\n";
  }
  return all;
}

}  // namespace regoplan
