#include "dev/bench/synthetic_target.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/angles.h"
#include "sim/world/flyer.h"

namespace ols::bench {
namespace {

constexpr double kSpan_m = 1.0;
constexpr double kBrightness = 0.2;  // of the body, as in the simulator's scenarios

// Seen obliquely from below: nearly as high as it is wide.
Eigen::Matrix<double, 2, 3> from_body(double px_per_m) {
  const double yaw = radians(20.0), up = radians(60.0);
  Eigen::Matrix<double, 2, 3> axes;
  axes << std::sin(yaw), -std::cos(yaw), 0.0,  //
      std::sin(up) * std::cos(yaw), std::sin(up) * std::sin(yaw), -std::cos(up);
  return px_per_m * axes;
}

sim::FlyerView view_of(double px_per_m, const Eigen::Vector2d& centre_px,
                       const Eigen::Vector2d& smear_px) {
  sim::FlyerView view;
  view.centre_px = centre_px;
  view.px_per_m = from_body(px_per_m);
  view.span_m = kSpan_m;
  view.brightness = kBrightness;
  view.smear_px = smear_px;
  return view;
}

// Drawn this much larger and averaged: the simulator's edges are sampled at pixels' centres, which
// puts a small target off by some hundredths of a pixel.
int oversampling(double width_px) {
  return std::clamp(static_cast<int>(std::ceil(120.0 / width_px)), 2, 40);
}

// The rectangle around the target; not clipped to the image.
sim::FlyerMatte blurred_matte(double px_per_m, double blur_px, const Eigen::Vector2d& centre_px,
                              const Eigen::Vector2d& smear_px) {
  const cv::Rect2d box = sim::flyer_box(view_of(px_per_m, centre_px, smear_px));
  const int half = static_cast<int>(std::ceil(0.5 * std::max(box.width, box.height) +
                                              4.0 * blur_px + 0.5 * smear_px.norm())) +
                   2;
  const Eigen::Vector2i corner = centre_px.array().round().cast<int>() - half;
  const cv::Size size(2 * half + 1, 2 * half + 1);
  const int finer = oversampling(box.width);
  const Eigen::Vector2d inside = centre_px - corner.cast<double>();
  const Eigen::Vector2d fine_px = (inside.array() + 0.5) * finer - 0.5;
  const auto fine = sim::flyer_matte(view_of(finer * px_per_m, fine_px, finer * smear_px),
                                     cv::Size(finer * size.width, finer * size.height));
  const auto averaged = [&](const cv::Mat1f& part) {
    cv::Mat1f whole(finer * size.height, finer * size.width, 0.0F), result;
    part.copyTo(whole(fine.area));
    cv::resize(whole, result, size, 0.0, 0.0, cv::INTER_AREA);
    cv::GaussianBlur(result, result, cv::Size(0, 0), blur_px, blur_px, cv::BORDER_CONSTANT);
    return result;
  };
  return {cv::Rect(cv::Point(corner.x(), corner.y()), size), averaged(fine.colour),
          averaged(fine.covered)};
}

}  // namespace

SyntheticTarget::SyntheticTarget(const TargetLook& look) : look_(look) {
  const double width = sim::flyer_box(view_of(1.0, {0, 0}, {0, 0})).width;
  px_per_m_ = look.width_px / width;
  if (look.contrast_sigma <= 0.0) return;
  const auto matte = blurred_matte(px_per_m_, look.blur_px, {0.0, 0.0}, {0.0, 0.0});
  const cv::Mat1f difference = cv::abs(matte.colour - matte.covered * kSkyLevel);
  double greatest = 0.0;
  cv::minMaxLoc(difference, nullptr, &greatest);
  strength_ = look.contrast_sigma * kNoiseSd / greatest;
}

void SyntheticTarget::draw(cv::Mat1f& picture, const Eigen::Vector2d& centre_px,
                           const Eigen::Vector2d& smear_px, double growth) const {
  const auto matte = blurred_matte(growth * px_per_m_, look_.blur_px, centre_px, smear_px);
  const cv::Rect seen = matte.area & cv::Rect(cv::Point(), picture.size());
  if (seen.empty()) return;
  const cv::Rect kept(seen.tl() - matte.area.tl(), seen.size());
  const cv::Mat1f colour = matte.colour(kept), covered = matte.covered(kept);
  cv::Mat1f part = picture(seen);
  const cv::Mat1f difference = strength_ * (colour - covered * kSkyLevel);
  const cv::Mat1f mixed = part.mul(1.0F - covered) + covered * kSkyLevel + difference;
  mixed.copyTo(part);
}

cv::Rect2d SyntheticTarget::box(const Eigen::Vector2d& centre_px) const {
  const cv::Rect2d inner = sim::flyer_box(view_of(px_per_m_, centre_px, {0, 0}));
  constexpr double kMargin = 0.5;
  return {inner.x - kMargin, inner.y - kMargin, inner.width + 2 * kMargin,
          inner.height + 2 * kMargin};
}

Eigen::Matrix2d SyntheticTarget::bound(const cv::Mat1f& backdrop, const Eigen::Vector2d& centre_px,
                                       const Eigen::Vector2d& smear_px, double growth) const {
  constexpr double kStep_px = 0.05;
  const auto derivative = [&](const Eigen::Vector2d& axis) {
    cv::Mat1f after = backdrop.clone(), before = backdrop.clone();
    draw(after, centre_px + kStep_px * axis, smear_px, growth);
    draw(before, centre_px - kStep_px * axis, smear_px, growth);
    return cv::Mat1f((after - before) / (2.0 * kStep_px));
  };
  const cv::Mat1f dx = derivative(Eigen::Vector2d::UnitX());
  const cv::Mat1f dy = derivative(Eigen::Vector2d::UnitY());
  const double sigma2 = kNoiseSd * kNoiseSd + 1.0 / 12.0;  // levels are rounded to integers
  Eigen::Matrix2d information;
  information << dx.dot(dx), dx.dot(dy), dx.dot(dy), dy.dot(dy);
  return (information / sigma2).inverse();
}

}  // namespace ols::bench
