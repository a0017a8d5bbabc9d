#include "central/admission/shared_mount.h"

#include <gtest/gtest.h>

namespace ols::fusion {
namespace {

const std::string kCamera = "ONVIF Maker Model, serial 17";

KnownStation stating(const std::string& mount, std::int64_t stated_s) {
  KnownStation station;
  station.traits.mount = mount;
  station.traits.stated_us = 1'000'000 * stated_s;
  return station;
}

TEST(SharedMount, TwoStationsOnOneCameraAreNamed) {
  const auto alarms = shared_mount_alarms({{"alfa", stating(kCamera, 100)},
                                           {"bravo", stating("ONVIF Maker Model, serial 18", 100)},
                                           {"charlie", stating(kCamera, 101)}});
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(alarms[0], "stations alfa and charlie: the same mount: " + kCamera);
}

TEST(SharedMount, MountsWithoutASerialNumberAndStationsThatHaveEndedShareNothing) {
  EXPECT_TRUE(
      shared_mount_alarms({{"alfa", stating("", 100)}, {"bravo", stating("", 100)}}).empty());
  EXPECT_TRUE(
      shared_mount_alarms({{"alfa", stating(kCamera, 100)}, {"bravo", stating(kCamera, 120)}})
          .empty());
}

TEST(SharedMount, AStationThatHasEndedHidesNoOther) {
  const auto alarms = shared_mount_alarms({{"alfa", stating(kCamera, 100)},
                                           {"bravo", stating(kCamera, 150)},
                                           {"charlie", stating(kCamera, 151)}});
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(alarms[0], "stations bravo and charlie: the same mount: " + kCamera);
}

}  // namespace
}  // namespace ols::fusion
