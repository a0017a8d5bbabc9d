#include "tools/offline/mount_csv.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "base/files/csv_files.h"
#include "tests/unit/error_text.h"
#include "tests/unit/temp_dir.h"

namespace ols::offline {
namespace {

const cv::Size kSize(641, 481);

MountFile read(const std::string& rows) {
  const std::string path = temp_dir() + "mount_csv_test.csv";
  std::ofstream(path) << "frame,azimuth_deg,elevation_deg,hfov_deg\n" << rows;
  return MountFile(path);
}

bool refuses(const std::string& rows, const std::string& part) {
  const std::string text = error_text<CsvError>([&] { read(rows); });
  return text.find(part) != std::string::npos;
}

Eigen::Vector2d moved(const Eigen::Matrix3d& motion, double x, double y) {
  return (motion * Eigen::Vector3d(x, y, 1.0)).hnormalized();
}

TEST(MountCsv, TurnOfTheCameraMovesTheSceneTheOtherWay) {
  const MountFile mount = read("0,350,10,20\n1,351,10,20\n2,351,9,20\n3,351,9,10\n");
  const double focal_px = 320.5 / std::tan(10.0 * std::numbers::pi / 180.0);
  const double degree_px = focal_px * std::tan(std::numbers::pi / 180.0);
  // A turn in azimuth, at 10 degrees of elevation, is a little less than a degree in the image.
  const Eigen::Vector2d right = moved(*mount.motion_to(1, kSize), 320.0, 240.0);
  EXPECT_NEAR(right.x(), 320.0 - degree_px * std::cos(10.0 * std::numbers::pi / 180.0), 0.1);
  EXPECT_NEAR(right.y(), 240.0, 0.2);
  const Eigen::Vector2d down = moved(*mount.motion_to(2, kSize), 320.0, 240.0);
  EXPECT_NEAR(down.x(), 320.0, 1e-6);
  EXPECT_NEAR(down.y(), 240.0 - degree_px, 1e-6);
  const Eigen::Vector2d zoomed = moved(*mount.motion_to(3, kSize), 330.0, 240.0);
  EXPECT_NEAR(zoomed.x(),
              320.0 + 10.0 * std::tan(std::numbers::pi / 18) / std::tan(std::numbers::pi / 36),
              1e-6);
}

TEST(MountCsv, FrameWithoutTwoRowsHasNoMotion) {
  const MountFile mount = read("0,350,10,20\n2,351,10,20\n");
  EXPECT_FALSE(mount.motion_to(0, kSize));
  EXPECT_FALSE(mount.motion_to(1, kSize));
  EXPECT_FALSE(mount.motion_to(2, kSize));
  EXPECT_FALSE(MountFile().motion_to(1, kSize));
}

TEST(MountCsv, WrongRowsAreNamed) {
  EXPECT_TRUE(refuses("0,1,2,20\n0,1,2,20\n", ":3: frame: "));
  EXPECT_TRUE(refuses("0,1,91,20\n", ":2: elevation_deg: "));
  EXPECT_TRUE(refuses("0,1,2,nan\n", ":2: hfov_deg: "));
  EXPECT_TRUE(refuses("0,1,2\n", ":2: row: "));
}

}  // namespace
}  // namespace ols::offline
