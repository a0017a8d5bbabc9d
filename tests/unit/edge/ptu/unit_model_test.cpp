#include "edge/ptu/unit_model.h"

#include <gtest/gtest.h>

namespace ols::ptu {
namespace {

TEST(UnitModel, IsReadFromTheVersion) {
  constexpr const char* kD46 =
      "Pan-Tilt Controller v2.12.1d1(C14/E), (C)2003 Directed Perception, Inc., All Rights "
      "Reserved";
  EXPECT_EQ(ptu_model(kD46), PtuModel::kClassic);
  EXPECT_EQ(ptu_name(kD46), "PTU-D46 v2.12.1d1(C14/E)");
  constexpr const char* kE46 = "Pan-Tilt Controller v3.3.0, (C)2010-2011 FLIR";
  EXPECT_EQ(ptu_model(kE46), PtuModel::kESeries);
  EXPECT_EQ(ptu_name(kE46), "PTU-E46 v3.3.0");
  for (const char* other : {"", "v", "what", "vv3", "Pan-Tilt Controller", "v9.1"}) {
    EXPECT_EQ(ptu_model(other), PtuModel::kUnknown) << other;
    EXPECT_EQ(ptu_name(other), other);
  }
}

TEST(UnitModel, EnvironmentOfBothFamilies) {
  const auto d46 = ptu_environment("Input 30 VDC @ 86 degF");
  ASSERT_TRUE(d46);
  EXPECT_DOUBLE_EQ(d46->supply_V, 30.0);
  EXPECT_DOUBLE_EQ(*d46->head_degC, 30.0);
  EXPECT_FALSE(d46->pan_degC);
  const auto e46 = ptu_environment("13.2,99,97,104");
  ASSERT_TRUE(e46);
  EXPECT_DOUBLE_EQ(e46->supply_V, 13.2);
  EXPECT_NEAR(*e46->head_degC, 37.22, 0.01);
  EXPECT_NEAR(*e46->tilt_degC, 40.0, 0.01);
  for (const char* other : {"", "30", "1,2,3", "1,2,3,4,5", "13.2,99,97,9999", "-3 99", "nan 5",
                            "Input 3000 VDC @ 86 degF"}) {
    EXPECT_FALSE(ptu_environment(other)) << other;
  }
}

}  // namespace
}  // namespace ols::ptu
