#pragma once

#include <string>

#include "app/io/staged_files.h"
#include "driving/drive.h"
#include "driving/true_world.h"
#include "planner/problem/planning_problem.h"

namespace regoplan {

/// A drive with what it was asked to be.
struct DriveRecord {
  std::string scenario, path;  ///< file names
  std::string truth;           ///< of the truth file; empty: as planned
  std::string truth_text;      ///< what stands in it
  std::vector<SoilZone> zones = {};
  std::string sensors;  ///< name or file of the sensors; empty: exact
  bool ends_in_goal = true;
  std::string page = "report.html";  ///< name of its page
  DriveSettings settings;
  DriveResult result;
};

/// The recording as a rover would bring it home, docs/drive.md.
std::string drive_csv(const DriveRecord& record, const Vehicle& vehicle);

/// How the drive went.
std::string drive_json(const DriveRecord& record, const PlanningProblem& problem);

/// What no rover knows.
std::string truth_json(const DriveRecord& record, const TrueWorld& world);

/// A limit that was broken, in a sentence.
std::string broken_text(const LimitBroken& broken);

/// How the drive went, in a sentence.
std::string drive_headline(const DriveRecord& record);

}  // namespace regoplan
