#include "app/diagnose/diagnosis_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/diagnose/diagnosis_summary.h"
#include "app/settings/model_settings.h"
#include "tests/app/diagnosis_fixture.h"
#include "tests/scratch_folder.h"
#include "tests/terramech/csv_rows.h"

namespace regoplan {
namespace {

using Json = nlohmann::json;

Json parsed(const DiagnosisRun& run) {
  return Json::parse(diagnosis_json(run));
}

TEST(DiagnosisSummary, SaysWhySharesAreMoreThanTheWhole) {
  DiagnosisRun run = claimed_diagnosis();
  const std::string why = "above 100 %: on held-out runs the rest is less than the noise";
  run.diagnosis.claims[0].share = Share{.explained = 1.007, .low = 1.0, .high = 1.01};
  const std::string above = diagnosis_summary(run);
  EXPECT_NE(above.find("share 100.7 % (100.0 to 101.0)"), std::string::npos) << above;
  EXPECT_NE(above.find(why), std::string::npos) << above;
  run.diagnosis.claims[0].share = Share{.explained = 1.0, .low = 0.99, .high = 1.01};
  EXPECT_EQ(diagnosis_summary(run).find(why), std::string::npos);
}

TEST(DiagnosisJson, HoldsTheVerdictAndItsClaims) {
  const Json d = parsed(claimed_diagnosis());
  EXPECT_EQ(d["verdict"], "class");
  ASSERT_EQ(d["mechanisms"].size(), 1u);
  const Json& claim = d["mechanisms"][0];
  EXPECT_EQ(claim["id"], "slip_sinkage");
  EXPECT_EQ(claim["probability"], 0.953);
  EXPECT_EQ(claim["parameters"]["n1"]["value"], 0.31);
  EXPECT_EQ(claim["parameters"]["n1"]["std"], 0.04);
  EXPECT_EQ(claim["equivalent"], Json({"grousers"}));
  EXPECT_EQ(claim["channels"], Json({"sinkage_m", "fx_n"}));
  EXPECT_EQ(claim["evidence_nats"], 12.5);
}

TEST(DiagnosisJson, RankingIsOfEveryCandidateInItsOrder) {
  const Json d = parsed(claimed_diagnosis());
  ASSERT_EQ(d["ranking"].size(), 4u);
  double sum = 0;
  for (const Json& candidate : d["ranking"]) sum += candidate["probability"].get<double>();
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(d["ranking"][1]["id"], "grousers");
}

TEST(DiagnosisJson, SaysWhereByColumnsOfTheRecording) {
  const Json where = parsed(claimed_diagnosis())["where"];
  ASSERT_EQ(where.size(), 1u);
  EXPECT_EQ(where[0]["channel"], "sinkage_m");
  EXPECT_EQ(where[0]["region"], Json({{"slip_ratio", {0.3, 0.4}}}));
  EXPECT_EQ(where[0]["effect"], 0.0031);
  EXPECT_EQ(where[0]["ci95"], Json({0.0024, 0.0038}));
  EXPECT_EQ(where[0]["p_value"], 1e-6);
  EXPECT_EQ(parsed(claimed_diagnosis())["where_off"], "soil_beside_claim");
}

TEST(DiagnosisJson, FitIsByChannelAndSaysHowConditionsWereHeldOut) {
  const Json d = parsed(claimed_diagnosis());
  EXPECT_EQ(d["fit"]["fx_n"]["noise_floor"], 0.1);
  EXPECT_EQ(d["fit"]["fx_n"]["baseline_rmse"], 2.0);
  EXPECT_EQ(d["fit"]["fx_n"]["calibrated_rmse"], 1.1);
  EXPECT_EQ(d["fit"]["sinkage_m"]["corrected_rmse"], 2.2e-4);
  EXPECT_EQ(d["fit"]["fx_n"]["held_out_by"], "slip band");
  EXPECT_EQ(d["held_out_by"], "slip band");
  EXPECT_EQ(d["share_explained"], 0.97);
  EXPECT_EQ(d["excess_is_clear"], true);
  EXPECT_EQ(d["lack_of_fit"]["before"]["f"], 40);
  EXPECT_EQ(d["lack_of_fit"]["after"]["critical"], 2.1);
  EXPECT_EQ(d["lack_of_fit"]["after"]["p_value"], 0.4);
}

TEST(DiagnosisJson, SaysWhatToMeasureNext) {
  const Json next = parsed(claimed_diagnosis())["next_experiment"];
  ASSERT_EQ(next.size(), 2u);
  EXPECT_EQ(next[0]["conditions"]["slip_ratio"], 0.8);
  EXPECT_EQ(next[0]["separates"], Json({"slip_sinkage", "grousers"}));
  EXPECT_EQ(next[0]["expected_gain_nats"], 3.2);
  EXPECT_TRUE(next[0]["further_sensor"].is_null());
  EXPECT_EQ(next[1]["further_sensor"], "torque_nm");
}

TEST(DiagnosisJson, WithoutAClaimSaysWhatCouldHaveBeenSeen) {
  const Json d = parsed(consistent_diagnosis());
  EXPECT_EQ(d["verdict"], "consistent");
  EXPECT_TRUE(d["mechanisms"].empty());
  EXPECT_EQ(d["smallest_detectable"]["slip_sinkage"]["value"], 0.05);
  EXPECT_EQ(d["smallest_detectable"]["slip_sinkage"]["parameter"], "n1");
  EXPECT_TRUE(d["smallest_detectable"]["rut_asymmetry"]["value"].is_null()) << "beyond its range";
}

TEST(DiagnosisJson, WhatIsNotFiniteIsNull) {
  EXPECT_TRUE(parsed(unexplained_diagnosis())["lack_of_fit"]["before"]["f"].is_null());
}

TEST(DiagnosisJson, KeepsTheNotesOfReadingAndTheIgnoredColumns) {
  DiagnosisRun run = claimed_diagnosis();
  run.setup.warnings = {"of the setup"};
  const Json d = parsed(run);
  EXPECT_EQ(d["notes"], Json({"of the setup", run.diagnosis.notes[0]}));
  EXPECT_EQ(d["ignored_columns"], Json({"note", "corrected_fx_n"}));
  EXPECT_EQ(d["seed"], 7);
  EXPECT_EQ(d["interrupted"], false);
}

TEST(DiagnosisJson, ListsTheRowsThatWereLeftOut) {
  DiagnosisRun run = claimed_diagnosis();
  run.recording.left_out = {
      {.run_id = "r17",
       .cell = {.line = 19, .column = "slip_angle_deg", .value = 90.04, .allowed = "-90 to 90"},
       .why = "r.csv:19: ..."}};
  const Json row = {{"line", 19},
                    {"run_id", "r17"},
                    {"column", "slip_angle_deg"},
                    {"value", 90.04},
                    {"allowed", "-90 to 90"}};
  EXPECT_EQ(parsed(run)["left_out"], Json::array({row}));
  EXPECT_TRUE(parsed(claimed_diagnosis())["left_out"].empty());
}

TEST(CorrectedModel, IsAModelFileWithTheSoilsSpread) {
  const ModelSettings read =
      read_model(parse_settings(corrected_model_text(claimed_diagnosis()), "c.yaml"));
  ASSERT_EQ(read.spec.mechanisms.size(), 1u);
  EXPECT_EQ(read.spec.mechanisms[0].parameters.at("n1"), 0.31);
  EXPECT_EQ(read.soil.mean.cohesion_pa, 800);
  EXPECT_EQ(read.soil.standard_deviation.cohesion_pa, 77);
  EXPECT_EQ(read.soil_name, "simulant");
  const ModelSettings generic =
      read_model(parse_settings(corrected_model_text(unexplained_diagnosis()), "c.yaml"));
  ASSERT_TRUE(generic.spec.generic);
  EXPECT_EQ(generic.spec.generic->nodes[0].fy_n, 2);
  EXPECT_EQ(generic.spec.generic->nodes[0].slip_angle_rad, 0.28);
}

TEST(CorrectedModel, SaysWhichNamesItDoesWithout) {
  EXPECT_EQ(corrected_model_text(claimed_diagnosis()).find("left out"), std::string::npos);
  DiagnosisRun run = claimed_diagnosis();
  run.diagnosis.claims = {{.id = "sensor_bias", .form = "fy_n", .probability = 0.99}};
  EXPECT_NE(corrected_model_text(run).find(
                "# sensor_bias is left out: a fault of an instrument is no part"),
            std::string::npos);
  run.diagnosis.claims = {{.id = "load_transfer", .form = "constant", .probability = 0.99}};
  EXPECT_NE(corrected_model_text(run).find(
                "# load_transfer is left out: a fault of an instrument is no part"),
            std::string::npos);
  run.diagnosis.claims = {{.id = "bearing_drag", .form = "linear", .probability = 0.99}};
  EXPECT_NE(corrected_model_text(run).find("# bearing_drag is left out: see the notes"),
            std::string::npos);
}

TEST(CorrectedModel, OfADiagnosisThatHadNoneYetIsTheModelItStartedFrom) {
  DiagnosisRun run = claimed_diagnosis();
  run.diagnosis = {.interrupted = true};
  const ModelSettings read = read_model(parse_settings(corrected_model_text(run), "c.yaml"));
  EXPECT_TRUE(read.spec.mechanisms.empty());
  EXPECT_EQ(read.soil.mean.cohesion_pa, 800);
}

TEST(ResidualsCsv, KeepsEveryColumnOfTheRecording) {
  const ScratchFolder folder;
  folder.write("residuals.csv", residuals_csv(claimed_diagnosis()));
  auto rows = csv_rows::read(folder.path("residuals.csv"));
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_EQ(rows[0]["run_id"], "a1");
  EXPECT_EQ(rows[0]["input_corrected_fx_n"], "1");
  EXPECT_NEAR(std::stod(rows[0]["corrected_fx_n"]), -9.15, 1e-12);
  EXPECT_NEAR(std::stod(rows[0]["noise_sinkage_m"]), 2e-4, 1e-12);
  EXPECT_EQ(rows[3]["held_out_sinkage_m"], "");  // not measured
}

TEST(DiagnosisFiles, AreAllThereOrNone) {
  const ScratchFolder folder;
  write_diagnosis_files(claimed_diagnosis(), {folder.path("out")});
  for (const char* name :
       {"diagnosis.json", "corrected-model.yaml", "residuals.csv", "report.html"}) {
    EXPECT_FALSE(folder.read(std::string("out/") + name).empty()) << name;
  }
  EXPECT_EQ(folder.count(), 6);
}

}  // namespace
}  // namespace regoplan
