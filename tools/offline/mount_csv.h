// mount.csv: frame,azimuth_deg,elevation_deg,hfov_deg: where a clip's camera pointed.
#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace ols::offline {

// Azimuths may have any zero direction; hfov is that of the whole image's width.
class MountFile {
 public:
  MountFile() = default;
  explicit MountFile(const std::string& path);  // throws CsvError

  // The camera's rotation from the previous frame to this one: maps the previous image's pixels to
  // this one's. nullopt: the file lacks one of the two frames.
  std::optional<Eigen::Matrix3d> motion_to(long frame, const cv::Size& image) const;

 private:
  struct Pointing {
    double azimuth_rad, elevation_rad, hfov_rad;
  };
  std::map<long, Pointing> pointings_;
};

}  // namespace ols::offline
