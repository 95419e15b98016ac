// Positions that do not lie where the map is are told with what is likely wrong with them.
#include <gtest/gtest.h>

#include <utility>

#include "drive_diagnosis/drive_diagnosis.h"
#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// What is found wrong with where a drive lies; empty where nothing is.
std::string place_told(DriveRecording drive) {
  const DriveSetup setup{
      .map = rolling_map(), .vehicle = {}, .uncertain = {}, .gravity_mps2 = 1.62};
  for (const DriveFinding& finding : diagnose_drives({std::move(drive)}, setup, {}).findings) {
    if (finding.id == "off_the_map" || finding.id == "other_coordinates") return finding.text;
  }
  return "";
}

TEST(DrivePlace, OnTheMapIsNotWorthAWord) {
  EXPECT_EQ(place_told(record({}, rolling_map())), "");
}

TEST(DrivePlace, ExchangedCoordinatesAreAskedFor) {
  DriveRecording drive = record({}, rolling_map());
  std::swap(drive.x_m, drive.y_m);
  EXPECT_NE(place_told(std::move(drive)).find("with x and y exchanged all of it would lie on"),
            std::string::npos);
}

TEST(DrivePlace, NoneOnTheMapAsksForTheCoordinates) {
  DriveRecording drive = record({}, rolling_map());
  for (double& x_m : drive.x_m) x_m += 1e5;
  const std::string told = place_told(std::move(drive));
  EXPECT_NE(told.find("100 % of the way lies off the map"), std::string::npos) << told;
  EXPECT_NE(told.find("are the positions in the map's coordinates"), std::string::npos) << told;
}

}  // namespace
}  // namespace regoplan
