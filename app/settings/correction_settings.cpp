#include "app/settings/correction_settings.h"

#include <fmt/format.h>

#include "app/settings/settings_mapping.h"
#include "terramech/basics/angles.h"
#include "terramech/tables/number_text.h"

namespace regoplan {
namespace {

std::array<double, 2> read_interval(const SettingsNode& node, double unit) {
  const auto& ends = node.list();
  if (ends.size() != 2) {
    throw node.error(fmt::format("{} numbers (allowed: [from, to])", ends.size()));
  }
  return {ends[0].number(kAnyNumber) * unit, ends[1].number(kAnyNumber) * unit};
}

GenericCorrection::Node read_node(const SettingsNode& node) {
  return read_mapping(node, [](SettingsMapping& mapping) {
    return GenericCorrection::Node{
        .slip_ratio = mapping.number("slip_ratio", {.min = -1, .max = 1}),
        .slip_angle_rad = mapping.number("slip_angle_deg", {.min = 0, .max = 90}) * kDegree,
        .load_n = mapping.number("load_n", kAbove0),
        .fx_n = mapping.number_or("fx_n", kAnyNumber, 0),
        .fy_n = mapping.number_or("fy_n", kAnyNumber, 0),
        .torque_nm = mapping.number_or("torque_nm", kAnyNumber, 0),
        .sinkage_m = mapping.number_or("sinkage_m", kAnyNumber, 0)};
  });
}

std::string interval_text(const std::array<double, 2>& region, double unit) {
  return fmt::format("[{}, {}]", number_in_unit(region[0], unit), number_in_unit(region[1], unit));
}

}  // namespace

GenericCorrection read_correction(const SettingsNode& parameters) {
  return read_mapping(parameters, [](SettingsMapping& mapping) {
    GenericCorrection correction;
    correction.slip_scale = mapping.number("slip_scale", kAbove0);
    correction.slip_angle_scale_rad = mapping.number("slip_angle_scale_deg", kAbove0) * kDegree;
    correction.log_load_scale = mapping.number("log_load_scale", kAbove0);
    read_mapping(mapping.required("region"), [&](SettingsMapping& region) {
      correction.slip_ratio_region = read_interval(region.required("slip_ratio"), 1);
      correction.slip_angle_rad_region = read_interval(region.required("slip_angle_deg"), kDegree);
      correction.load_n_region = read_interval(region.required("load_n"), 1);
      return true;
    });
    correction.fade_share = mapping.number_or("fade_share", {.min = 0, .max = 0.5}, 0);
    for (const SettingsNode& node : mapping.required("nodes").list()) {
      correction.nodes.push_back(read_node(node));
    }
    validate(correction);
    return correction;
  });
}

std::string correction_text(const GenericCorrection& c, const std::string& indent) {
  std::string text;
  const auto line = [&](const std::string& content) { text += indent + content + "\n"; };
  line(fmt::format("slip_scale: {}", c.slip_scale));
  line(fmt::format("slip_angle_scale_deg: {}", number_in_unit(c.slip_angle_scale_rad, kDegree)));
  line(fmt::format("log_load_scale: {}", c.log_load_scale));
  line("region:");
  line(fmt::format("  slip_ratio: {}", interval_text(c.slip_ratio_region, 1)));
  line(fmt::format("  slip_angle_deg: {}", interval_text(c.slip_angle_rad_region, kDegree)));
  line(fmt::format("  load_n: {}", interval_text(c.load_n_region, 1)));
  line(fmt::format("fade_share: {}", c.fade_share));
  line(c.nodes.empty() ? "nodes: []" : "nodes:");
  for (const GenericCorrection::Node& node : c.nodes) {
    line(fmt::format(
        "  - {{slip_ratio: {}, slip_angle_deg: {}, load_n: {}, fx_n: {}, fy_n: {}, torque_nm: {}, "
        "sinkage_m: {}}}",
        node.slip_ratio, number_in_unit(node.slip_angle_rad, kDegree), node.load_n, node.fx_n,
        node.fy_n, node.torque_nm, node.sinkage_m));
  }
  return text;
}

}  // namespace regoplan
