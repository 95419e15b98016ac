#pragma once

#include <string>
#include <vector>

#include "app/diagnose_drive/drive_diagnosis_files.h"

namespace regoplan {

/// Folder beside diagnosis.json in which map, vehicle and scenario lie as the drives tell them:
/// corrected-map.
ResultFolder corrected_folder(const ResultFolder& results);

/// Whether the drives said enough of the ground for a map of their own.
bool has_corrected_map(const DriveDiagnosisRun& run);

/// Writes dem.tif, classes.tif, soils.yaml, rocks.csv, vehicle.yaml and scenario.yaml, the
/// diagnosed scenario with these: all or none. \pre has_corrected_map \throws InputError where the
/// folder takes no files
void write_corrected_map(const DriveDiagnosisRun& run, const ResultFolder& folder);

/// Takes away what an earlier run has left there, where this one hands nothing back.
void remove_corrected_map(const ResultFolder& folder);
std::vector<std::string> corrected_file_names();

}  // namespace regoplan
