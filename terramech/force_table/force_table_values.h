#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terramech/force_table/force_table_axes.h"
#include "terramech/wheel/wheel_model.h"

/// The numbers of a force table, without the way that states are looked up in them.
namespace regoplan::force_table {

/// Intervals along each axis, at least 3.
struct Sizes {
  std::size_t loads = 0, slips = 0, laterals = 0;
};

/// Shares of the load in Fx and Fy that no direction of motion turns (a tilted bed).
struct ConstantShares {
  double x = 0, y = 0;
};

/// (Fx/load, Fy/load) without the constant shares, T/(r load) and h/r stand side by side, so that
/// all that a state needs of one load and slip are 16 numbers in a row.
inline constexpr std::size_t kChannels = 4;
enum Channel : std::uint8_t { kFx, kFy, kTorque, kSinkage };

struct Values {
  Axes axes;
  Sizes sizes;
  double per_load_min = 0;                  ///< 1/(smallest load)
  float loads_per_log = 0;                  ///< 1/ln(largest load/smallest load)
  std::array<std::int32_t, 4> intervals{};  ///< `sizes`, in the order of the axes
  ConstantShares constant;
  /// Coefficients of cubic B-splines: [braking, driving][load][slip][lateral][channel].
  std::vector<float> coefficients;

  /// Distances in `coefficients` between neighbours on an axis, and where the sides begin.
  std::size_t slip_stride = 0, load_stride = 0;
  std::array<std::size_t, 2> side{};
};

/// Values of the right size, all 0.
Values empty_values(const Axes& axes, const Sizes& sizes, const ConstantShares& constant);

/// Evaluates the model at the nodes of the axes. \pre the model carries all their loads
Values tabulate(const WheelModel& model, const Axes& axes, const Sizes& sizes,
                const ConstantShares& constant);

}  // namespace regoplan::force_table
