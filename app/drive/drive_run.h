#pragma once

#include <string>
#include <vector>

#include "app/drive/drive_files.h"
#include "app/io/staged_files.h"

namespace regoplan {

/// How the drive went, in a few lines for a terminal.
std::string drive_summary(const DriveRecord& record);

/// Writes drive.csv, truth.json, drive.json and the page, all or none.
/// \throws InputError where the folder takes no files
void write_drive(const DriveRecord& record, const PlanningProblem& problem,
                 const ReferencePath& path, const TrueWorld& world, const ResultFolder& folder);
std::vector<std::string> drive_result_names(const std::string& page);

}  // namespace regoplan
