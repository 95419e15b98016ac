#include "app/wheel/wheel_rows.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "app/settings/model_settings.h"
#include "terramech/tables/csv_cells.h"
#include "tests/app/simulant_model.h"
#include "tests/error_text.h"

namespace regoplan {
namespace {

const WheelModel& simulant() {
  static const WheelModel model(read_model(parse_settings(kSimulantModel, "m.yaml")).spec);
  return model;
}

std::vector<std::vector<std::string>> rows_of(const std::string& table) {
  std::istringstream conditions(table);
  std::ostringstream csv;
  compute_wheel_rows(conditions, "c.csv", simulant(), {.csv = &csv}, {});
  std::istringstream lines(csv.str());
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(split_cells(line).value());
  return rows;
}

std::string rows_error(const std::string& table) {
  return error_text([&] { rows_of(table); });
}

TEST(WheelRows, CarryTheModelsForcesAndTheirTurnIntoThePathsDirections) {
  const double beta_rad = 12 * std::numbers::pi / 180;
  const WheelForces forces = simulant().forces(64.7, motion_at(0.3, beta_rad));
  const auto rows = rows_of("load_n,slip_ratio,slip_angle_deg\n64.7,0.3,12\n");
  ASSERT_EQ(rows.size(), 2);
  const std::vector<std::string> columns{"load_n", "slip_ratio", "slip_angle_deg", "fx_n",
                                         "fy_n",   "torque_nm",  "sinkage_m",      "fc_n",
                                         "fb_n",   "status"};
  EXPECT_EQ(rows[0], columns);
  EXPECT_EQ(std::stod(rows[1][3]), forces.fx_n);
  EXPECT_EQ(std::stod(rows[1][4]), forces.fy_n);
  EXPECT_EQ(std::stod(rows[1][5]), forces.torque_nm);
  EXPECT_EQ(std::stod(rows[1][6]), forces.sinkage_m);
  // Eqs. (18)(19) turn the force by the slip angle: its size stays.
  const double fc_n = std::stod(rows[1][7]);
  const double fb_n = std::stod(rows[1][8]);
  EXPECT_NEAR(std::hypot(fc_n, fb_n), std::hypot(forces.fx_n, forces.fy_n), 1e-9);
  EXPECT_NEAR(fc_n, forces.fx_n * std::sin(beta_rad) + forces.fy_n * std::cos(beta_rad), 1e-12);
  EXPECT_EQ(rows[1][9], "ok");
}

/// What the model writes of a row with one mechanism; nothing where a column is missing for it.
std::optional<std::vector<std::string>> row_with(const Mechanism& mechanism,
                                                 const std::string& columns,
                                                 const std::string& cells) {
  WheelModelSpec spec = simulant().spec();
  spec.mechanisms = {mechanism};
  std::istringstream conditions("load_n,slip_ratio,slip_angle_deg" + columns + "\n64.7,0.3,12" +
                                cells + "\n");
  std::ostringstream csv;
  const std::string refused = error_text(
      [&] { compute_wheel_rows(conditions, "c.csv", WheelModel(spec), {.csv = &csv}, {}); });
  if (!refused.empty()) {
    EXPECT_NE(refused.find(" is missing (" + mechanism.id), std::string::npos) << refused;
    return std::nullopt;
  }
  const std::string text = csv.str(), line = text.substr(text.find('\n') + 1);
  const auto all = split_cells(line.substr(0, line.find('\n'))).value();
  return std::vector<std::string>{all.end() - 7, all.end()};
}

TEST(WheelRows, AreRefusedWhereAMechanismNeedsAColumnThatIsNotThere) {
  const std::string columns = ",pass,speed_mps,position_m,time_s";
  for (const MechanismForm& form : mechanism_forms()) {
    const Mechanism mechanism{std::string(form.id), std::string(form.form), {}};
    const auto early = row_with(mechanism, columns, ",1,0.1,0.5,10"),
               late = row_with(mechanism, columns, ",3,0.2,5.5,1e6");
    ASSERT_TRUE(early && late) << form.id;
    if (form.id == "soil_change" && form.form != "for_a_time") continue;  // a change of nothing
    EXPECT_EQ(row_with(mechanism, "", "").has_value(), early == late)
        << form.id << " " << form.form;
  }
}

TEST(WheelRows, OfAModelWithRatesHaveASpeedAbove0) {
  WheelModelSpec spec = simulant().spec();
  spec.mechanisms = {{"rate_dependence", "stiffness", {}}};
  std::istringstream conditions("load_n,slip_ratio,slip_angle_deg,speed_mps\n60,0.2,0,0\n");
  std::ostringstream csv;
  EXPECT_NE(error_text([&] {
              compute_wheel_rows(conditions, "c.csv", WheelModel(spec), {.csv = &csv}, {});
            }).find("c.csv:2: speed_mps: 0 is not valid (allowed: above 0"),
            std::string::npos);
}

TEST(WheelRows, CellsAreEmptyWhereNoSinkageCarriesTheLoad) {
  const auto rows = rows_of("load_n,slip_ratio,slip_angle_deg\n1e7,0.1,0\n64.7,0.1,0\n");
  ASSERT_EQ(rows.size(), 3);
  for (std::size_t i = 3; i < 9; ++i) EXPECT_EQ(rows[1][i], "") << rows[0][i];
  EXPECT_EQ(rows[1][9], "sinks_to_axle");
  EXPECT_EQ(rows[2][9], "ok");
}

TEST(WheelRows, BeyondTheTestedSlipTheValueIsMarkedUntrusted) {
  const auto rows = rows_of("load_n,slip_ratio,slip_angle_deg\n64.7,0.97,0\n64.7,0.2,70\n");
  EXPECT_EQ(rows[1][9], "untrusted");
  EXPECT_NE(rows[1][3], "");
  EXPECT_EQ(rows[2][9], "untrusted");
}

TEST(WheelRows, KeepEveryColumnInItsPlaceAndAsItWasWritten) {
  const auto rows = rows_of(
      "run_id,slip_angle_deg,note,load_n,slip_ratio\r\n007,4,\"a, \"\"b\"\"\",64.70,.20\r\n");
  EXPECT_EQ(rows[1][0], "007");
  EXPECT_EQ(rows[1][2], "a, \"b\"");
  EXPECT_EQ(rows[1][3], "64.70");
}

TEST(WheelRows, AMeasuredColumnOfTheSameNameIsKeptUnderAnother) {
  const auto rows = rows_of("load_n,slip_ratio,slip_angle_deg,fx_n\n64.7,0.3,0,123\n");
  EXPECT_EQ(rows[0][3], "input_fx_n");
  EXPECT_EQ(rows[1][3], "123");
  EXPECT_EQ(rows[0][4], "fx_n");
  EXPECT_NE(rows[1][4], "123");
  const auto both = rows_of("load_n,slip_ratio,slip_angle_deg,fx_n,input_fx_n\n64.7,0.3,0,1,2\n");
  EXPECT_EQ(both[0][3], "input_input_fx_n");
  EXPECT_EQ(both[0][4], "input_fx_n");
}

TEST(WheelRows, ABadRowNamesLineColumnValueAndRange) {
  const std::string header = "load_n,slip_ratio,slip_angle_deg\n64.7,0,0\n";
  EXPECT_EQ(rows_error(header + "-1,0,0\n"), "c.csv:3: load_n: -1 is not valid (allowed: above 0)");
  EXPECT_EQ(rows_error(header + "64.7,1.01,0\n"),
            "c.csv:3: slip_ratio: 1.01 is not valid (allowed: -1 to 1)");
  EXPECT_EQ(rows_error(header + "64.7,0,nan\n"),
            "c.csv:3: slip_angle_deg: nan is not valid (allowed: -90 to 90)");
  EXPECT_EQ(rows_error(header + "64.7,,0\n"),
            "c.csv:3: slip_ratio: an empty cell is not valid (allowed: -1 to 1)");
  EXPECT_EQ(rows_error(header + "64.7,0\n"), "c.csv:3: 2 cells (the header has 3)");
  EXPECT_EQ(rows_error(header + "\n64.7,0,0\n"), "c.csv:3: an empty line");
  EXPECT_EQ(rows_error("load_n,slip_ratio\n1,0\n"), "c.csv:1: column slip_angle_deg is missing");
  EXPECT_EQ(rows_error("load_n,slip_ratio,Slip angle [deg]\n1,0,0\n"),
            "c.csv:1: column slip_angle_deg is missing (the header has Slip angle [deg])");
  EXPECT_EQ(rows_error("load_n,load_n\n"), "c.csv:1: column load_n given twice");
  EXPECT_EQ(rows_error(",,\n"), "c.csv:1: no column has a name (expected a header line)");
  EXPECT_EQ(rows_error(""), "c.csv: empty (expected a header line)");
  EXPECT_EQ(rows_error("load_n;slip_ratio\n1;0\n"),
            "c.csv:1: cells are separated by semicolons (allowed: commas)");
  EXPECT_EQ(rows_error("load_n\tslip_ratio\n"),
            "c.csv:1: cells are separated by tabs (allowed: commas)");
  EXPECT_EQ(rows_error("\xFF\xFEl"), "c.csv:1: the file is UTF-16 (allowed: UTF-8)");
}

TEST(WheelRows, MarksAndSeparatorsThatProgramsAddSayNothing) {
  const auto plain = rows_of("load_n,slip_ratio,slip_angle_deg\n64.7,0,0\n");
  EXPECT_EQ(rows_of("\xEF\xBB\xBF\"load_n\",\"slip_ratio\",slip_angle_deg\n64.7,0,0\n"), plain);
  EXPECT_EQ(rows_of("load_n,slip_ratio,,slip_angle_deg,,\n64.7,0,,0,,\n"), plain);
  EXPECT_EQ(rows_of(",load_n,slip_ratio,slip_angle_deg\n0,64.7,0,0\n"), plain);
  EXPECT_EQ(rows_error("load_n,slip_ratio,slip_angle_deg,\n64.7,0,0,5\n"),
            "c.csv:2: column 4, which has no name in the header: 5 is not valid (allowed: empty "
            "cells, or a name in the header)");
}

TEST(WheelRows, BlanksAroundCellsSayNothing) {
  EXPECT_EQ(rows_of("load_n, slip_ratio, slip_angle_deg\n64.7, 0, 0 \n"),
            rows_of("load_n,slip_ratio,slip_angle_deg\n64.7,0,0\n"));
}

TEST(WheelRows, ATableWithoutRowsIsAnError) {
  EXPECT_EQ(rows_error("load_n,slip_ratio,slip_angle_deg\n"), "c.csv: no rows below the header");
  EXPECT_EQ(rows_of("load_n,slip_ratio,slip_angle_deg\n64.7,0,0\n\n\n").size(), 2);
}

/// Rows that are made while they are read; counts how many have been asked for.
class EndlessTable : public std::streambuf {
 public:
  EndlessTable(std::ostringstream& out, long rows_max) : out_(out), rows_max_(rows_max) {}
  bool rows_came_out_before_all_were_read = false;

 protected:
  int_type underflow() override {
    if (rows_ == rows_max_) return traits_type::eof();
    if (rows_ == rows_max_ - 1) rows_came_out_before_all_were_read = out_.str().size() > 100;
    line_ = rows_++ == 0 ? "load_n,slip_ratio,slip_angle_deg\n" : "64.7,0.2,4\n";
    setg(line_.data(), line_.data(), line_.data() + line_.size());
    return traits_type::to_int_type(line_.front());
  }

 private:
  std::ostringstream& out_;
  long rows_max_;
  long rows_ = 0;
  std::string line_;
};

TEST(WheelRows, ComeOutOneByOneWhileTheTableIsRead) {
  std::ostringstream csv;
  EndlessTable table(csv, 2000);
  std::istream conditions(&table);
  const WheelRowsResult result =
      compute_wheel_rows(conditions, "c.csv", simulant(), {.csv = &csv}, {});
  EXPECT_EQ(result.rows, 1999);
  EXPECT_TRUE(table.rows_came_out_before_all_were_read);
}

TEST(WheelRows, AStopLeavesWholeRowsAndSaysSo) {
  std::stop_source stop;
  stop.request_stop();
  std::istringstream conditions("load_n,slip_ratio,slip_angle_deg\n64.7,0,0\n");
  std::ostringstream json;
  const WheelRowsResult result =
      compute_wheel_rows(conditions, "c.csv", simulant(), {.json = &json}, stop.get_token());
  EXPECT_TRUE(result.interrupted);
  const auto parsed = nlohmann::json::parse(json.str());
  EXPECT_EQ(parsed["interrupted"], true);
  EXPECT_TRUE(parsed["rows"].empty());
}

TEST(WheelRows, JsonSaysWhatTheTableSays) {
  std::istringstream conditions("load_n,slip_ratio,slip_angle_deg,id\n64.7,0,0,a\n1e7,0,0,\n");
  std::ostringstream json;
  compute_wheel_rows(conditions, "c.csv", simulant(), {.json = &json}, {});
  const auto rows = nlohmann::json::parse(json.str())["rows"];
  ASSERT_EQ(rows.size(), 2);
  EXPECT_EQ(rows[0]["fx_n"], simulant().forces(64.7, motion_at(0, 0)).fx_n);
  EXPECT_EQ(rows[0]["id"], "a");
  EXPECT_TRUE(rows[1]["fx_n"].is_null());
  EXPECT_EQ(rows[1]["status"], "sinks_to_axle");
}

TEST(WheelRows, JsonIsWholeOrNothing) {
  for (const auto& [last, error] :
       {std::pair{"-1,0,0,a\n", "c.csv:3: load_n: -1 is not valid (allowed: above 0)"},
        std::pair{"64.7,0,0,\xE4\n",
                  "c.csv:3: id: not UTF-8, which JSON needs; remedy: iconv -f LATIN1 -t UTF-8"}}) {
    std::istringstream conditions(std::string("load_n,slip_ratio,slip_angle_deg,id\n64.7,0,0,a\n") +
                                  last);
    std::ostringstream json;
    EXPECT_EQ(error_text([&] {
                compute_wheel_rows(conditions, "c.csv", simulant(), {.json = &json}, {});
              }),
              error);
    EXPECT_EQ(json.str(), "");
  }
}

}  // namespace
}  // namespace regoplan
