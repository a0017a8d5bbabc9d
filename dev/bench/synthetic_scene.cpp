#include "dev/bench/synthetic_scene.h"

#include "geometry/angles.h"

namespace ols::bench {
namespace {

constexpr int kStrip = 1 << 21;
constexpr std::uint64_t kLandscapeSeed = 7;

}  // namespace

CameraIntrinsics bench_camera(cv::Size picture) {
  CameraIntrinsics camera;
  camera.width_px = picture.width;
  camera.height_px = picture.height;
  camera.cx_px = 0.5 * (picture.width - 1);
  camera.cy_px = 0.5 * (picture.height - 1);
  return camera;
}

Eigen::Matrix3d camera_rotation(const AzimuthElevation& axis) {
  const auto tangent = tangent_basis(axis);
  Eigen::Matrix3d R_enu_cam;
  R_enu_cam << tangent.col(0), -tangent.col(1), enu_from_azimuth_elevation(axis);
  return R_enu_cam;
}

Eigen::Matrix3d rotation_between(const CameraIntrinsics& camera, const AzimuthElevation& from,
                                 const AzimuthElevation& to) {
  const Eigen::Matrix3d K = camera_matrix(camera);
  return K * camera_rotation(to).transpose() * camera_rotation(from) * K.inverse();
}

Landscape::Landscape(const CameraIntrinsics& camera)
    : camera_(camera), panorama_({}, camera, sim::slopes_texture({}, camera), kLandscapeSeed) {}

cv::Mat1f Landscape::backdrop(Backdrop kind, const AzimuthElevation& axis) {
  const cv::Size size(camera_.width_px, camera_.height_px);
  if (kind == Backdrop::kBlankSky) return {size, static_cast<float>(kSkyLevel)};
  panorama_.draw(camera_rotation(axis), drawn_);
  cv::Mat1f result;
  drawn_.convertTo(result, CV_32F);
  return result;
}

PixelNoise::PixelNoise() : strip_(1, kStrip) {
  cv::RNG generator(1);
  generator.fill(strip_, cv::RNG::NORMAL, 0.0, kNoiseSd);
}

cv::Mat PixelNoise::develop(const cv::Mat1f& picture, tracker::Random& random) const {
  cv::Mat1f noisy(picture.size());
  for (int row = 0; row < picture.rows; ++row) {
    const int from = static_cast<int>(random.uniform() * (kStrip - picture.cols));
    noisy.row(row) = picture.row(row) + strip_.colRange(from, from + picture.cols);
  }
  cv::Mat gray;
  noisy.convertTo(gray, CV_8U);
  return gray;
}

}  // namespace ols::bench
