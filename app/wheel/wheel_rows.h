#pragma once

#include <cstdint>
#include <iosfwd>
#include <stop_token>
#include <string>
#include <vector>

#include "terramech/wheel/wheel_model.h"

namespace regoplan {

/// Where the rows go; either may be null.
struct WheelRowSinks {
  std::ostream* csv = nullptr;   ///< row by row, as they are computed
  std::ostream* json = nullptr;  ///< {"rows": [...], "interrupted": false}, whole or nothing of it
};

struct WheelRowsResult {
  std::int64_t rows = 0;
  bool interrupted = false;
  std::vector<std::string> renamed;  ///< `input_<name>`, where the model writes <name>
};

/// Computes the wheel's forces for each row of a CSV table with the columns `load_n, slip_ratio,
/// slip_angle_deg`, one row at a time. Rows keep all their columns and get `fx_n, fy_n, torque_nm,
/// sinkage_m, fc_n, fb_n, status`, empty where there is no equilibrium.
/// \param file the table's name, for errors
/// \throws InputError naming file, line, column, value and allowed range, and for a table without
///   rows
WheelRowsResult compute_wheel_rows(std::istream& conditions, const std::string& file,
                                   const WheelModel& model, const WheelRowSinks& sinks,
                                   const std::stop_token& stop);

}  // namespace regoplan
