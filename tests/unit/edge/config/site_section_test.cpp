#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "base/config/config_section.h"
#include "base/config/toml_config.h"
#include "edge/config/config.h"
#include "tests/unit/temp_dir.h"

namespace ols::station {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SiteKeys : public testing::Test {
 protected:
  StationSettings load(const std::string& own, const std::string& of_site) const {
    std::ofstream(path_, std::ios::trunc)
        << "id = \"s\"\nlens = {fx_px = 13333, fy_px = 13333}\n[camera]\ndevice = \"c\"\n"
        << "[ptu]\ndevice = \"p\"\n[calibration.sd]\nheading_deg = 0.1\nmount_deg = 0.1\n"
        << "[pose]\nheading_deg = 10\nlatitude_deg = 49.2\nlongitude_deg = 16.6\n"
        << "height_m = 250.0\n"
        << own;
    trust::SiteSettings site;
    site.number = 4;
    site.body = "number = 4\n[station]\n" + of_site;
    site_check(path_)(site, "site.toml");
    return load_station_settings(path_, site);
  }
  ~SiteKeys() override { std::remove(path_.c_str()); }

  const std::string path_ = temp_dir() + "site_keys_" + std::to_string(::getpid()) + ".toml";
};

TEST_F(SiteKeys, StandInForWhatTheStationDoesNotState) {
  const StationSettings settings =
      load("", "logic.slew_lease_max_s = 1.25\ntrust.clock_tolerance_s = 20\n");
  EXPECT_EQ(settings.station.slew_lease_max_s, 1.25);
  EXPECT_EQ(settings.trust.clock_tolerance_s, 20.0);
  EXPECT_EQ(settings.site.number, 4);
  EXPECT_THAT(settings.site.own, ElementsAre());
  EXPECT_EQ(settings.station.max_age_s, StationSettings{}.station.max_age_s) << "neither states it";
}

TEST_F(SiteKeys, TheStationsOwnFileWinsAndIsSaid) {
  const StationSettings settings = load("[logic]\nmax_age_s = 0.75\ncoast_s = 0.5\n",
                                        "logic.max_age_s = 2\nwatchdog.cpu_alarm_degC = 70\n");
  EXPECT_EQ(settings.station.max_age_s, 0.75);
  EXPECT_EQ(settings.host.cpu_alarm_degC, 70.0);
  EXPECT_THAT(settings.site.own, ElementsAre("logic.max_age_s"));
}

TEST_F(SiteKeys, OnlyWhatIsTheSameOnAllStationsIsTheSites) {
  for (const char* bad : {"id = \"x\"\n", "camera.device = \"x\"\n", "pose.heading_deg = 1\n",
                          "trust.mode = \"off\"\n", "logic.max_age_s = 99\n", "logic = 1\n"}) {
    EXPECT_THROW(load("", bad), ConfigError) << bad;
  }
  try {
    load("", "logic.max_age_s = 99\n");
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("site settings 4:3: station.logic.max_age_s"));
  }
}

TEST_F(SiteKeys, WithoutSettingsThereIsNothing) {
  load("", "");
  const StationSettings settings = load_station_settings(path_);
  EXPECT_EQ(settings.site.number, 0);
  EXPECT_FALSE(site_check(""));
}

}  // namespace
}  // namespace ols::station
