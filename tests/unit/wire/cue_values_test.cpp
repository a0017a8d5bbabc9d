#include "wire/cue_values.h"

#include <gtest/gtest.h>

#include <limits>

namespace ols {
namespace {

CueValues good() { return {49.2, 16.6, 400.0, 30.0, 50.0, {40.0, -20.0, 1.0}, 3.0}; }

TEST(CueValues, AGoodOneHasNoFault) { EXPECT_EQ(fault_of(good()), CueFault::kNone); }

TEST(CueValues, EachFaultIsNamed) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (double CueValues::*field :
         {&CueValues::latitude_deg, &CueValues::longitude_deg, &CueValues::height_m,
          &CueValues::horizontal_sd_m, &CueValues::vertical_sd_m, &CueValues::velocity_sd_m_s}) {
      CueValues cue = good();
      cue.*field = bad;
      EXPECT_EQ(fault_of(cue), CueFault::kNotFinite);
    }
    CueValues cue = good();
    cue.velocity_enu_m_s[1] = bad;
    EXPECT_EQ(fault_of(cue), CueFault::kNotFinite);
  }
  const auto with = [](double CueValues::*field, double value) {
    CueValues cue = good();
    cue.*field = value;
    return fault_of(cue);
  };
  EXPECT_EQ(with(&CueValues::latitude_deg, 90.1), CueFault::kOutOfRange);
  EXPECT_EQ(with(&CueValues::latitude_deg, -89.95), CueFault::kPole);
  EXPECT_EQ(with(&CueValues::longitude_deg, 180.1), CueFault::kOutOfRange);
  EXPECT_EQ(with(&CueValues::height_m, -1001.0), CueFault::kOutOfRange);
  EXPECT_EQ(with(&CueValues::height_m, 100'001.0), CueFault::kOutOfRange);
  EXPECT_EQ(with(&CueValues::horizontal_sd_m, 0.0), CueFault::kOutOfRange);
  EXPECT_EQ(with(&CueValues::vertical_sd_m, 1.1e6), CueFault::kOutOfRange);
  EXPECT_EQ(with(&CueValues::velocity_sd_m_s, 3001.0), CueFault::kOutOfRange);
}

TEST(CueValues, TheSpeedIsThatOfAllAxes) {
  CueValues cue = good();
  cue.velocity_enu_m_s = {2900.0, 0.0, 0.0};
  EXPECT_EQ(fault_of(cue), CueFault::kNone);
  cue.velocity_enu_m_s = {2200.0, 2200.0, 0.0};
  EXPECT_EQ(fault_of(cue), CueFault::kOutOfRange);
}

TEST(CueValues, ATargetIsNamedByANumberAndACueNeverIs) {
  EXPECT_EQ(target_named("17"), 17);
  for (const char* name : {"", "0", "-3", "7a", "tak.7", "99999999999999999999"}) {
    EXPECT_FALSE(target_named(name)) << name;
  }
}

}  // namespace
}  // namespace ols
