#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edge/config/config.h"
#include "edge/ptu/ptu_kind.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "edge/sensors/gpsd/gpsd_kind.h"
#include "geometry/angles.h"

namespace ols::station {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

StationSettings bare() {
  StationSettings settings;
  settings.id = "alfa";
  settings.mount.as<ptu::PtuKind>()->unit.device = "/dev/ptu";
  return settings;
}

TEST(ConfigWords, AStationWithoutSurveyOrSensorsSaysWhatIsAssumed) {
  const auto lines = describe(bare());
  EXPECT_THAT(lines, Contains(StartsWith("station: alfa, bus udpm://")));
  EXPECT_THAT(lines, Contains(HasSubstr("pose: position from GNSS; tilt unknown: taken as level")));
  EXPECT_THAT(lines, Contains(StartsWith("ptu: /dev/ptu at ")));
}

TEST(ConfigWords, ADeviceThatIsNotConfiguredHasNoLine) {
  const auto lines = describe(bare());
  for (const char* device : {"inclinometer", "gnss", "gpio", "recorder"}) {
    EXPECT_THAT(lines, Not(Contains(StartsWith(device)))) << device;
  }
}

TEST(ConfigWords, ASurveyIsCheckedByTheSensorsThereAre) {
  StationSettings settings = bare();
  settings.pose.surveyed_position = Geodetic{radians(49.5), radians(16.25), 310.0};
  settings.pose.surveyed_tilt_rad = Eigen::Vector2d(radians(0.5), radians(-0.25));
  EXPECT_THAT(describe(settings),
              Contains(HasSubstr("position 49.5000000 16.2500000 310.00 m surveyed; tilt 0.5000 "
                                 "-0.2500 deg surveyed; heading")));
  settings.gnss.as<sensors::GpsdKind>()->gpsd.host = "localhost";
  settings.inclinometer.as<sensors::Dpg2Kind>()->dpg2.device = "/dev/dpg2";
  const auto lines = describe(settings);
  EXPECT_THAT(lines, Contains(HasSubstr("surveyed, checked by GNSS")));
  EXPECT_THAT(lines, Contains(HasSubstr("surveyed, checked by the inclinometer")));
  EXPECT_THAT(lines, Contains("gnss: gpsd at localhost:2947"));
}

TEST(ConfigWords, SaysWhetherThereIsAnEmergencyStop) {
  StationSettings settings = bare();
  settings.gpio.chip = "/dev/gpiochip0";
  EXPECT_THAT(describe(settings), Contains("gpio: /dev/gpiochip0, no emergency stop"));
  settings.gpio.stop_line = 0;
  EXPECT_THAT(describe(settings), Contains("gpio: /dev/gpiochip0, emergency stop on line 0"));
}

}  // namespace
}  // namespace ols::station
