#include "diagnosis/recording/recording.h"

#include <gtest/gtest.h>

namespace regoplan {
namespace {

TEST(Channel, BearsTheNameOfItsColumnWithItsUnit) {
  EXPECT_EQ(name(Channel::kFx), "fx_n");
  EXPECT_EQ(name(Channel::kTorque), "torque_nm");
  EXPECT_EQ(name(Channel::kRutRight), "rut_right_m");
}

}  // namespace
}  // namespace regoplan
