#include "drive_diagnosis/comparison/vehicle_deviation.h"

namespace regoplan {

void VehicleDeviation::add(const VehicleDeviation& other, double times) {
  for (std::size_t i = 0; i < kMaxWheels; ++i) {
    wheel_drag_nm.at(i) += times * other.wheel_drag_nm.at(i);
    steering_offset_rad.at(i) += times * other.steering_offset_rad.at(i);
    motor_share.at(i) += times * other.motor_share.at(i);
    wheel_radius_share.at(i) += times * other.wheel_radius_share.at(i);
    wheel_speed_late_s.at(i) += times * other.wheel_speed_late_s.at(i);
  }
  for (double VehicleDeviation::*of :
       {&VehicleDeviation::torque_by_load, &VehicleDeviation::pull_by_load,
        &VehicleDeviation::radius_share, &VehicleDeviation::attitude_late_s,
        &VehicleDeviation::payload_share, &VehicleDeviation::cg_forward_m,
        &VehicleDeviation::cg_left_m, &VehicleDeviation::cg_up_m, &VehicleDeviation::tow_drag_n,
        &VehicleDeviation::map_east_m, &VehicleDeviation::map_north_m,
        &VehicleDeviation::map_height_share, &VehicleDeviation::soil_east_m,
        &VehicleDeviation::soil_north_m, &VehicleDeviation::tilt_share,
        &VehicleDeviation::mounting_pitch_rad, &VehicleDeviation::mounting_roll_rad,
        &VehicleDeviation::mounting_yaw_rad}) {
    this->*of += times * (other.*of);
  }
  if (soils.size() < other.soils.size()) soils.resize(other.soils.size());
  for (std::size_t i = 0; i < other.soils.size(); ++i) {
    for (std::size_t k = 0; k < kSoilNumbers; ++k) {
      soils[i].at(k) += times * other.soils[i].at(k);
    }
  }
}

}  // namespace regoplan
