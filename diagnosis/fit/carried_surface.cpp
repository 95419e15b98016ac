#include "diagnosis/fit/carried_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace regoplan {

CarriedAt CarriedAt::of(const TestBed& bed) {
  std::map<int, int> passes;
  std::vector<double> speeds;
  bool has_course = false;
  for (const Condition& at : bed.conditions) {
    ++passes[at.conditions.pass];
    if (at.conditions.speed_mps > 0) speeds.push_back(at.conditions.speed_mps);
    has_course = has_course || at.when != bed.conditions.front().when;
  }
  CarriedAt carried;
  const auto most =
      std::ranges::max_element(passes, {}, [](const auto& one) { return one.second; });
  carried.pass = most->first;
  if (speeds.size() == bed.conditions.size()) {
    const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
    std::ranges::nth_element(speeds, middle);
    carried.speed_mps = *middle;
  }
  constexpr double kMiddle = 0.5;
  carried.when = has_course ? kMiddle : bed.conditions.front().when;
  return carried;
}

Condition CarriedAt::at(Condition place) const {
  place.conditions.pass = pass;
  place.conditions.speed_mps = speed_mps;
  place.when = when;
  return place;
}

bool varies_beyond_a_model_file(const TestBed& bed) {
  const CarriedAt carried = CarriedAt::of(bed);
  return std::ranges::any_of(bed.conditions, [&](const Condition& at) {
    return at.conditions.pass != carried.pass || at.when != carried.when ||
           (carried.speed_mps > 0 && at.conditions.speed_mps != carried.speed_mps);
  });
}

std::string words_of_carried(const TestBed& bed) {
  if (!varies_beyond_a_model_file(bed)) return "";
  const CarriedAt carried = CarriedAt::of(bed);
  const std::size_t elsewhere = static_cast<std::size_t>(std::ranges::count_if(
      bed.conditions, [&](const Condition& at) { return at.conditions.pass != carried.pass; }));
  std::string where;
  const auto add = [&](const std::string& one) { where += (where.empty() ? "" : ", ") + one; };
  if (elsewhere > 0) {
    add(fmt::format("pass {} ({} of {} conditions are of others)", carried.pass, elsewhere,
                    bed.conditions.size()));
  }
  if (carried.speed_mps > 0) add(fmt::format("{:.3g} m/s", carried.speed_mps));
  if (std::ranges::any_of(bed.conditions,
                          [&](const Condition& at) { return at.when != carried.when; })) {
    add("the middle of the course");
  }
  return "the corrected model's correction without a name knows slip, slip angle and load alone: "
         "it "
         "is that of " +
         where;
}

CarriedSurface::CarriedSurface(const TestBed& bed, std::size_t channel, std::size_t setting,
                               const Discrepancy& discrepancy, const Eigen::VectorXd& left,
                               const CarriedAt& carried)
    : channel_(bed.channels[channel].channel),
      setting_(discrepancy_settings()[setting]),
      variance_(std::pow(setting_.amplitude * bed.channels[channel].scale, 2)),
      carried_(carried),
      measured_(conditions_of(bed, bed.channels[channel])),
      factor_(discrepancy.at(channel, setting).factor),
      weights_(factor_.solve(left)) {}

Eigen::VectorXd CarriedSurface::heights() const {
  Eigen::VectorXd heights = variance_ * weights_;
  const DiscrepancyScales& scales = discrepancy_scales()[setting_.scales];
  for (Eigen::Index i = 0; i < heights.size(); ++i) {
    const Condition& at = *measured_[static_cast<std::size_t>(i)];
    // At one slip angle the kernel of the drawbar pull is that of what else varies.
    heights[i] *= discrepancy_kernel(scales, Channel::kFx, carried_.at(at), at, setting_.sides);
  }
  return heights;
}

CarriedSurface::Predicted CarriedSurface::at(const ConditionsAt& places) const {
  std::vector<Condition> wanted;
  for (const Condition* place : places) wanted.push_back(carried_.at(*place));
  ConditionsAt there;
  for (const Condition& place : wanted) there.push_back(&place);
  const Eigen::MatrixXd cross =
      variance_ * discrepancy_kernels(discrepancy_scales()[setting_.scales], channel_, there,
                                      measured_, setting_.sides);
  const Eigen::MatrixXd half = factor_.matrixL().solve(cross.transpose());
  return {.mean = cross * weights_,
          .variance = (variance_ - half.colwise().squaredNorm().transpose().array()).max(0.0)};
}

}  // namespace regoplan
