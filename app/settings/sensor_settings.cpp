#include "app/settings/sensor_settings.h"

#include <fmt/format.h>

#include "app/io/share_files.h"
#include "app/settings/settings_mapping.h"
#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

/// How the numbers of a channel are told: the ends of its keys, and SI over their unit.
struct ChannelUnits {
  std::string_view noise;    ///< of noise and bias
  std::string_view quantum;  ///< of the quantum
  double si = 1;
  double noise_max = 0, quantum_max = 0;
};

SensorChannel read_channel(const SettingsNode& node, const ChannelUnits& units) {
  return read_mapping(node, [&](SettingsMapping& mapping) {
    const ValueRange noise{.min = 0, .max = units.noise_max};
    const ValueRange either_way{.min = -units.noise_max, .max = units.noise_max};
    const ValueRange share{.min = 0, .max = 1, .max_excluded = true};
    SensorChannel channel;
    channel.rate_hz = mapping.number("rate_hz", {.min = 0.001, .max = 1000});
    channel.noise = units.si * mapping.number_or(fmt::format("noise{}", units.noise), noise, 0);
    channel.bias = units.si * mapping.number_or(fmt::format("bias{}", units.noise), either_way, 0);
    channel.latency_s = mapping.number_or("latency_s", {.min = 0, .max = 10}, 0);
    channel.quantum = units.si * mapping.number_or(fmt::format("quantum{}", units.quantum),
                                                   {.min = 0, .max = units.quantum_max}, 0);
    channel.stale_share = mapping.number_or("stale_share", share, 0);
    channel.dropped_share = mapping.number_or("dropped_share", share, 0);
    return channel;
  });
}

GroundScatter read_scatter(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    const ValueRange share{.min = 0, .max = 1}, angle{.min = 0, .max = 45};
    GroundScatter scatter;
    scatter.speed_share = mapping.number_or("speed_share", share, 0);
    scatter.drift_rad = kDegree * mapping.number_or("drift_deg", angle, 0);
    scatter.turn_radpm = mapping.number_or("turn_rad_m", {.min = 0, .max = 1}, 0);
    scatter.torque_share = mapping.number_or("torque_share", share, 0);
    scatter.attitude_rad = kDegree * mapping.number_or("attitude_deg", angle, 0);
    scatter.correlation_m = mapping.number_or("correlation_m", {.min = 0.01, .max = 1000}, 1);
    return scatter;
  });
}

}  // namespace

SensorSuite read_sensors(const std::string& file) {
  return read_mapping(read_settings(file), [](SettingsMapping& mapping) {
    SensorSuite suite;
    const auto channel = [&](std::string_view key, std::optional<SensorChannel>& target,
                             const ChannelUnits& units) {
      if (const SettingsNode* node = mapping.optional(key)) target = read_channel(*node, units);
    };
    const ChannelUnits metres{"_m", "_m", 1, 100, 100}, degrees{"_deg", "_deg", kDegree, 180, 180};
    channel("position", suite.position, metres);
    channel("yaw", suite.yaw, degrees);
    channel("attitude", suite.attitude, degrees);
    channel("wheel_speed", suite.wheel_speed, {"_share", "_rad_s", 1, 1, 100});
    channel("torque", suite.torque, {"_share", "_nm", 1, 1, 1e4});
    channel("sinkage", suite.sinkage, metres);
    channel("yaw_rate", suite.yaw_rate, {"_rad_s", "_rad_s", 1, 10, 10});
    suite.steer_noise_rad =
        kDegree * mapping.number_or("steering_noise_deg", {.min = 0, .max = 45}, 0);
    if (const SettingsNode* scatter = mapping.optional("ground_scatter")) {
      suite.scatter = read_scatter(*scatter);
    }
    return suite;
  });
}

std::string sensors_file(const std::string& name) {
  if (name == "A") return share_file("scenarios/drive/sensors_a.yaml");
  if (name == "B") return share_file("scenarios/drive/sensors_b.yaml");
  return name;
}

}  // namespace regoplan
