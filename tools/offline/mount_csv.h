// Reads mount.csv, which states where a clip's camera pointed. Its columns are
// frame,azimuth_deg,elevation_deg,hfov_deg.
#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace ols::offline {

// Azimuths may have any zero direction. hfov_deg is the horizontal field of view of the whole
// image.
class MountFile {
 public:
  MountFile() = default;
  explicit MountFile(const std::string& path);  // throws CsvError

  // The homography that the camera's rotation and zoom cause: it maps the previous image's pixels
  // to those of image `frame`. Nullopt: the file has no row for one of the two.
  std::optional<Eigen::Matrix3d> motion_to(long frame, const cv::Size& image) const;

 private:
  struct Pointing {
    double azimuth_rad, elevation_rad, hfov_rad;
  };
  std::map<long, Pointing> pointings_;
};

}  // namespace ols::offline
