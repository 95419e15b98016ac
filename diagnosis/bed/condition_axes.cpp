#include "diagnosis/bed/condition_axes.h"

#include <algorithm>
#include <cmath>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

constexpr double kSlipGap = 0.015;

ConditionAxis axis_of(const TestBed& bed, std::string column, double gap, const auto& value) {
  ConditionAxis axis{.column = std::move(column)};
  for (const Condition& at : bed.conditions) axis.value.push_back(value(at));
  const auto [low, high] = std::ranges::minmax(axis.value);
  // runs that were meant alike differ a little; a scale of the axis decides where none is known
  axis.level = levels(axis.value, gap > 0 ? gap : (high - low) / 50);
  axis.levels = 1 + std::ranges::max(axis.level);
  return axis;
}

}  // namespace

std::vector<ConditionAxis> condition_axes(const TestBed& bed) {
  std::vector<ConditionAxis> axes;
  const auto add = [&](std::string column, double gap, const auto& value) {
    ConditionAxis axis = axis_of(bed, std::move(column), gap, value);
    if (axis.levels > 1) axes.push_back(std::move(axis));
  };
  add("slip_ratio", kSlipGap, [](const Condition& at) { return at.slip_ratio; });
  bool left = false, right = false;
  for (const Condition& at : bed.conditions) {
    left = left || at.slip_angle_rad > 0.01;
    right = right || at.slip_angle_rad < -0.01;
  }
  const auto angle = [](const Condition& at) { return at.slip_angle_rad / kDegree; };
  const auto size = [](const Condition& at) { return std::abs(at.slip_angle_rad) / kDegree; };
  add(left && right ? "abs_slip_angle_deg" : "slip_angle_deg", 0.75,
      [&](const Condition& at) { return left && right ? size(at) : angle(at); });
  if (left && right) add("slip_angle_deg", 0.75, angle);
  // a level of load is where group_conditions() sees one
  add("load_n", 0, [](const Condition& at) { return at.load_n; });
  add("speed_mps", 0, [](const Condition& at) { return at.conditions.speed_mps; });
  add("pass", 0.5, [](const Condition& at) { return static_cast<double>(at.conditions.pass); });
  add("position_m", 0, [](const Condition& at) { return at.conditions.position_m; });
  add("time_s", 0, [](const Condition& at) { return at.conditions.time_s; });
  return axes;
}

bool follows_one_slip(const Condition& condition) {
  return condition.after_slip_range <= kSlipGap;
}

std::optional<ConditionAxis> memory_axis(const TestBed& bed) {
  ConditionAxis axis = axis_of(bed, "after_slip_ratio", kSlipGap,
                               [](const Condition& at) { return at.after_slip_ratio; });
  if (axis.levels < 2) return std::nullopt;
  return axis;
}

}  // namespace regoplan
