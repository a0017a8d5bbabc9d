// Two calibrated stations whose sweeps show two walls.
#include "tools/calibrate/scenery_command.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "land/refraction.h"
#include "land/terrain_folder.h"
#include "tests/unit/edge/calibration/calibration_files.h"
#include "tests/unit/error_text.h"
#include "tests/unit/folder_test.h"
#include "tests/unit/land/painted_walls.h"
#include "tools/calibrate/stored_pictures.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;
using scenery::kMiddle;

constexpr double kApart_m = 200.0;

void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

class SceneryCommand : public FolderTest<> {
 protected:
  SceneryCommand() {
    const std::vector<float> heights(4, 100.0F);
    land::write_terrain_folder(options_.land = folder_ + "/land", {},
                               {{{"", "", 38.6, -28.6, 0.2, 0.2, 2, 2, 1.0}, heights}}, {});
    options_.output = folder_ + "/scenery.csv";
    add_station("alfa", -0.5 * kApart_m);
    add_station("bravo", 0.5 * kApart_m);
  }

  void add_station(const std::string& id, double east_m, double focal_px = 3333.0) {
    const Geodetic place = geodetic_from_ecef(LocalFrame(kMiddle).to_ecef({east_m, 0.0, 0.0}));
    const std::string config = folder_ + "/" + id + ".toml";
    const std::string pose = fmt::format(
        "[pose]\nlatitude_deg = {:.9f}\nlongitude_deg = {:.9f}\nheight_m = {:.3f}\n"
        "heading_deg = 0.0\n",
        degrees(place.latitude_rad), degrees(place.longitude_rad), place.height_m);
    write(
        config,
        fmt::format(
            "id = \"{0}\"\nstate_folder = \"{1}\"\n"
            "lens = {{fx_px = {2:.1f}, fy_px = {2:.1f}}}\n\n"
            "[camera]\ndevice = \"x\"\nwidth_px = 640\nheight_px = 240\n\n[ptu]\ndevice = \"p\"\n\n"
            "{3}\n[calibration.sd]\nheading_deg = 0.01\nmount_deg = 0.01\n"
            "tilt_deg = 0.01\nposition_m = 0.05\n",
            id, folder_, focal_px, pose));
    options_.stations.push_back(config);
    const station::StationSettings settings = station::load_station_settings(config);
    const fs::path current = fs::path(folder_) / "calibrations" / id / "current";
    fs::create_directories(current);
    write_calibration(current, settings, pose);
    write_pictures(current, settings.station.geometry, east_m);
  }
  static void write_calibration(const fs::path& folder, const station::StationSettings& settings,
                                const std::string& pose) {
    Instrument instrument = new_instrument(settings);
    instrument.covariance_file = "covariance.csv";
    const std::string known = instrument_text(instrument);
    const std::string setup = fmt::format(
        "station = \"{}\"\nobserved_utime_us = 1780000000000000\n\n{}"
        "tilt_x_deg = 0.0\ntilt_y_deg = 0.0\n\n[air]\nrefraction_k = 0.13\nair = 1.0\n",
        settings.id, pose);
    const std::string covariance = station::test::covariance_text(1e-10);
    const auto id = station::calibration_id_of(known, setup, covariance);
    write(folder / "setup.toml", fmt::format("# A setup.\ncalibration_id = {}\n{}", id, setup));
    write(folder / "instrument.toml", known);
    write(folder / "covariance.csv", covariance);
  }
  static void write_pictures(const fs::path& folder, const StationGeometry& geometry,
                             double east_m) {
    std::string lines;
    int pose = 0;
    for (const double pan_deg : {-8.0, 0.0, 8.0}) {
      const PanTilt angles{radians(pan_deg), 0.0};
      const StoredPicture picture{++pose,
                                  folder / fmt::format("{}.png", pose),
                                  0,
                                  {{.counts = 112000.0 * pan_deg / 360.0}, {}},
                                  angles};
      static std::map<std::array<double, 3>, cv::Mat1b> painted_once;
      cv::Mat1b& gray = painted_once[{east_m, pan_deg, geometry.camera.fx_px}];
      if (gray.empty()) gray = painted(geometry, angles, east_m);
      cv::imwrite(picture.file.string(), gray);
      lines += line_of(picture, folder) + "\n";
    }
    write(folder / kFramesFile, lines);
  }
  static cv::Mat1b painted(const StationGeometry& geometry, const PanTilt& angles, double east_m) {
    const Eigen::Matrix3d R = enu_from_camera(geometry.chain, angles).linear();
    cv::Mat1b gray(geometry.camera.height_px, geometry.camera.width_px);
    for (int y = 0; y < gray.rows; ++y) {
      for (int x = 0; x < gray.cols; ++x) {
        const Eigen::Vector3d ray = R * *unproject(geometry.camera, {x, y});
        gray(y, x) = scenery::painted_gray(east_m, azimuth_elevation_from_enu(ray), 1);
      }
    }
    return gray;
  }
  CommandReport run() {
    return write_scenery(options_, [](std::size_t, std::size_t) {});
  }
  std::string refusal() {
    return error_text<std::exception>([&] { run(); });
  }

  LocalFrame camera_of_alfa() const {
    const StationGeometry geometry =
        station::load_station_settings(options_.stations.front()).station.geometry;
    return LocalFrame(geodetic_from_ecef(camera_centre_ecef(geometry, {})));
  }

  SceneryOptions options_;
};

// The points on the near and on the far wall; all are on one of them. `alfa`: its camera.
std::array<int, 2> points_on_walls(const std::vector<land::SceneryRow>& rows,
                                   const LocalFrame& alfa) {
  std::array<int, 2> found{};
  for (const land::SceneryRow& row : rows) {
    const Eigen::Vector3d p_ecef =
        ecef_from_geodetic({radians(row.latitude_deg), radians(row.longitude_deg), row.height_m});
    const double north_m = LocalFrame(kMiddle).to_enu(p_ecef).y();
    const std::size_t wall = north_m < 1500.0 ? 0 : 1;
    ++found[wall];
    const double sd_m = std::hypot(row.range_sd_m, row.range_sd_systematic_m);
    EXPECT_NEAR(north_m, scenery::kWalls[wall].north_m, 4.0 * sd_m);
    EXPECT_LT(sd_m, 0.5 * land::kSceneryWide_rad * row.range_m);
    EXPECT_LT(row.height_sd_m, 1.0);
    const Eigen::Vector3d enu_m = alfa.to_enu(p_ecef);
    const auto seen = land::apparent(azimuth_elevation_from_enu(enu_m), enu_m.norm());
    EXPECT_NEAR(wrap_pi(seen.azimuth_rad - radians(row.azimuth_deg)), 0.0, 5e-6);
    EXPECT_NEAR(seen.elevation_rad, radians(row.elevation_deg), 1e-5);
    EXPECT_NEAR(enu_m.norm(), row.range_m, 0.02);
    EXPECT_GT(row.height_m, 103.0) << "the ground is at 100 m";
  }
  return found;
}

TEST_F(SceneryCommand, MeasuresWhatBothSweepsShow) {
  const CommandReport report = run();
  const auto rows = land::read_scenery(options_.output);
  EXPECT_EQ(report.summary.at(0).find(fmt::format("alfa and bravo: {} points;", rows.size())), 0U)
      << report.summary.at(0);
  const auto found = points_on_walls(rows, camera_of_alfa());
  EXPECT_GE(found[0], 20);
  EXPECT_GE(found[1], 20);
}

TEST_F(SceneryCommand, LensesMayDiffer) {
  fs::remove_all(fs::path(folder_) / "calibrations/bravo");
  options_.stations.pop_back();
  add_station("bravo", 0.5 * kApart_m, 5000.0);
  run();
  const auto found = points_on_walls(land::read_scenery(options_.output), camera_of_alfa());
  EXPECT_GE(found[0], 20);
  EXPECT_GE(found[1], 10);
}

TEST_F(SceneryCommand, APictureOfAnotherSizeIsNamed) {
  const fs::path picture = fs::path(folder_) / "calibrations/bravo/current/2.png";
  cv::imwrite(picture.string(), cv::Mat1b(120, 320, std::uint8_t{90}));
  EXPECT_NE(refusal().find(picture.string() + ": has 320 x 120 pixels"), std::string::npos)
      << refusal();
}

TEST_F(SceneryCommand, OneStationTwiceIsRefused) {
  options_.stations.push_back(options_.stations.front());
  EXPECT_NE(refusal().find("alfa and alfa are at the same place"), std::string::npos) << refusal();
}

TEST_F(SceneryCommand, AStationWithoutPicturesIsNamed) {
  fs::remove(fs::path(folder_) / "calibrations/bravo/current" / kFramesFile);
  EXPECT_NE(refusal().find("bravo/current/frames.jsonl: has no pictures of scenery"),
            std::string::npos)
      << refusal();
  EXPECT_FALSE(fs::exists(options_.output));
}

TEST_F(SceneryCommand, OneStationMeasuresNothing) {
  options_.stations.pop_back();
  EXPECT_NE(refusal().find("two or more stations are needed"), std::string::npos) << refusal();
}

// Both look north, but their sweeps show nothing alike.
TEST_F(SceneryCommand, NothingInCommonIsSaid) {
  for (const auto& picture :
       fs::directory_iterator(fs::path(folder_) / "calibrations/bravo/current")) {
    if (picture.path().extension() != ".png") continue;
    cv::imwrite(picture.path().string(), cv::Mat1b(240, 640, std::uint8_t{90}));
  }
  EXPECT_NE(refusal().find("no scenery was found"), std::string::npos) << refusal();
}

}  // namespace
}  // namespace ols::calibration
