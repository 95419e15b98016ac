#include "terramech/force_table/force_table_values.h"

#include <algorithm>
#include <cmath>

#include "terramech/basics/cubic_spline.h"

namespace regoplan::force_table {
namespace {

std::vector<float> tabulate_side(const WheelModel& model, const Values& table, bool driving) {
  const auto& [loads, slips, laterals] = table.sizes;
  const auto share = [](std::size_t i, std::size_t n) {
    return static_cast<double>(i) / static_cast<double>(n);
  };
  const double radius_m = model.spec().wheel.radius_m;
  std::vector<double> values;
  values.reserve((loads + 1) * (slips + 1) * (laterals + 1) * kChannels);
  for (std::size_t i = 0; i <= loads; ++i) {
    const double load_n = load_at(table.axes, share(i, loads));
    for (std::size_t j = 0; j <= slips; ++j) {
      const double axle = axle_at(share(j, slips), driving);
      for (std::size_t k = 0; k <= laterals; ++k) {
        const double tangent = tangent_at(table.axes, axle, share(k, laterals));
        const WheelForces forces = model.forces(load_n, rolling(axle, tangent));
        values.insert(
            values.end(),
            {forces.fx_n / load_n - table.constant.x, forces.fy_n / load_n - table.constant.y,
             forces.torque_nm / (load_n * radius_m), forces.sinkage_m / radius_m});
      }
    }
  }
  using cubic_spline::coefficients;
  using cubic_spline::interpolate;
  const std::size_t rest = (slips + 1) * (laterals + 1) * kChannels;
  values = interpolate(values, 1, loads, rest);
  values = interpolate(values, coefficients(loads), slips, (laterals + 1) * kChannels);
  values = interpolate(values, coefficients(loads) * coefficients(slips), laterals, kChannels);
  return {values.begin(), values.end()};
}

}  // namespace

Values empty_values(const Axes& axes, const Sizes& sizes, const ConstantShares& constant) {
  Values table{
      .axes = axes,
      .sizes = sizes,
      .per_load_min = 1 / axes.load_min_n,
      .loads_per_log = static_cast<float>(1 / std::log(axes.load_max_n / axes.load_min_n)),
      .intervals = {static_cast<std::int32_t>(sizes.loads), static_cast<std::int32_t>(sizes.slips),
                    static_cast<std::int32_t>(sizes.laterals), 1},
      .constant = constant,
      .coefficients = {}};
  using cubic_spline::coefficients;
  table.slip_stride = coefficients(sizes.laterals) * kChannels;
  table.load_stride = coefficients(sizes.slips) * table.slip_stride;
  table.side = {0, coefficients(sizes.loads) * table.load_stride};
  table.coefficients.resize(2 * table.side[1]);
  return table;
}

Values tabulate(const WheelModel& model, const Axes& axes, const Sizes& sizes,
                const ConstantShares& constant) {
  Values table = empty_values(axes, sizes, constant);
  auto to = table.coefficients.begin();
  for (const bool driving : {false, true}) {
    to = std::ranges::copy(tabulate_side(model, table, driving), to).out;
  }
  return table;
}

}  // namespace regoplan::force_table
