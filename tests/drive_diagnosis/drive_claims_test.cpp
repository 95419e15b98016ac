#include "drive_diagnosis/drive_claims.h"

#include <gtest/gtest.h>

#include "tests/drive_diagnosis/simulated_drive.h"

namespace regoplan {
namespace {

/// How often a text has another in it.
int count_of(std::string_view part, std::string_view text) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string_view::npos;
       at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(DriveClaims, AZoneIsToldByTheChanceOfNoneAndByOneIntervalOfItsSoil) {
  // Standard deviations of the evidence stood beside the interval of one number, at odds with it.
  const DriveDiagnosis diagnosis = diagnose_drives(
      {record(
          {.weakness = [](double x_m) { return x_m > 140 && x_m < 170 ? 4.0 : 0.0; }, .seed = 11},
          rolling_map())},
      {.map = rolling_map(), .vehicle = preset_vehicle("lrv"), .gravity_mps2 = 1.62, .window_s = 5},
      {});
  ASSERT_EQ(diagnosis.claims.size(), 1u);
  const std::string& text = diagnosis.claims[0].text;
  EXPECT_EQ(count_of("standard deviations", text), 0) << text;
  EXPECT_EQ(count_of("95 %", text), 1) << text;
  EXPECT_EQ(count_of("by chance alone fewer than one of a million drives", text), 1) << text;
  EXPECT_LT(diagnosis.where.at(0).p_value, 1e-6);
}

TEST(DriveClaims, WhyASoilStaysAsTheMapHasItIsToldInASentence) {
  const std::string text = withheld_text({.held_out_nats = std::log(0.5)}, {.name = "mare"});
  EXPECT_EQ(count_of("mare stays as the map has it", text), 1) << text;
  EXPECT_EQ(count_of("0.5 times as likely", text), 1) << text;
}

}  // namespace
}  // namespace regoplan
