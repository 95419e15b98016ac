#pragma once

#include <string_view>

/// Files that the build puts into the program (see cmake/embed.cmake).
namespace regoplan::report_assets {

extern const std::string_view kD3;                ///< d3.min.js of Debian's node-d3
extern const std::string_view kD3Licence;         ///< its copyright file
extern const std::string_view kPageHtml;          ///< frame of every report
extern const std::string_view kPageCss;           ///< look of every report
extern const std::string_view kPageScript;        ///< what every report's script may use
extern const std::string_view kPlanHtml;          ///< sections of the planning report
extern const std::string_view kPlanScript;        ///< draws them
extern const std::string_view kEvaluationHtml;    ///< sections of the evaluation's map
extern const std::string_view kEvaluationScript;  ///< draws them
extern const std::string_view kManoeuvresScript;  ///< draws an evaluation without a map
extern const std::string_view kBenchmarkHtml;     ///< sections of the benchmark's report
extern const std::string_view kBenchmarkScript;   ///< draws them
extern const std::string_view kCompareHtml;       ///< sections of two results side by side
extern const std::string_view kCompareScript;     ///< draws them
extern const std::string_view kDiagnosisHtml;     ///< sections of the diagnosis
extern const std::string_view kDiagnosisScript;   ///< draws them
extern const std::string_view kDriveHtml;         ///< sections of a drive
extern const std::string_view kDriveScript;       ///< draws them
extern const std::string_view kLoopHtml;      ///< sections of plan, drive, diagnosis, plan again
extern const std::string_view kLoopScript;    ///< draws them
extern const std::string_view kDrivesHtml;    ///< sections of the diagnosis of drives
extern const std::string_view kDrivesScript;  ///< draws them

}  // namespace regoplan::report_assets
