#include "app/wheel/other_names.h"

#include <algorithm>

namespace regoplan {

const std::vector<OtherName>& other_names() {
  constexpr std::string_view kInstrument = "an instrument of a test bed";
  constexpr std::string_view kVehicle = "a vehicle, told from its drives";
  constexpr std::string_view kMap = "a map, told from drives over it";
  constexpr std::string_view kRanking = "a ranking";
  constexpr std::string_view kChannels = "fx_n, fy_n, torque_nm or sinkage_m: the form says which";
  constexpr std::string_view kTorques = "torque_WHEEL_nm";
  constexpr std::string_view kPoses = "x_m, y_m, yaw_deg, pitch_deg, roll_deg, torque_WHEEL_nm";
  static const std::vector<OtherName> names{
      {"sensor_bias",
       kInstrument,
       "a column is off by a constant: told = true + bias; form settling: by less and less from "
       "the first time on, drifting: by more and more up to the last, for_a_time: from from_s to "
       "to_s only",
       kChannels,
       {{"bias", "of the column"}, {"settling_time_s", "s"}, {"from_s, to_s", "s"}}},
      {"sensor_gain",
       kInstrument,
       "a column is off by a factor: told = (1 + gain) true; form settling: by less and less from "
       "the first time on, drifting: by more and more up to the last, for_a_time: from from_s to "
       "to_s only",
       kChannels,
       {{"gain", ""}, {"settling_time_s", "s"}, {"from_s, to_s", "s"}}},
      {"sensor_crosstalk",
       kInstrument,
       "a share of one column shows in another (form `fx_n into fy_n`), or the sensor of both "
       "forces is turned about the vertical (form `turned about z`)",
       "fx_n, fy_n, torque_nm: the form says which",
       {{"share", "of the second column over that of the first"}, {"turn_rad", "rad"}}},
      {"wheel_drag",
       kVehicle,
       "one wheel takes more torque than its soil does",
       kTorques,
       {{"drag_WHEEL_nm", "N m"}}},
      {"side_drag",
       kVehicle,
       "the wheels of one side take more torque, or more current, than those of the other",
       "torque_WHEEL_nm, current_left_a, current_right_a",
       {{"drag_left_nm, drag_right_nm", "N m"}, {"excess_a", "A"}}},
      {"steering_offset",
       kVehicle,
       "a wheel, or an axle, is steered otherwise than is told",
       "steer_WHEEL_deg against the track and yaw_deg",
       {{"steer_WHEEL_deg, steer_front_deg, steer_rear_deg", "deg"}}},
      {"wheel_radius",
       kVehicle,
       "wheels roll as if they had another radius, or rim speeds are told by another factor",
       "wheel_speed_WHEEL_rad_s against the track",
       {{"radius_share, radius_WHEEL_share", ""}}},
      {"clock_offset",
       kVehicle,
       "wheel speeds, or pitch and roll, are told later than what else is in their rows",
       "wheel_speed_WHEEL_rad_s, or pitch_deg and roll_deg, against all else",
       {{"wheel_speeds_late_s, wheel_speed_WHEEL_late_s, attitude_late_s", "s"}}},
      {"payload", kVehicle, "it weighs more or less than is told", kTorques, {{"mass_share", ""}}},
      {"motor_constant",
       kVehicle,
       "torques are told too large or too small by a factor, as of currents times another constant",
       kTorques,
       {{"torque_share, torque_WHEEL_share", ""}}},
      {"cg_offset",
       kVehicle,
       "its centre of gravity lies elsewhere than is told",
       kTorques,
       {{"forward_m, left_m, up_m", "m"}}},
      {"tow_drag", kVehicle, "something that it pulls holds it back", kTorques, {{"drag_n", "N"}}},
      {"wheel_law",
       kVehicle,
       "torque, or drawbar pull, rises otherwise with a wheel's load than the wheel model says: "
       "physics that it lacks, and no fault of the vehicle",
       kTorques,
       {{"torque_by_load, pull_by_load", "of the load, per share of it above the mean"}}},
      {"attitude_mounting",
       kVehicle,
       "the attitude sensor is mounted otherwise than is told",
       "pitch_deg, roll_deg",
       {{"pitch_deg, roll_deg", "deg"}}},
      {"map_offset",
       kMap,
       "positions and map lie beside each other",
       kPoses,
       {{"east_m, north_m", "m"}}},
      {"map_heights",
       kMap,
       "the map's heights, and its slopes with them, are too large or too small by a factor",
       kPoses,
       {{"height_share", ""}}},
      {"zone_border",
       kMap,
       "the border of two soils lies elsewhere than the map has it",
       kPoses,
       {{"east_m, north_m", "m"}}},
      {"none", kRanking, "nothing is missing: the model as it is", "", {}},
      {"parameters", kRanking, "nothing but other soil numbers within their spread", "", {}},
      {"unexplained", kRanking, "something that no name of the vocabulary says", "", {}},
      {"generic",
       kRanking,
       "the correction of what is unexplained, without a name, in a model file",
       "",
       {}}};
  return names;
}

const OtherName* other_name(std::string_view id) {
  const std::vector<OtherName>& names = other_names();
  const auto found = std::ranges::find(names, id, &OtherName::id);
  return found == names.end() ? nullptr : &*found;
}

}  // namespace regoplan
