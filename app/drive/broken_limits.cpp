#include "app/drive/broken_limits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "terramech/basics/angles.h"

namespace regoplan {
namespace {

using nlohmann::json;
constexpr int kMarksOfLimitMax = 80;

/// A limit that rows are held against.
struct HeldLimit {
  Rejection limit;
  double allowed = 0;                                                    ///< SI
  std::function<double(const DriveMoment&, const MarginMoment*)> value;  ///< NaN: not known
};

std::vector<HeldLimit> held_limits(const Limits& limits) {
  const auto strain = [](double WheelNow::*number) {
    return [number](const DriveMoment& moment, const MarginMoment*) {
      return largest_of_wheels(moment, number);
    };
  };
  const auto margin = [](double MarginMoment::*number) {
    return [number](const DriveMoment&, const MarginMoment* margins) {
      return margins == nullptr ? DriveResult::kNone : margins->*number;
    };
  };
  return {{Rejection::kSinkage, limits.sinkage_max_m, strain(&WheelNow::sinkage_m)},
          {Rejection::kSlip, limits.slip_max, strain(&WheelNow::slip)},
          {Rejection::kSlipAngle, limits.slip_angle_max_rad, strain(&WheelNow::slip_angle_rad)},
          {Rejection::kTraction, limits.margin_min, margin(&MarginMoment::traction)},
          {Rejection::kTipOver, limits.margin_min, margin(&MarginMoment::tip_over)},
          {Rejection::kCornering, limits.margin_min, margin(&MarginMoment::cornering)}};
}

json mark(Rejection reason, const DriveMoment& at, const std::optional<Exceeded>& exceeded) {
  const double si = quantity(reason).si_per_shown;
  return {{"reason", name(reason)},
          {"x_m", at.state.x_m},
          {"y_m", at.state.y_m},
          {"yaw_deg", degrees(at.state.yaw_rad)},
          {"speed_mps", std::hypot(at.state.motion.vx_mps, at.state.motion.vy_mps)},
          {"curvature_1pm", at.state.curvature_1pm},
          {"time_s", at.time_s},
          {"s_m", at.s_m},
          {"value", exceeded ? json(exceeded->found / si) : json()},
          {"limit", exceeded ? json(exceeded->limit / si) : json()}};
}

/// The worst row of each stretch in which a limit is broken; of more the first ones.
void add_stretches(const HeldLimit& held, const DriveResult& result, json& marks) {
  // Margins are known at some rows only, and hold until the next.
  auto margins = result.margins.begin();
  const MarginMoment* now = nullptr;
  const DriveMoment* worst = nullptr;
  double worst_value = 0;
  int count = 0;
  const auto end_stretch = [&] {
    if (worst && count++ < kMarksOfLimitMax) {
      marks.push_back(
          mark(held.limit, *worst, Exceeded{.found = worst_value, .limit = held.allowed}));
    }
    worst = nullptr;
  };
  for (const DriveMoment& moment : result.moments) {
    while (margins != result.margins.end() && margins->time_s <= moment.time_s) now = &*margins++;
    const double value = held.value(moment, now);
    const bool at_least = is_margin(held.limit);
    const bool broken = at_least ? value < held.allowed : std::abs(value) > held.allowed;
    if (!broken) {
      end_stretch();
      continue;
    }
    const bool further = at_least ? value < worst_value : std::abs(value) > std::abs(worst_value);
    if (!worst || further) {
      worst = &moment;
      worst_value = value;
    }
  }
  end_stretch();
}

/// The row nearest in time.
const DriveMoment& row_at(const DriveResult& result, double time_s) {
  const auto above = std::ranges::lower_bound(result.moments, time_s, {}, &DriveMoment::time_s);
  return above == result.moments.end() ? result.moments.back() : *above;
}

}  // namespace

double largest_of_wheels(const DriveMoment& moment, double WheelNow::*number) {
  double most = moment.wheels.empty() ? DriveResult::kNone : 0;
  for (const WheelNow& wheel : moment.wheels) {
    if (std::abs(wheel.*number) > std::abs(most)) most = wheel.*number;
  }
  return most;
}

json broken_limits_json(const Limits& limits, const DriveResult& result) {
  json marks = json::array();
  if (result.moments.empty()) return marks;
  for (const HeldLimit& held : held_limits(limits)) add_stretches(held, result, marks);
  const auto marked = [&](Rejection limit) {
    return std::ranges::any_of(marks,
                               [&](const json& one) { return one.at("reason") == name(limit); });
  };
  // What is broken between two rows only, and what no column of a wheel tells.
  for (const LimitBroken& one : result.broken) {
    if (marked(one.limit)) continue;
    marks.push_back(mark(one.limit, row_at(result, one.time_s), one.first));
    marks.back()["x_m"] = one.x_m;
    marks.back()["y_m"] = one.y_m;
  }
  if (!result.reached && result.reason) {
    marks.push_back(mark(*result.reason, result.moments.back(), result.exceeded));
  }
  return marks;
}

}  // namespace regoplan
