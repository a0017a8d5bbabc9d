#include "tools/calibrate/station_views.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "edge/calibration/calibration_folder.h"
#include "edge/config/config.h"
#include "tools/calibrate/stored_pictures.h"

namespace ols::calibration {
namespace {

namespace fs = std::filesystem;

fs::path calibration_in_use(const station::StationSettings& settings, const std::string& config) {
  if (settings.state_folder.empty()) {
    throw std::runtime_error(config +
                             ": state_folder: is needed: the station's calibrations are "
                             "kept there");
  }
  return fs::path(settings.state_folder) / "calibrations" / settings.id / "current";
}

// 1-sigma of the directions in the middle of a picture, from all that the calibration does not know
// exactly.
scenery::PoseSd direction_sd(const StationCalibration& calibration, const UnitReading& reading,
                             const std::string& config) {
  const CameraIntrinsics& camera = calibration.model.geometry.camera;
  const auto covariance = systematic_covariance(calibration, reading, {camera.cx_px, camera.cy_px});
  if (!covariance) throw std::runtime_error(config + ": lens: the optical axis has no pixel");
  return {.heading_rad = std::sqrt((*covariance)(0, 0)),
          .tilt_rad = std::sqrt((*covariance)(1, 1))};
}

cv::Mat1b picture_of(const StoredPicture& stored, const CameraIntrinsics& camera) {
  const cv::Mat1b gray = gray_of(stored);
  if (gray.cols == camera.width_px && gray.rows == camera.height_px) return gray;
  throw std::runtime_error(fmt::format("{}: has {} x {} pixels, the calibrated camera {} x {}",
                                       stored.file.string(), gray.cols, gray.rows, camera.width_px,
                                       camera.height_px));
}

}  // namespace

StationViews read_views(const std::string& config) {
  const station::StationSettings settings = station::load_station_settings(config);
  const fs::path folder = calibration_in_use(settings, config);
  const StationCalibration calibration =
      station::read_calibration(folder.string(), settings).calibration;
  const StationModel& model = calibration.model;
  const StationGeometry& geometry = model.geometry;
  const std::vector<StoredPicture> stored = stored_views(folder);
  std::vector<Eigen::Vector3d> centres_ecef;
  Eigen::Vector3d sum_ecef = Eigen::Vector3d::Zero();
  for (const StoredPicture& picture : stored) {
    const PanTilt angles = corrected_angles(model, picture.reading);
    centres_ecef.push_back(camera_centre_ecef(geometry, angles));
    sum_ecef += centres_ecef.back();
  }
  const Eigen::Vector3d middle_ecef = sum_ecef / static_cast<double>(stored.size());
  StationViews views{.station = settings.id,
                     .pictures = {},
                     .camera = LocalFrame(geodetic_from_ecef(middle_ecef)),
                     .rad_per_px = 1.0 / geometry.camera.fx_px,
                     .sd = direction_sd(calibration, stored.front().reading, config)};
  double off_m2 = 0.0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const PanTilt angles = corrected_angles(model, stored[i].reading);
    views.pictures.push_back({picture_of(stored[i], geometry.camera), geometry.camera,
                              enu_from_camera(geometry.chain, angles).linear()});
    off_m2 += (centres_ecef[i] - middle_ecef).squaredNorm() / static_cast<double>(stored.size());
  }
  // The camera's way around the pan axis counts as an error of its position, alike on each axis.
  views.sd.position_m = std::hypot(geometry.sd.position_m, std::sqrt(off_m2 / 3.0));
  return views;
}

}  // namespace ols::calibration
