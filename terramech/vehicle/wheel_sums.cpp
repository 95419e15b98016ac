#include "terramech/vehicle/wheel_sums.h"

#include <algorithm>
#include <cmath>

#include "terramech/vehicle/faded_forces.h"
#include "terramech/vehicle/rim_speed.h"

namespace regoplan {

namespace {

/// Above this, forces fade little enough to be called smooth.
constexpr double kMoving_mps = 3 * kStandstill_mps;

bool rolls(const WheelMotion& at) {
  return at.vx_mps * at.rim_speed_mps > 0 &&
         std::max(std::abs(at.vx_mps), std::abs(at.rim_speed_mps)) > kMoving_mps;
}

/// \pre `rolls(at)`, the law has slopes
WheelSlopes faded_slopes(const WheelLaw& law, double load_n, const WheelMotion& at) {
  const SlopedForces forces = law.forces_with_slopes(load_n, at);
  const SlopedForce &fx = forces.fx, &fy = forces.fy;
  const Fade along(at.vx_mps, at.rim_speed_mps), across(at.vy_mps, at.rim_speed_mps);
  const double fade_x = along.value, fade_y = across.value;
  const double bend_x = fx.value_n * along.slope_per_speed;
  const double bend_y = fy.value_n * across.slope_per_speed;
  return {.x = fx.value_n * fade_x,
          .y = -fy.value_n * fade_y,
          .x_by_vx = fx.by_vx_nspm * fade_x + bend_x * at.vx_mps,
          .x_by_vy = fx.by_vy_nspm * fade_x,
          .x_by_rim = fx.by_rim_speed_nspm * fade_x + bend_x * at.rim_speed_mps,
          .y_by_vx = -fy.by_vx_nspm * fade_y,
          .y_by_vy = -fy.by_vy_nspm * fade_y - bend_y * at.vy_mps,
          .y_by_rim = -fy.by_rim_speed_nspm * fade_y - bend_y * at.rim_speed_mps,
          .torque_nm = forces.torque_nm * fade_x,
          .rim_speed_mps = at.rim_speed_mps};
}

double within(const std::optional<double>& limit, double value) {
  return limit ? std::clamp(value, -*limit, *limit) : value;
}

/// A force in a wheel's frame, on the body.
BodyForce on_body(const WheelMount& mount, const SteeredWheel& wheel, double x_n, double y_n) {
  const double forward = wheel.cos_steer * x_n - wheel.sin_steer * y_n;
  const double left = wheel.sin_steer * x_n + wheel.cos_steer * y_n;
  return {.forward_n = forward, .left_n = left, .yaw_nm = mount.x_m * left - mount.y_m * forward};
}

/// Slopes of the force on the body by the velocity of its origin.
struct BodySlopes {
  BodyForce by_vx, by_vy, by_yaw_rate;

  BodySlopes operator+(const BodySlopes& other) const {
    return {by_vx + other.by_vx, by_vy + other.by_vy, by_yaw_rate + other.by_yaw_rate};
  }
  Eigen::Matrix3d matrix() const {
    return Eigen::Matrix3d{{by_vx.forward_n, by_vy.forward_n, by_yaw_rate.forward_n},
                           {by_vx.left_n, by_vy.left_n, by_yaw_rate.left_n},
                           {by_vx.yaw_nm, by_vy.yaw_nm, by_yaw_rate.yaw_nm}};
  }
};

BodySlopes on_body(const WheelMount& mount, const SteeredWheel& wheel, const WheelSlopes& f) {
  const double c = wheel.cos_steer, s = wheel.sin_steer;
  const BodyForce by_vx =
      on_body(mount, wheel, f.x_by_vx * c - f.x_by_vy * s, f.y_by_vx * c - f.y_by_vy * s);
  const BodyForce by_vy =
      on_body(mount, wheel, f.x_by_vx * s + f.x_by_vy * c, f.y_by_vx * s + f.y_by_vy * c);
  const double x = mount.x_m, y = mount.y_m;
  return {by_vx,
          by_vy,
          {.forward_n = x * by_vy.forward_n - y * by_vx.forward_n,
           .left_n = x * by_vy.left_n - y * by_vx.left_n,
           .yaw_nm = x * by_vy.yaw_nm - y * by_vx.yaw_nm}};
}

void add_contact(WheelStrain& strain, double radius_m, WheelStatus status, double sinkage_m,
                 double torque_nm) {
  strain.sinkage_m = std::max(strain.sinkage_m, has_forces(status) ? sinkage_m : radius_m);
  if (std::abs(torque_nm) > std::abs(strain.torque_max_nm)) strain.torque_max_nm = torque_nm;
}

}  // namespace

VehicleWheels::VehicleWheels(const Vehicle& vehicle, std::span<const WheelLaw> soil_laws)
    : vehicle_(vehicle), soil_laws_(soil_laws), sharing_(vehicle) {
  for (const WheelMount& mount : vehicle.wheels) driven_ += mount.driven;
}

VehicleWheels::Response VehicleWheels::response(std::size_t wheel, const WheelLaw& law,
                                                double load_n, WheelMotion at,
                                                double shared_torque_nm) const {
  const auto at_rim = [&](double rim_speed_mps) {
    return faded(law, load_n, {at.vx_mps, at.vy_mps, rim_speed_mps});
  };
  const auto given = [&](double torque_nm) {
    const double rim_speed_mps = rim_speed_at_torque(
        [&](double rim) { return at_rim(rim).torque_nm; }, torque_nm, at.vx_mps, kStandstill_mps);
    return Response{at_rim(rim_speed_mps), rim_speed_mps, false};
  };
  if (!vehicle_.wheels[wheel].driven) return given(0);
  if (vehicle_.drive_law == DriveLaw::kEqualTorque) return given(shared_torque_nm);
  const WheelForces forces = at_rim(at.rim_speed_mps);
  const double held = within(vehicle_.torque_max_nm, forces.torque_nm);
  return held == forces.torque_nm ? Response{forces, at.rim_speed_mps} : given(held);
}

VehicleWheels::WheelOnGround VehicleWheels::on_ground(std::size_t i, const BodyMotion& motion,
                                                      const WheelSetting& setting,
                                                      const GroundPatch& patch) const {
  const WheelMount& mount = vehicle_.wheels[i];
  const SteeredWheel& wheel = setting.wheels[i];
  return {mount, wheel, soil_laws_[static_cast<std::size_t>(patch.soil[i])],
          wheel_motion(mount, wheel, motion, setting.rim_speed * wheel.rim_speed_per_speed)};
}

WheelSums VehicleWheels::sums(const BodyMotion& motion, const WheelSetting& setting,
                              const GroundPatch& patch, const GroundReaction& reaction) const {
  SharedDrive shared;
  if (vehicle_.drive_law == DriveLaw::kEqualTorque) {
    shared = shared_drive(motion, setting, patch, reaction);
  }
  WheelSums sums;
  sums.contact.load_min_n = reaction.normal_n;
  struct OfSide {
    BodyForce force;
    double drive_power_w = 0;
    OfSide operator+(const OfSide& other) const {
      return {force + other.force, drive_power_w + other.drive_power_w};
    }
  };
  const OfSide sum = sum_by_side(vehicle_, OfSide{}, [&](OfSide& of_side, std::size_t i) {
    const double load = sharing_.load_n(i, reaction);
    sums.contact.load_min_n = std::min(sums.contact.load_min_n, load);
    if (!(load > 0)) return;
    auto [mount, wheel, law, at] = on_ground(i, motion, setting, patch);
    WheelForces forces;
    bool as_commanded = mount.driven && vehicle_.drive_law != DriveLaw::kEqualTorque;
    if (as_commanded) {
      forces = faded(law, load, at);
      as_commanded = within(vehicle_.torque_max_nm, forces.torque_nm) == forces.torque_nm;
    }
    if (mount.driven && shared.rims_known) {
      at.rim_speed_mps = shared.rim_speed_mps.at(i);
      forces = faded(law, load, at);
      sums.as_commanded = false;
    } else if (!as_commanded) [[unlikely]] {
      const Response response = this->response(i, law, load, at, shared.torque_nm);
      forces = response.forces;
      at.rim_speed_mps = response.rim_speed_mps;
      sums.as_commanded = false;
    }
    of_side.force.add(mount, wheel, forces);
    add_contact(sums.contact, vehicle_.wheel.radius_m, forces.status, forces.sinkage_m,
                forces.torque_nm);
    sums.rim_speed_mps.at(i) = at.rim_speed_mps;
    of_side.drive_power_w +=
        std::max(forces.torque_nm * at.rim_speed_mps / vehicle_.wheel.radius_m, 0.0);
  });
  sums.force = sum.force;
  sums.drive_power_w = sum.drive_power_w;
  return sums;
}

/// By differences of the law, a wheel's answer to its motor included.
WheelSlopes VehicleWheels::slopes_by_differences(std::size_t wheel, const WheelLaw& law,
                                                 double load_n, const WheelMotion& at) const {
  const Response here = response(wheel, law, load_n, at, 0);
  const double h = 1e-4 * std::max({std::abs(at.vx_mps), std::abs(at.vy_mps),
                                    std::abs(at.rim_speed_mps), kStandstill_mps});
  // Outward, so that mirrored and reversed motions have mirrored and reversed slopes.
  const double hx = std::copysign(h, at.vx_mps != 0 ? at.vx_mps : at.rim_speed_mps);
  const double hy = std::copysign(h, at.vy_mps);
  const WheelForces ahead =
      response(wheel, law, load_n, {at.vx_mps + hx, at.vy_mps, at.rim_speed_mps}, 0).forces;
  const WheelForces aside =
      response(wheel, law, load_n, {at.vx_mps, at.vy_mps + hy, at.rim_speed_mps}, 0).forces;
  WheelSlopes f{.x = here.forces.fx_n,
                .y = -here.forces.fy_n,
                .x_by_vx = (ahead.fx_n - here.forces.fx_n) / hx,
                // Fx is even in the lateral motion.
                .x_by_vy = at.vy_mps == 0 ? 0 : (aside.fx_n - here.forces.fx_n) / hy,
                .y_by_vx = (here.forces.fy_n - ahead.fy_n) / hx,
                .y_by_vy = (here.forces.fy_n - aside.fy_n) / hy,
                .torque_nm = here.forces.torque_nm,
                .rim_speed_mps = here.rim_speed_mps,
                .as_commanded = here.as_commanded};
  if (here.as_commanded && at.rim_speed_mps != 0) {
    // Forces depend on ratios of speeds only, but for the little they fade.
    f.x_by_rim = -(at.vx_mps * f.x_by_vx + at.vy_mps * f.x_by_vy) / at.rim_speed_mps;
    f.y_by_rim = -(at.vx_mps * f.y_by_vx + at.vy_mps * f.y_by_vy) / at.rim_speed_mps;
  }
  return f;
}

SlopedWheelSums VehicleWheels::sums_with_slopes(const BodyMotion& motion,
                                                const WheelSetting& setting,
                                                const WheelSetting& next, const GroundPatch& patch,
                                                const GroundReaction& reaction) const {
  SlopedWheelSums result;
  if (vehicle_.drive_law == DriveLaw::kEqualTorque) {
    // The wheels share one torque: each one's forces depend on the motion of all.
    result.sums = sums(motion, setting, patch, reaction);
    result.smooth = false;
    const double h =
        1e-4 * std::max({std::abs(motion.vx_mps), std::abs(setting.rim_speed), kStandstill_mps});
    const auto moved = [&](const BodyMotion& there) {
      const BodyForce force = sums(there, setting, patch, reaction).force;
      return Eigen::Vector3d{force.forward_n - result.sums.force.forward_n,
                             force.left_n - result.sums.force.left_n,
                             force.yaw_nm - result.sums.force.yaw_nm};
    };
    const auto& [vx, vy, r] = motion;
    result.slopes.col(0) = moved({vx + h, vy, r}) / h;
    // To both sides, so that mirrored motions have mirrored slopes.
    result.slopes.col(1) = (moved({vx, vy + h, r}) - moved({vx, vy - h, r})) / (2 * h);
    result.slopes.col(2) = (moved({vx, vy, r + h}) - moved({vx, vy, r - h})) / (2 * h);
    return result;
  }
  WheelSums& sums = result.sums;
  sums.strain_known = false;
  const bool changes = &next != &setting;
  struct OfSide {
    BodyForce force, by_setting;
    BodySlopes slopes;
    double drive_power_w = 0;
    OfSide operator+(const OfSide& other) const {
      return {force + other.force, by_setting + other.by_setting, slopes + other.slopes,
              drive_power_w + other.drive_power_w};
    }
  };
  const OfSide sum = sum_by_side(vehicle_, OfSide{}, [&](OfSide& of_side, std::size_t i) {
    const double load = sharing_.load_n(i, reaction);
    if (!(load > 0)) return;
    auto [mount, wheel, law, at] = on_ground(i, motion, setting, patch);
    WheelSlopes f;
    bool as_commanded = mount.driven && rolls(at);
    if (as_commanded && law.has_slopes()) {
      f = faded_slopes(law, load, at);
      as_commanded = within(vehicle_.torque_max_nm, f.torque_nm) == f.torque_nm;
    }
    if (!as_commanded || !law.has_slopes()) [[unlikely]] {
      f = slopes_by_differences(i, law, load, at);
    }
    as_commanded = as_commanded && f.as_commanded;
    at.rim_speed_mps = f.rim_speed_mps;
    result.smooth = result.smooth && as_commanded;

    of_side.force = of_side.force + on_body(mount, wheel, f.x, f.y);
    of_side.slopes = of_side.slopes + on_body(mount, wheel, f);
    if (changes && result.smooth) {
      const SteeredWheel& to = next.wheels[i];
      const double turn = wheel.cos_steer * to.sin_steer - wheel.sin_steer * to.cos_steer;
      const double faster = next.rim_speed * to.rim_speed_per_speed - at.rim_speed_mps;
      const double vx = at.vy_mps * turn, vy = -at.vx_mps * turn;
      of_side.by_setting =
          of_side.by_setting +
          on_body(mount, wheel, f.x_by_vx * vx + f.x_by_vy * vy + f.x_by_rim * faster - f.y * turn,
                  f.y_by_vx * vx + f.y_by_vy * vy + f.y_by_rim * faster + f.x * turn);
    }
    of_side.drive_power_w +=
        std::max(f.torque_nm * at.rim_speed_mps / vehicle_.wheel.radius_m, 0.0);
  });
  sums.force = sum.force;
  sums.drive_power_w = sum.drive_power_w;
  result.slopes = sum.slopes.matrix();
  if (result.smooth) {
    result.by_setting = {sum.by_setting.forward_n, sum.by_setting.left_n, sum.by_setting.yaw_nm};
  }
  return result;
}

WheelStrain VehicleWheels::strain(const WheelSums& sums, const BodyMotion& motion,
                                  const WheelSetting& setting,
                                  const GroundReaction& reaction) const {
  LargestSlips slips;
  for (std::size_t i = 0; i < vehicle_.wheels.size(); ++i) {
    if (!(sharing_.load_n(i, reaction) > 0)) continue;
    slips.add(
        wheel_motion(vehicle_.wheels[i], setting.wheels[i], motion, sums.rim_speed_mps.at(i)));
  }
  WheelStrain strain = sums.contact;
  strain.slip = slips.slip();
  strain.slip_angle_rad = slips.slip_angle_rad();
  return strain;
}

}  // namespace regoplan
