#include "tools/offline/mount_csv.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/files/csv_rows.h"
#include "geometry/angles.h"

namespace ols::offline {
namespace {

// Pixels to directions of the camera (x right, y down, z forward).
Eigen::Matrix3d directions(double hfov_rad, const cv::Size& image) {
  const double focal_px = 0.5 * image.width / std::tan(0.5 * hfov_rad);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Identity();
  inverse(0, 0) = inverse(1, 1) = 1.0 / focal_px;
  inverse(0, 2) = -0.5 * (image.width - 1) / focal_px;
  inverse(1, 2) = -0.5 * (image.height - 1) / focal_px;
  return inverse;
}

// Directions of the camera to those of the ground.
Eigen::Matrix3d attitude(double azimuth_rad, double elevation_rad) {
  return (Eigen::AngleAxisd(azimuth_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(elevation_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

MountFile::MountFile(const std::string& path) {
  const csv::Header<4> header{{"frame", "azimuth_deg", "elevation_deg", "hfov_deg"}, 4};
  csv::for_each_row<4>(path, header, [this](const csv::Row<4>& row) {
    const auto frame = row.number<long>(0, 0, 1'000'000'000);
    const Pointing pointing{radians(row.number<double>(1, -360.0, 360.0)),
                            radians(row.number<double>(2, -90.0, 90.0)),
                            radians(row.number<double>(3, 0.001, 170.0))};
    if (!pointings_.emplace(frame, pointing).second) row.fail(0, "the frame has a row already");
  });
}

std::optional<Eigen::Matrix3d> MountFile::motion_to(long frame, const cv::Size& image) const {
  const auto before = pointings_.find(frame - 1), now = pointings_.find(frame);
  if (before == pointings_.end() || now == pointings_.end()) return std::nullopt;
  const Pointing &from = before->second, &to = now->second;
  const Eigen::Matrix3d turn = attitude(to.azimuth_rad, to.elevation_rad).transpose() *
                               attitude(from.azimuth_rad, from.elevation_rad);
  const Eigen::Matrix3d motion =
      directions(to.hfov_rad, image).inverse() * turn * directions(from.hfov_rad, image);
  return motion / motion(2, 2);
}

}  // namespace ols::offline
