#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/diagnose/diagnosis_setup.h"
#include "app/diagnose/recording_file.h"
#include "app/io/staged_files.h"

namespace regoplan {

/// A diagnosis with all that it came from.
struct DiagnosisRun {
  RecordingFile recording;
  std::string setup_file;
  SetupSettings setup;
  std::uint64_t seed = 1;
  Diagnosis diagnosis;
  std::vector<RecordingFile> references = {};  ///< what the recording is compared with

  /// That of the recording, its wheel as the recording itself tells it.
  DiagnosisSetup own_setup() const { return setup_with(setup.setup, recording.wheel); }
};

/// What diagnosis.json holds; numbers that are not finite become null. Same input, same text.
nlohmann::ordered_json diagnosis_content(const DiagnosisRun& run);
std::string diagnosis_json(const DiagnosisRun& run);

/// The corrected model as a model file. An interrupted diagnosis that has none yet gives the model
/// it started from.
std::string corrected_model_text(const DiagnosisRun& run);

/// The recording with every column it had, and for each measured channel the value moved to the
/// mean load of its condition, its noise and what the models say there: `adjusted_*, noise_*,
/// baseline_*, calibrated_*, corrected_*, held_out_*, held_out_std_*`. A column of the recording
/// that has one of these names becomes `input_*`.
std::string residuals_csv(const DiagnosisRun& run);

/// Writes diagnosis.json, corrected-model.yaml, residuals.csv and report.html, all or none.
/// \throws InputError where the folder takes no files
void write_diagnosis_files(const DiagnosisRun& run, const ResultFolder& folder);
std::vector<std::string> diagnosis_file_names();

}  // namespace regoplan
