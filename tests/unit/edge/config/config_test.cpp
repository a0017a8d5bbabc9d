#include "edge/config/config.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "base/config/toml_config.h"
#include "edge/ptu/ptu_kind.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "edge/sensors/gpsd/gpsd_kind.h"
#include "geometry/angles.h"
#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols::station {
namespace {

const std::string kStart =
    "id = \"s\"\nlens = {fx_px = 13333, fy_px = 13333}\n[camera]\ndevice = \"c\"\n"
    "[ptu]\ndevice = \"p\"\n";
const std::string kSd = "[calibration.sd]\n";
const std::string kPlace = "latitude_deg = 49.2\nlongitude_deg = 16.6\nheight_m = 250.0\n";
const std::string kGnss = "[gnss]\nhost = \"127.0.0.1\"\n";
const std::string kTilt = "[inclinometer]\ndevice = \"t\"\n";

class StationConfigFile : public testing::Test {
 protected:
  // Completes what every configuration needs.
  StationSettings load(std::string text) {
    if (text.find(kSd) == std::string::npos) text += "\n" + kSd;
    text.insert(text.find(kSd) + kSd.size(), "heading_deg = 0.1\nmount_deg = 0.1\n");
    return load_exactly(text);
  }
  StationSettings load_exactly(const std::string& text) {
    std::ofstream(path_) << text;
    return load_station_settings(path_);
  }
  // The error without the file's name.
  std::string error(const std::string& text) {
    try {
      load(text);
    } catch (const ConfigError& error) {
      return std::string(error.what()).substr(path_.size());
    }
    return "none";
  }
  ~StationConfigFile() override { std::remove(path_.c_str()); }

  const std::string path_ = temp_dir() + "station_config_" + std::to_string(::getpid()) + ".toml";
};

TEST_F(StationConfigFile, TheLensAndTheDoubtOfTheCalibrationAreAskedFor) {
  const std::string pose = "[pose]\nheading_deg = 10\n" + kPlace;
  const auto asked = [&](const std::string& text) {
    return error_text<ConfigError>([&] { load_exactly(text); }, "none");
  };
  const std::string sd = kSd + "heading_deg = 0.1\n";
  EXPECT_NE(asked(kStart + pose).find("heading_deg"), std::string::npos);
  EXPECT_NE(asked(kStart + pose + sd).find("mount_deg"), std::string::npos);
  EXPECT_EQ(asked(kStart + pose + sd + "mount_deg = 0.1\n"), "none");
  std::string no_lens = kStart + pose + sd + "mount_deg = 0.1\n";
  no_lens.replace(no_lens.find("fx_px = 13333, "), 15, "");
  EXPECT_NE(asked(no_lens).find("fx_px"), std::string::npos);
}

TEST_F(StationConfigFile, ASurveyIsEnough) {
  const auto settings = load(kStart + "[pose]\nheading_deg = 10\ntilt_x_deg = 1.0\n" + kPlace +
                             "[calibration.sd]\nposition_m = 0.5\ntilt_deg = 0.1\n");
  ASSERT_TRUE(settings.pose.surveyed_position);
  EXPECT_NEAR(settings.pose.surveyed_position->latitude_rad, radians(49.2), 1e-12);
  EXPECT_EQ(settings.pose.surveyed_position_sd_m, 0.5);
  ASSERT_TRUE(settings.pose.surveyed_tilt_rad);
  EXPECT_NEAR(settings.pose.surveyed_tilt_rad->x(), radians(1.0), 1e-12);
  EXPECT_NEAR(settings.pose.surveyed_tilt_sd_rad, radians(0.1), 1e-12);
}

TEST_F(StationConfigFile, SensorsMaySupplyThePose) {
  const auto settings = load(kStart + kGnss + kTilt + "[pose]\nheading_deg = 10\n");
  EXPECT_FALSE(settings.pose.surveyed_position);
  EXPECT_FALSE(settings.pose.surveyed_tilt_rad);
  EXPECT_EQ(settings.gnss.as<sensors::GpsdKind>()->gpsd.host, "127.0.0.1");
}

TEST_F(StationConfigFile, TheSurveyOverridesTheSensors) {
  const auto settings =
      load(kStart + kGnss + kTilt + "[pose]\nheading_deg = 10\ntilt_y_deg = 0\n" + kPlace);
  EXPECT_TRUE(settings.pose.surveyed_position);
  EXPECT_TRUE(settings.pose.surveyed_tilt_rad);
}

TEST_F(StationConfigFile, ATiltThatNobodyToldIsNotTakenAsExact) {
  const std::string untold = kStart + "[pose]\nheading_deg = 10\n" + kPlace;
  EXPECT_FALSE(load(untold).pose.surveyed_tilt_rad);
  EXPECT_TRUE(load(untold + "[calibration.sd]\ntilt_deg = 0.2\n").pose.surveyed_tilt_rad)
      << "levelled, with a stated accuracy";
}

TEST_F(StationConfigFile, NamesWhatIsMissing) {
  EXPECT_EQ(error(kStart + "[pose]\nheading_deg = 10\n"), ":7: pose.latitude_deg: is missing");
  EXPECT_EQ(error(kStart + kGnss + "[pose]\nheading_deg = 10\nheight_m = 1\n"),
            ":9: pose.latitude_deg: is missing");
  EXPECT_EQ(error(kStart + "[pose]\n" + kPlace), ":7: pose.heading_deg: is missing");
  EXPECT_NE(error(kStart + "[gnss]\nport = 2947\n[pose]\nheading_deg = 1\n" + kPlace), "none");
  EXPECT_NE(error(kStart + "[gpio]\n[pose]\nheading_deg = 1\n" + kPlace), "none");
  EXPECT_EQ(error(kStart + "[gnss]\nhost = \"\"\n[pose]\nheading_deg = 1\n" + kPlace), "none");
}

// The search is never wider than a quarter of the image.
TEST_F(StationConfigFile, TheSearchFitsIntoTheImage) {
  const auto search_sd_px = [this](const std::string& camera) {
    std::string text = kStart + "[pose]\nheading_deg = 10\n" + kPlace;
    text.insert(text.find("[ptu]"), camera);
    return load(text).station.search_sd_px;
  };
  EXPECT_EQ(search_sd_px(""), StationConfig{}.search_sd_px);
  EXPECT_EQ(search_sd_px("width_px = 64\n"), 16.0);
}

TEST_F(StationConfigFile, ThePrincipalPointIsTheMiddleOfTheImage) {
  std::string text = kStart + "[pose]\nheading_deg = 10\n" + kPlace;
  text.insert(text.find("[ptu]"), "width_px = 641\nheight_px = 480\n");
  const auto lens = load(text).station.geometry.camera;
  EXPECT_EQ(lens.cx_px, 320.0);
  EXPECT_EQ(lens.cy_px, 239.5);
  EXPECT_EQ(lens.width_px, 641);
}

TEST_F(StationConfigFile, DescribesWhatIsConfigured) {
  const auto lines = describe(load(kStart + kGnss + "[pose]\nheading_deg = 10\n"));
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(
      lines[1],
      "pose: position from GNSS; tilt unknown: taken as level to 2.9 deg; heading 10.000 deg");
  EXPECT_EQ(lines[4], "gnss: gpsd at 127.0.0.1:2947");
}

TEST_F(StationConfigFile, AMountIsOfAKind) {
  const std::string rest = "[pose]\nheading_deg = 10\n" + kPlace;
  std::string fixed = kStart + rest;
  fixed.replace(fixed.find("[ptu]"), 19,
                "[mount]\nkind = \"fixed\"\npan_deg = 12\ntilt_deg = -3\n");
  const StationSettings settings = load(fixed);
  EXPECT_STREQ(settings.mount.name(), "fixed");
  EXPECT_FALSE(settings.station.moves);
  EXPECT_DOUBLE_EQ(settings.station.limits.pan_min_rad, radians(12.0));
  EXPECT_DOUBLE_EQ(settings.station.limits.tilt_max_rad, radians(-3.0));
  EXPECT_EQ(describe(settings)[3], "ptu: fixed at pan 12.00, tilt -3.00 deg");
  EXPECT_NE(error(fixed + "[ptu]\ndevice = \"p\"\n").find("is the former name"), std::string::npos);
  // [ptu] is a unit of FLIR, as [mount] is by default.
  for (const char* section : {"[ptu]", "[mount]"}) {
    std::string flir = kStart + rest;
    flir.replace(flir.find("[ptu]"), 5, section);
    const StationSettings unit = load(flir);
    EXPECT_STREQ(unit.mount.name(), "flir");
    EXPECT_TRUE(unit.station.moves);
    EXPECT_EQ(unit.mount.as<ptu::PtuKind>()->unit.device, "p");
  }
}

TEST_F(StationConfigFile, AWideLensIsOfAModelAndOfAFixedMount) {
  std::string fixed = kStart + "[pose]\nheading_deg = 10\n" + kPlace;
  fixed.replace(fixed.find("[ptu]"), 19, "[mount]\nkind = \"fixed\"\n");
  const auto with = [](std::string text, const std::string& keys) {
    return text.insert(text.find("fx_px"), keys + ", ");
  };
  const std::string wide = "model = \"fisheye\", k4 = 0.01";
  const auto lens = load(with(fixed, wide)).station.geometry.camera;
  EXPECT_EQ(lens.model, LensModel::kFisheye);
  EXPECT_EQ(lens.k4, 0.01);
  EXPECT_NE(error(with(fixed, wide + ", p1 = 0.1")).find("has no p1"), std::string::npos);
  EXPECT_NE(error(with(fixed, "k4 = 0.01")).find("lens.model: has no k4"), std::string::npos);
  const std::string turned = kStart + "[pose]\nheading_deg = 10\n" + kPlace;
  EXPECT_NE(error(with(turned, wide)).find("lens: a fisheye"), std::string::npos);
}

TEST_F(StationConfigFile, AWatchHasAMiddleAndAMountThatMoves) {
  const std::string rest = "[pose]\nheading_deg = 10\n" + kPlace;
  const std::string watch = "[watch]\nazimuth_deg = 350\nelevation_deg = 10\nsize_deg = [30, 5]\n";
  const WatchConfig read = load(kStart + rest + watch).station.watch;
  EXPECT_DOUBLE_EQ(read.middle.value().azimuth_rad, radians(350.0));
  EXPECT_DOUBLE_EQ(read.size_rad.x(), radians(30.0));
  EXPECT_FALSE(load(kStart + rest).station.watch.middle);
  EXPECT_NE(error(kStart + rest + "[watch]\nazimuth_deg = 350\n").find("elevation_deg: is missing"),
            std::string::npos);
  std::string fixed = kStart + rest + watch;
  fixed.replace(fixed.find("[ptu]"), 19, "[mount]\nkind = \"fixed\"\n");
  EXPECT_NE(error(fixed).find("watch: is for a mount that moves"), std::string::npos);
}

}  // namespace
}  // namespace ols::station
