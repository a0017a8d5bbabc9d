#include "sim/scenario/station_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "edge/camera/aravis/aravis_kind.h"
#include "edge/config/config.h"
#include "edge/ptu/ptu_kind.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "edge/sensors/gpsd/gpsd_kind.h"
#include "edge/station/persisted_station_state.h"
#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

TEST(StationFiles, AreReadByTheStationAsTheNominalGeometry) {
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml"), 5);
  const auto folder = std::filesystem::path(temp_dir()) / ("files_" + std::to_string(::getpid()));
  const std::string state = folder / "state";
  write_station_files(world, {"udpm://239.255.76.67:7667?ttl=0", "/tmp/lines", state}, folder);
  for (const StationTruth& truth : world.stations()) {
    const station::StationSettings read =
        station::load_station_settings(folder / (truth.id + ".toml"));
    const StationGeometry& g = read.station.geometry;
    EXPECT_EQ(read.id, truth.id);
    EXPECT_EQ(read.state_folder, state);
    const station::PersistedStationState memory(state, truth.id, true);
    EXPECT_EQ(memory.begin(), station::StationState::kIdle);
    EXPECT_EQ(memory.doubt(), std::nullopt);
    EXPECT_LT((ecef_from_geodetic(g.position) - ecef_from_geodetic(truth.nominal.position)).norm(),
              1e-6);
    const PanTilt angles{0.3, 0.2};
    const Eigen::Isometry3d told = enu_from_camera(g.chain, angles);
    EXPECT_LT((told.matrix() - enu_from_camera(truth.nominal.chain, angles).matrix()).norm(),
              1e-12);
    EXPECT_GT((told.matrix() - enu_from_camera(truth.truth.chain, angles).matrix()).norm(), 1e-6)
        << "the truth must not leak";
    EXPECT_NEAR(g.camera.k1, truth.nominal.camera.k1, 1e-15);
    EXPECT_NEAR(g.camera.fx_px, truth.nominal.camera.fx_px, 1e-9);
    EXPECT_NEAR(g.sd.heading_rad, truth.nominal.sd.heading_rad, 1e-15);
    EXPECT_NEAR(g.sd.mount_roll_rad, truth.nominal.sd.mount_roll_rad, 1e-15);
    EXPECT_EQ(g.sd.position_m, truth.nominal.sd.position_m);
    EXPECT_EQ(read.clock.assumed_sd_s, truth.clock_sd_s);
    EXPECT_EQ(read.mount.as<ptu::PtuKind>()->unit.device, "/tmp/lines/" + truth.id + ".ptu");
    EXPECT_EQ(read.inclinometer.as<sensors::Dpg2Kind>()->dpg2.device,
              "/tmp/lines/" + truth.id + ".inclinometer");
    EXPECT_EQ(read.gnss.as<sensors::GpsdKind>()->gpsd.port,
              std::to_string(2950 + (&truth - world.stations().data())));
    EXPECT_EQ(read.gnss->config().ground_to_antenna_enu_m,
              world.scenario().gnss.ground_to_antenna_enu_m);
    EXPECT_NEAR(read.camera.as<camera::AravisKind>()->aravis.exposure_us, 2000.0, 1e-9);
  }
  std::filesystem::remove_all(folder);
}

TEST(StationFiles, HaveNoSensorsWhereTheScenarioHasNone) {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  scenario.inclinometer.on = scenario.gnss.on = false;
  const std::string file = station_file(World(scenario, 5), 0, {"", "/tmp/lines", ""});
  EXPECT_EQ(file.find("[inclinometer]"), std::string::npos);
  EXPECT_EQ(file.find("[gnss]"), std::string::npos);
}

TEST(StationFiles, SayWhichCameraStandsStill) {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  scenario.stations[0].fixed = PanTilt{radians(20.0), radians(4.0)};
  const std::string file = station_file(World(scenario, 5), 0, {"", "/tmp/lines", ""});
  EXPECT_NE(file.find("[mount]\nkind = \"fixed\"\npan_deg = 20"), std::string::npos) << file;
  scenario.stations[0].rtsp = true;
  const std::string by_rtsp = station_file(World(scenario, 1), 0, {});
  EXPECT_NE(by_rtsp.find("kind = \"rtsp\"\nurl = \"rtsp://127.0.0.11:8554/video\""),
            std::string::npos)
      << by_rtsp;
}

TEST(StationFiles, SayWhatAnOnvifCameraIs) {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/onvif.toml");
  scenario.onvif.port = 81;
  const std::string file = station_file(World(scenario, 5), 0, {"", "/tmp/lines", ""});
  EXPECT_NE(file.find("[mount]\nkind = \"onvif\"\n"
                      "url = \"http://127.0.0.11:81/onvif/device_service\"\nuser = \"admin\"\n"
                      "password_file = \"/tmp/lines/alfa.password\"\n"),
            std::string::npos)
      << file;
  const auto value = [&file](const std::string& key) {
    return std::stod(file.substr(file.find(key + " = ") + key.size() + 3));
  };
  EXPECT_NEAR(value("pan_gain_deg"), -170.0, 1e-9);
  EXPECT_NEAR(value("tilt_gain_deg"), 60.0, 1e-9);
  EXPECT_NEAR(value("tilt_zero_deg"), 30.0, 1e-9);
  EXPECT_NEAR(value("pan_speed_deg_s"), -60.0, 1e-9);
}

TEST(StationFiles, SayWhereAnIdleStationLooks) {
  Scenario scenario = load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml");
  scenario.stations[0].watch = AzimuthElevation{radians(20.0), radians(4.0)};
  scenario.stations[0].watch_size_rad = {radians(30.0), radians(5.0)};
  const auto folder = std::filesystem::path(temp_dir()) / ("watch_" + std::to_string(::getpid()));
  write_station_files(World(scenario, 5), {"udpm://239.255.76.67:7667?ttl=0", "/tmp/lines", ""},
                      folder);
  const auto watch_of = [&](std::size_t station) {
    return station::load_station_settings(folder / (scenario.stations[station].id + ".toml"))
        .station.watch;
  };
  EXPECT_NEAR(watch_of(0).middle.value().azimuth_rad, radians(20.0), 1e-12);
  EXPECT_NEAR(watch_of(0).middle.value().elevation_rad, radians(4.0), 1e-12);
  EXPECT_LT((watch_of(0).size_rad - scenario.stations[0].watch_size_rad).norm(), 1e-12);
  EXPECT_FALSE(watch_of(1).middle);
  std::filesystem::remove_all(folder);
}

TEST(StationFiles, AreReadFromAFolderOfAnyName) {
  const World world(load_scenario(std::string(OLS_SCENARIOS) + "/fig7.toml"), 5);
  const auto folder = std::filesystem::path(temp_dir()) / ("named_" + std::to_string(::getpid()));
  const std::string state = folder / "a \"quoted\" \\ state", lines = folder / "li\"nes";
  write_station_files(world, {"udpm://239.255.76.67:7667?ttl=0", lines, state}, folder);
  const std::string& id = world.stations()[0].id;
  const station::StationSettings read = station::load_station_settings(folder / (id + ".toml"));
  EXPECT_EQ(read.state_folder, state);
  EXPECT_EQ(read.mount.as<ptu::PtuKind>()->unit.device, lines + "/" + id + ".ptu");
  EXPECT_EQ(read.inclinometer.as<sensors::Dpg2Kind>()->dpg2.device,
            lines + "/" + id + ".inclinometer");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace ols::sim
