#include "app/wheel/wheel_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <istream>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "app/io/held_text.h"
#include "terramech/basics/angles.h"
#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"
#include "terramech/tables/csv_cells.h"
#include "terramech/tables/csv_table.h"
#include "terramech/tables/number_text.h"
#include "terramech/wheel/cornering_force.h"

namespace regoplan {
namespace {

struct Condition {
  const char* column;
  ValueRange allowed;
};
constexpr std::array<Condition, 3> kConditions{{
    {"load_n", kAbove0},
    {"slip_ratio", {.min = -1, .max = 1}},
    {"slip_angle_deg", {.min = -90, .max = 90}},
}};

/// Columns that a mechanism may need; each may be left out.
struct Circumstance {
  std::string_view column;
  ValueRange allowed;
  double WheelConditions::*member;
  double unit;
};
constexpr std::array<Circumstance, 5> kCircumstances{{
    {"speed_mps", kAtLeast0, &WheelConditions::speed_mps, 1},
    {"position_m", kAnyNumber, &WheelConditions::position_m, 1},
    {"time_s", kAnyNumber, &WheelConditions::time_s, 1},
    {"heading_deg", kAnyNumber, &WheelConditions::heading_rad, kDegree},
    {"wheel_angle_deg", kAnyNumber, &WheelConditions::wheel_angle_rad, kDegree},
}};
constexpr ValueRange kPasses{.min = 1, .max = 1e6};

/// A mechanism that says nothing where a column is not told, in one form or (empty) in all.
struct Need {
  std::string_view id, form;
  std::string_view column;
  bool above_0 = false;
};
constexpr std::array<Need, 7> kNeeds{{
    {"multi_pass", "", "pass"},
    {"rate_dependence", "", "speed_mps", true},  // at rest there is no rate
    {"soil_zone", "", "position_m"},
    {"cohesion_drift", "", "time_s"},
    {"soil_change", "for_a_time", "time_s"},
    {"load_transfer", "drifting", "time_s"},
    {"load_transfer", "for_a_time", "time_s"},
}};

bool is_of(const Need& need, const Mechanism& mechanism) {
  return mechanism.id == need.id && (need.form.empty() || form_of(mechanism).form == need.form);
}

constexpr std::array<const char*, 7> kResults{"fx_n", "fy_n", "torque_nm", "sinkage_m",
                                              "fc_n", "fb_n", "status"};

using Cells = CsvTable::Cells;

std::vector<std::string> known_columns() {
  std::vector<std::string> known(kResults.begin(), kResults.end());
  for (const Condition& condition : kConditions) known.emplace_back(condition.column);
  for (const Circumstance& circumstance : kCircumstances) known.emplace_back(circumstance.column);
  known.emplace_back("pass");
  return known;
}

/// What the rows of a table say of the circumstances that mechanisms ask for.
class CircumstanceColumns {
 public:
  /// \throws InputError where a mechanism of the model needs a column that the table does not have
  CircumstanceColumns(const CsvTable& table, const WheelModel& model)
      : table_(table), pass_(table.find_column("pass")) {
    if (model.spec().mechanisms.empty()) return;
    for (const Circumstance& circumstance : kCircumstances) {
      if (const auto index = table.find_column(circumstance.column)) {
        told_.push_back({.index = *index, .circumstance = circumstance});
      }
    }
    for (const Mechanism& mechanism : model.spec().mechanisms) {
      for (const Need& need : kNeeds) {
        if (is_of(need, mechanism)) require(need);
      }
    }
  }

  WheelConditions in(const Cells& cells) const {
    WheelConditions conditions;
    for (const auto& [index, circumstance, why] : told_) {
      conditions.*circumstance.member =
          circumstance.unit * table_.number(cells, index, circumstance.allowed, why);
    }
    if (pass_) conditions.pass = static_cast<int>(table_.number(cells, *pass_, kPasses));
    return conditions;
  }

 private:
  struct Told {
    std::size_t index;
    Circumstance circumstance;
    std::string why = {};  ///< it may not be less
  };

  void require(const Need& need) {
    if (!table_.find_column(need.column)) {
      throw table_.error(
          fmt::format("column {} is missing ({} of the model needs it)", need.column, need.id));
    }
    if (!need.above_0) return;
    for (Told& told : told_) {
      if (told.circumstance.column != need.column) continue;
      told.circumstance.allowed = kAbove0;
      told.why = fmt::format("{} of the model needs it", need.id);
    }
  }

  const CsvTable& table_;
  std::optional<std::size_t> pass_;
  std::vector<Told> told_;
};

Cells result_cells(const WheelForces& forces, double slip_angle_rad) {
  Cells cells(kResults.size());
  cells.back() = name(forces.status);
  if (!has_forces(forces.status)) return cells;
  const TravelForces travel = travel_forces(forces.fx_n, forces.fy_n, slip_angle_rad);
  const std::array values{forces.fx_n,      forces.fy_n,        forces.torque_nm,
                          forces.sinkage_m, travel.cornering_n, travel.drag_n};
  std::ranges::transform(values, cells.begin(), number_cell);
  return cells;
}

std::string csv_line(const Cells& cells) {
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) line += ',';
    line += text_cell(cell);
  }
  return line + '\n';
}

/// \throws InputError where one of the texts is none that JSON can hold
void require_utf8(const CsvTable& table, const Cells& texts) {
  for (std::size_t i = 0; i < texts.size(); ++i) {
    try {
      std::ignore = nlohmann::json(texts[i]).dump();
    } catch (const nlohmann::json::type_error&) {
      throw table.error(fmt::format(
          "{}: not UTF-8, which JSON needs; remedy: iconv -f LATIN1 -t UTF-8", table.columns()[i]));
    }
  }
}

/// \throws InputError where one of its texts is none that JSON can hold
std::string json_row(const CsvTable& table, const Cells& columns, const Cells& cells) {
  nlohmann::ordered_json row = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::optional<double> number = parse_number(cells[i]);
    if (number) {
      row[columns[i]] = *number;
    } else if (cells[i].empty()) {
      row[columns[i]] = nullptr;
    } else {
      row[columns[i]] = cells[i];
    }
  }
  try {
    return row.dump();
  } catch (const nlohmann::json::type_error&) {
    require_utf8(table, cells);
    throw;
  }
}

}  // namespace

WheelRowsResult compute_wheel_rows(std::istream& conditions, const std::string& file,
                                   const WheelModel& model, const WheelRowSinks& sinks,
                                   const std::stop_token& stop) {
  CsvTable table(conditions, file);
  std::array<std::size_t, kConditions.size()> condition_columns{};
  for (std::size_t i = 0; i < kConditions.size(); ++i) {
    condition_columns.at(i) = table.required_column(kConditions.at(i).column, known_columns());
  }

  const CircumstanceColumns circumstances(table, model);

  WheelRowsResult result;
  Cells columns = names_beside(table.columns(), {kResults.begin(), kResults.end()});
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] != table.columns()[i]) result.renamed.push_back(columns[i]);
  }
  columns.insert(columns.end(), kResults.begin(), kResults.end());
  if (sinks.json) require_utf8(table, table.columns());
  std::optional<HeldText> json;  // whole, or nothing of it where a later row is bad
  if (sinks.json) json.emplace().add(R"({"rows": [)");

  while (std::optional<Cells> cells = table.next()) {
    if (stop.stop_requested()) break;
    std::array<double, kConditions.size()> values{};
    for (std::size_t i = 0; i < kConditions.size(); ++i) {
      values.at(i) = table.number(*cells, condition_columns.at(i), kConditions.at(i).allowed);
    }
    const auto [load_n, slip, slip_angle_deg] = values;
    const double slip_angle_rad = slip_angle_deg * kDegree;
    const WheelMotion motion = motion_at(slip, slip_angle_rad);
    const WheelForces forces =
        model.spec().mechanisms.empty()
            ? model.forces(load_n, motion)
            : model.channels(load_n, motion, circumstances.in(*cells)).forces;
    for (std::string& cell : result_cells(forces, slip_angle_rad)) {
      cells->push_back(std::move(cell));
    }
    if (sinks.csv) *sinks.csv << (result.rows ? "" : csv_line(columns)) << csv_line(*cells);
    if (json) json->add((result.rows ? ",\n" : "\n") + json_row(table, columns, *cells));
    if (sinks.csv && !*sinks.csv) throw InputError("the rows cannot be written (disk full?)");
    ++result.rows;
  }
  result.interrupted = stop.stop_requested();
  if (result.rows == 0 && !result.interrupted) {
    throw InputError(file + ": no rows below the header");
  }
  if (json) {
    json->add(fmt::format("\n], \"interrupted\": {}}}\n", result.interrupted));
    json->write_to(*sinks.json);
    if (!*sinks.json) throw InputError("the rows cannot be written (disk full?)");
  }
  return result;
}

}  // namespace regoplan
