#include "tools/setup/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/setup/answers_fixture.h"

namespace ols::setup {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kTime = "/etc/chrony/conf.d/ols-site.conf";

std::vector<std::string> paths(const Plan& plan) {
  std::vector<std::string> result;
  for (const PlannedFile& file : plan.files) result.push_back(file.path);
  return result;
}

TEST(Plan, AStationHasItsConfigurationTheRouteOfTheBusAndItsUnits) {
  Answers answers = read_answers(station_answers(), "a");
  add(answers.values, "station.camera.device", "Maker-1");
  add(answers.values, "station.ptu.device", "/dev/ols/ptu");
  add(answers.values, "station.ptu.device", "/dev/other");
  const Plan plan = plan_station(answers);
  EXPECT_THAT(paths(plan), ElementsAre("/etc/ols/alfa.toml", "/etc/ols/bus.env", kTime));
  EXPECT_THAT(plan.files[0].text, HasSubstr("device = \"/dev/ols/ptu\""));
  EXPECT_THAT(plan.files[1].text, HasSubstr("OLS_BUS_INTERFACE=eth0\n"));
  EXPECT_THAT(plan.units,
              ElementsAre("ols-bus.service", "ols-time.service", "ols-station@alfa.service"));
}

TEST(Plan, AMountNeedsADeviceOrAKindThatHasNone) {
  Values values;
  EXPECT_FALSE(has_mount(values));
  values = {{"station.mount.kind", "\"flir\""}};
  EXPECT_FALSE(has_mount(values));
  EXPECT_TRUE(has_mount({{"station.mount.kind", "\"fixed\""}}));
  for (const char* key : {"station.mount.device", "station.ptu.device"}) {
    EXPECT_TRUE(has_mount({{key, "\"p\""}})) << key;
    EXPECT_EQ(mount_device({{key, "\"p\""}}), "\"p\"") << key;
  }
  EXPECT_FALSE(has_camera(values));
  EXPECT_TRUE(has_camera({{"station.camera.device", "\"c\""}}));
}

TEST(Plan, AKindWithoutItsDeviceIsAnAnswerButHasToBeFound) {
  for (const char* kind : {"visca", "pelco-d", "indi"}) {
    const Answers answers = read_answers(
        station_answers("[station.mount]\nkind = \"" + std::string(kind) + "\"\n"), "a");
    EXPECT_FALSE(has_mount(answers.values)) << kind;
  }
  const Answers camera = read_answers(station_answers("[station.camera]\nkind = \"v4l2\"\n"), "a");
  EXPECT_FALSE(has_camera(camera.values));
  EXPECT_FALSE(wants_onvif(camera.values));
}

TEST(Plan, AStationWithoutMotionSaysSo) {
  Answers answers = read_answers(station_answers(), "a");
  add(answers.values, "station.camera.device", "Maker-1");
  add(answers.values, "station.mount.kind", "fixed");
  EXPECT_THAT(plan_station(answers).files[0].text,
              HasSubstr("[mount]  # What carries the camera.\nkind = \"fixed\""));
}

TEST(Plan, WithoutADeviceTheErrorNamesTheKey) {
  const Answers answers = read_answers(station_answers(), "a");
  EXPECT_THAT([&] { plan_station(answers); },
              testing::ThrowsMessage<ConfigError>(HasSubstr("camera.device: is missing")));
}

TEST(Plan, AReceiverGoesToGpsdAndItsTimeToChrony) {
  Answers answers = read_answers(station_answers(devices()), "a");
  answers.gnss = "/dev/ols/gnss";
  const Plan plan = plan_station(answers);
  EXPECT_THAT(paths(plan), ElementsAre("/etc/ols/alfa.toml", "/etc/ols/bus.env", kTime,
                                       "/etc/default/gpsd", "/etc/chrony/conf.d/ols-gnss.conf"));
  EXPECT_THAT(plan.files[3].text, HasSubstr("DEVICES=\"/dev/ols/gnss\"\n"));
  EXPECT_THAT(plan.files[4].text, HasSubstr("\nrefclock SHM 1 "));
  EXPECT_FALSE(plan.files[4].is_toml);
  EXPECT_THAT(plan.units, testing::Contains("gpsd.service"));
}

TEST(Plan, TheCentreHasWhatIsInstalled) {
  const Answers answers = read_answers(kCentreAnswers, "a");
  const Plan both = plan_centre(answers, {true, true});
  EXPECT_THAT(paths(both),
              ElementsAre("/etc/ols/bus.env", kTime, "/etc/ols/fusion.toml", "/etc/ols/logger.toml",
                          "/etc/ols/exporter.toml", "/etc/ols/console.toml"));
  EXPECT_THAT(both.files[3].text, HasSubstr("quota_gb = 5.0"));
  EXPECT_THAT(both.units, testing::Contains("ols-console.service"));
  EXPECT_THAT(plan_centre(answers, {true, false}).units,
              testing::Not(testing::Contains("ols-console.service")));
  EXPECT_EQ(plan_centre(answers, {false, true}).files.size(), 3U);
}

TEST(Plan, WithoutAnInterfaceTheBusStaysOnTheHost) {
  Answers answers = read_answers(kCentreAnswers, "a");
  answers.interface.clear();
  EXPECT_THAT(plan_centre(answers, {}).files[0].text, HasSubstr("OLS_BUS_INTERFACE=lo\n"));
}

}  // namespace
}  // namespace ols::setup
