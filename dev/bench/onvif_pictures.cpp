#include "dev/bench/onvif_pictures.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"

namespace ols::bench {
namespace {

constexpr double kNoise_gray = 2.0;
constexpr double kDrift_rad_s = radians(0.4);
const cv::Rect kBeside(0, 0, 640, 384);  // where a target does not cover the picture
constexpr double kPasses_s = 20.0, kPassed_s = 25.0, kPassing_px_s = 40.0;

const cv::Mat& slopes() {
  static const cv::Mat texture = sim::slopes_texture({}, ptz_geometry().camera);
  return texture;
}

}  // namespace

StationGeometry ptz_geometry() {
  StationGeometry geometry;
  CameraIntrinsics& camera = geometry.camera;
  camera.width_px = 640;
  camera.height_px = 480;
  camera.fx_px = camera.fy_px = 320.0 / std::tan(radians(20.0));
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  return geometry;
}

OnvifPictures::OnvifPictures(Scene scene, std::uint64_t seed)
    : scene_(scene), panorama_({}, geometry_.camera, slopes(), seed), noise_(seed) {
  object_.create(geometry_.camera.height_px, geometry_.camera.width_px, CV_8UC1);
  noise_.fill(object_, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(object_, object_, {}, 2.0);
  cv::normalize(object_, object_, 60, 200, cv::NORM_MINMAX);
}

void OnvifPictures::draw_landscape(const PanTilt& angles, cv::Mat& gray) {
  panorama_.draw(enu_from_camera(geometry_.chain, angles).linear(), gray);
}

cv::Mat OnvifPictures::draw(const PanTilt& angles, double time_s) {
  cv::Mat gray(geometry_.camera.height_px, geometry_.camera.width_px, CV_8UC1, cv::Scalar(150));
  if (scene_ == Scene::kDrifts) {
    draw_landscape({angles.pan_rad + kDrift_rad_s * time_s, angles.tilt_rad}, gray);
  } else if (scene_ != Scene::kBlank) {
    draw_landscape(angles, gray);
  }
  if ((scene_ == Scene::kPassing || scene_ == Scene::kTarget) && time_s > kPasses_s &&
      time_s < kPassed_s) {
    const double across_px = kPassing_px_s * (time_s - kPasses_s) - 100.0;
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1.0, 0.0, across_px, 0.0, 1.0, 0.0);
    cv::Mat moved, covers;
    cv::warpAffine(object_, moved, shift, gray.size());
    cv::warpAffine(cv::Mat(object_.size(), CV_8UC1, cv::Scalar(255)), covers, shift, gray.size());
    if (scene_ == Scene::kTarget) covers(kBeside).setTo(0);
    moved.copyTo(gray, covers);
  }
  cv::Mat noisy(gray.size(), CV_16SC1);
  noise_.fill(noisy, cv::RNG::NORMAL, 0.0, kNoise_gray);
  cv::add(gray, noisy, gray, cv::noArray(), CV_8U);
  return gray;
}

}  // namespace ols::bench
