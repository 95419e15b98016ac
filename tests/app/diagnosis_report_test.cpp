#include "app/diagnose/diagnosis_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/app/browser_page.h"
#include "tests/app/diagnosis_fixture.h"

namespace regoplan {
namespace {

TEST(DiagnosisReport, BeginsWithTheFinding) {
  const DiagnosisRun run = claimed_diagnosis();
  const std::string page = diagnosis_report(run);
  EXPECT_NE(page.find("<h1 id=\"headline\">" + run.diagnosis.sentence + "</h1>"),
            std::string::npos);
  EXPECT_NE(page.find("these data cannot tell some explanations apart"), std::string::npos);
  EXPECT_NE(page.find("explains 97 % of the excess misfit"), std::string::npos);
}

TEST(DiagnosisReport, OfADifferenceTellsNamesApartFromTheModelHandedOn) {
  DiagnosisRun run = unexplained_diagnosis();
  run.diagnosis.share_explained = 0;  // by no name
  run.references.push_back(run.recording);
  const std::string unnamed = diagnosis_report(run);
  EXPECT_EQ(unnamed.find("explains 0 %"), std::string::npos);
  EXPECT_NE(unnamed.find("off on held-out conditions in fx_n by 0.07 (0.9), sinkage_m by 0.00014 "
                         "(0.0018) RMS"),
            std::string::npos);
  run = claimed_diagnosis();
  run.references.push_back(run.recording);
  const std::string named = diagnosis_report(run);
  EXPECT_NE(named.find("the names explain 97 % of what the difference is above noise"),
            std::string::npos);
}

TEST(DiagnosisReport, SaysThatItWasInterrupted) {
  DiagnosisRun run = claimed_diagnosis();
  run.diagnosis = {.interrupted = true};
  const std::string page = diagnosis_report(run);
  EXPECT_NE(page.find("The diagnosis was interrupted"), std::string::npos);
}

TEST(DiagnosisReport, TextOfTheRecordingIsNeverMarkup) {
  const std::string page = diagnosis_report(claimed_diagnosis());
  EXPECT_EQ(page.find("<b>markup</b>"), std::string::npos);
}

class DiagnosisReportInTheBrowser : public InTheBrowser {};

TEST_F(DiagnosisReportInTheBrowser, DrawsAClaimFromTheFindingDownToTheNumbers) {
  const std::string page = drawn(diagnosis_report(claimed_diagnosis()));
  expect_drawn_without_error(page);
  for (const char* text : {"slip sinkage or grousers", "slip ratio 0.3 to 0.4", "95&nbsp;%", "42.3",
                           "beyond", "measure torque", "held out by slip band", "Drawbar pull Fx",
                           "n = n0 + n1 s + n2 s^2 (s &gt; 0)"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
  // two channels: three maps, two panels in time and one for each of the two slip angles
  std::size_t pictures = 0;
  for (std::size_t at = page.find("role=\"img\""); at != std::string::npos;
       at = page.find("role=\"img\"", at + 1)) {
    ++pictures;
  }
  EXPECT_EQ(pictures, 2u * (3 + 2 + 2));
}

TEST_F(DiagnosisReportInTheBrowser, DrawsALineForEachLoadAndNamesIt) {
  DiagnosisRun run = claimed_diagnosis();
  const auto label_of = [](const std::string& load) { return ">" + load + "&nbsp;N</text>"; };
  EXPECT_EQ(drawn(diagnosis_report(run)).find(label_of("65")), std::string::npos) << "one load";
  std::vector<WheelRun>& runs = run.recording.recording.runs;
  for (std::size_t i = 0; i < runs.size(); i += 2) runs[i].load_n *= 0.5;
  const std::string page = drawn(diagnosis_report(run));
  expect_drawn_without_error(page);
  for (const char* load : {"32", "65"}) {
    EXPECT_NE(page.find(label_of(load)), std::string::npos) << load;
  }
}

TEST_F(DiagnosisReportInTheBrowser, BreaksTheLineOfMeansWhereTheRunsPause) {
  const auto lines_of = [&](double pause_s) {
    DiagnosisRun run = claimed_diagnosis();
    run.recording.recording.columns.time = true;
    double time_s = 0;
    for (WheelRun& at : run.recording.recording.runs) {
      at.conditions.time_s = time_s;
      time_s += at.run_id == "c2" ? pause_s : 600;
    }
    const std::string page = drawn(diagnosis_report(run));
    const std::size_t from = page.find("mean-in-time\" d=\"");
    const std::string path = page.substr(from, page.find('>', from) - from);
    return std::ranges::count(path, 'M');
  };
  EXPECT_EQ(lines_of(600), 1);
  EXPECT_EQ(lines_of(40000), 2);
}

TEST_F(DiagnosisReportInTheBrowser, DrawsEveryVerdictWithoutAnError) {
  const std::string consistent = drawn(diagnosis_report(consistent_diagnosis()));
  expect_drawn_without_error(consistent);
  EXPECT_NE(consistent.find("Nothing is claimed"), std::string::npos);
  EXPECT_NE(consistent.find("Smallest shown"), std::string::npos);
  const std::string unexplained = drawn(diagnosis_report(unexplained_diagnosis()));
  expect_drawn_without_error(unexplained);
  EXPECT_NE(unexplained.find("gaussian_bumps"), std::string::npos);
}

TEST_F(DiagnosisReportInTheBrowser, MapsTestMinusReferenceBesideWhatTheNamesMakeOfIt) {
  DiagnosisRun run = claimed_diagnosis();
  EXPECT_EQ(drawn(diagnosis_report(run)).find("by the names claimed"), std::string::npos);
  for (const RunResidual& at : run.diagnosis.residuals) {
    run.diagnosis.differences.push_back({.run = at.run,
                                         .channel = at.channel,
                                         .difference = 6 * at.noise,
                                         .standard_deviation = at.noise,
                                         .by_names = 5 * at.noise});
  }
  const std::string page = drawn(diagnosis_report(run));
  expect_drawn_without_error(page);
  for (const char* text : {"Test minus reference", "By the names claimed", "rms 6.0", "rms 5.0"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
}

TEST_F(DiagnosisReportInTheBrowser, SaysWhatAReferenceOrARepeatWouldDecide) {
  DiagnosisRun run = claimed_diagnosis();
  run.diagnosis.claims[0].equivalent = {"cohesion_drift"};
  const std::string page = drawn(diagnosis_report(run));
  EXPECT_NE(page.find("A reference (same rig and soil"), std::string::npos);
  EXPECT_NE(page.find("at another time, in another order, would tell cohesion drift"),
            std::string::npos);
}

TEST_F(DiagnosisReportInTheBrowser, DrawsWhatIsNotKnownAsNothing) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  DiagnosisRun run = claimed_diagnosis();
  Diagnosis& d = run.diagnosis;
  for (std::size_t i = 0; i < d.residuals.size(); i += 3) {
    d.residuals[i].noise = d.residuals[i].held_out = kNaN;
    d.residuals[i].held_out_standard_deviation = kNaN;
  }
  d.residuals[1].corrected = d.residuals[1].baseline = kNaN;
  d.where[0].ci95 = {kNaN, kNaN};
  d.fit[0].noise_floor = d.fit[1].corrected_rmse = kNaN;
  d.claims[0].parameters["n1"].standard_deviation = kNaN;
  expect_drawn_without_error(drawn(diagnosis_report(run)));
}

TEST_F(DiagnosisReportInTheBrowser, ListsTheRowsThatWereLeftOut) {
  DiagnosisRun run = claimed_diagnosis();
  run.recording.left_out = {
      {.run_id = "r17",
       .cell = {.line = 19, .column = "slip_angle_deg", .value = 90.04, .allowed = "-90 to 90"},
       .why = ""}};
  const std::string page = drawn(diagnosis_report(run));
  expect_drawn_without_error(page);
  EXPECT_NE(page.find("Left out: line 19, run r17: slip_angle_deg is 90.04 (allowed: -90 to 90)."),
            std::string::npos);
}

TEST_F(DiagnosisReportInTheBrowser, DrawsADiagnosisThatWasInterruptedAtOnce) {
  DiagnosisRun run = claimed_diagnosis();
  run.diagnosis = {.interrupted = true};
  expect_drawn_without_error(drawn(diagnosis_report(run)));
}

}  // namespace
}  // namespace regoplan
