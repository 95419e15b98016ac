#include "tests/app/diagnosis_fixture.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "tests/app/simulant_model.h"

namespace regoplan {
namespace {

constexpr const char* kRecording =
    "run_id,load_n,slip_ratio,slip_angle_deg,fx_n,sinkage_m,note,corrected_fx_n\n"
    "a1,64.1,-0.2,0,-9.1,0.0121,,1\na2,64.9,-0.2,0,-9.3,0.0119,,1\n"
    "b1,64.7,0.1,0,3.1,0.0125,,1\nb2,64.7,0.1,0,3.0,,,1\n"
    "c1,65.2,0.4,0,8.8,0.0154,\"wet, cold\",1\nc2,64.7,0.4,0,8.9,0.0151,,1\n"
    "d1,64.7,-0.2,16,-8.8,0.0124,,1\nd2,64.7,-0.2,16,-8.9,0.0122,,1\n"
    "e1,64.7,0.1,16,2.6,0.0129,,1\ne2,64.7,0.1,16,2.7,0.0131,,1\n"
    "f1,64.7,0.4,16,8.1,0.0166,,1\nf2,64.7,0.4,16,8.2,0.0161,</script>,1\n";

}  // namespace

DiagnosisRun claimed_diagnosis() {
  std::istringstream stream(kRecording);
  DiagnosisRun run{.recording = read_recording(stream, "bed/r.csv"),
                   .setup_file = "bed/setup.yaml",
                   .setup = read_setup(parse_settings(kSimulantModel, "setup.yaml")),
                   .seed = 7};
  const Recording& recording = run.recording.recording;
  Diagnosis& d = run.diagnosis;
  d.verdict = Verdict::kClass;
  d.sentence = "Sinkage is 25 % above the model beyond slip 0.3; slip-sinkage or grousers.";
  d.notes = {"One note with <b>markup</b>."};
  d.claims = {{.id = "slip_sinkage",
               .form = "exponent",
               .probability = 0.953,
               .parameters = {{"n1", {0.31, 0.04}}},
               .equivalent = {"grousers"},
               .channels = {Channel::kSinkage, Channel::kFx},
               .evidence_nats = 12.5}};
  d.ranking = {{"slip_sinkage", 0.7}, {"grousers", 0.253}, {"none", 0.0}, {"parameters", 0.047}};
  d.where = {{.channel = Channel::kSinkage,
              .region = {{"slip_ratio", {0.3, 0.4}}},
              .effect = 0.0031,
              .ci95 = {0.0024, 0.0038},
              .p_value = 1e-6}};
  d.where_off = WhereOff::kSoilBesideClaim;
  d.fit = {{Channel::kFx, 0.1, 2.0, 1.1, 0.12}, {Channel::kSinkage, 2e-4, 3e-3, 1e-3, 2.2e-4}};
  d.held_out_by = "slip band";
  d.share_explained = 0.97;
  d.excess_is_clear = true;
  d.before = {.f = 40,
              .critical = 2.1,
              .p_value = 1e-9,
              .degrees_of_freedom = 10,
              .pure_error_degrees_of_freedom = 11};
  d.after = {.f = 1.1,
             .critical = 2.1,
             .p_value = 0.4,
             .degrees_of_freedom = 9,
             .pure_error_degrees_of_freedom = 11};
  d.soil = {{.parameter = "friction_angle_deg",
             .prior = {37.2, 1},
             .calibrated = {42.3, 0.4},
             .corrected = {37.5, 0.5},
             .pull = 5.1,
             .corrected_pull = 0.3}};
  d.next_experiments = {{.conditions = {{"load_n", 64.7}, {"slip_ratio", 0.8}},
                         .separates = {"slip_sinkage", "grousers"},
                         .expected_gain_nats = 3.2},
                        {.further_sensor = Channel::kTorque,
                         .separates = {"slip_sinkage", "grousers"},
                         .expected_gain_nats = 1.1}};
  for (std::size_t i = 0; i < recording.runs.size(); ++i) {
    for (const Channel channel : recording.channels) {
      const double measured = recording.runs[i].value(channel);
      if (std::isnan(measured)) continue;
      const double noise = channel == Channel::kFx ? 0.1 : 2e-4;
      d.residuals.push_back({.run = i,
                             .channel = channel,
                             .measured = measured,
                             .noise = noise,
                             .baseline = measured - 9 * noise,
                             .calibrated = measured + 4 * noise,
                             .corrected = measured - 0.5 * noise,
                             .held_out = measured - 0.7 * noise,
                             .held_out_standard_deviation = noise / 2});
    }
  }
  d.corrected_model = {.variant = run.setup.setup.variant,
                       .wheel = run.setup.setup.wheel,
                       .soil = run.setup.setup.soil.mean,
                       .mechanisms = {{"slip_sinkage", "exponent", {{"n1", 0.31}}}}};
  d.corrected_soil = run.setup.setup.soil;
  d.corrected_soil.standard_deviation.cohesion_pa = 77;
  return run;
}

DiagnosisRun consistent_diagnosis() {
  DiagnosisRun run = claimed_diagnosis();
  Diagnosis& d = run.diagnosis;
  d.verdict = Verdict::kConsistent;
  d.sentence = "The recording is consistent with the model.";
  d.claims.clear();
  d.where.clear();
  d.next_experiments.clear();
  d.ranking = {{"none", 0.98}, {"parameters", 0.02}};
  d.smallest_detectable = {{"slip_sinkage", "n1", 0.05, 0.1, 0.6},
                           {"slip_sinkage", "strength", 0.2, 0.5, 1.5},
                           {"rut_asymmetry", "kappa", 5.4, 0.2, 1, false}};
  d.after = d.before;
  for (RunResidual& residual : d.residuals) residual.corrected = residual.calibrated;
  d.corrected_model.mechanisms.clear();
  return run;
}

DiagnosisRun unexplained_diagnosis() {
  DiagnosisRun run = claimed_diagnosis();
  Diagnosis& d = run.diagnosis;
  d.verdict = Verdict::kUnexplained;
  d.sentence = "No known mechanism fits.";
  d.claims.clear();
  d.before.f = std::numeric_limits<double>::infinity();
  d.corrected_model.mechanisms.clear();
  d.corrected_model.generic = GenericCorrection{.slip_ratio_region = {-0.22, 0.42},
                                                .slip_angle_rad_region = {0, 0.3},
                                                .load_n_region = {60, 70},
                                                .fade_share = 0.04,
                                                .nodes = {{0.4, 0.28, 64.7, 1.5, 2, 0.1, 1e-3}}};
  return run;
}

DiagnosisRun interrupted_diagnosis() {
  DiagnosisRun run = claimed_diagnosis();
  run.diagnosis = undecided(run.recording.recording);
  return run;
}

}  // namespace regoplan
