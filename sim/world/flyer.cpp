#include "sim/world/flyer.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace ols::sim {
namespace {

// Fractions of the span, in the body frame: x forward, y left, z up.
struct Part {
  Eigen::Vector3d centre;
  Eigen::Matrix3d half_axes;  // columns
  double brightness;          // times that of the body
  double opacity;
};

Part ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& half, double yaw_rad,
               double brightness, double opacity) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(yaw_rad), -std::sin(yaw_rad), std::sin(yaw_rad),
      std::cos(yaw_rad);
  return {centre, turn * half.asDiagonal(), brightness, opacity};
}

std::vector<Part> drone_parts() {
  constexpr double kArm = 0.34, kDiagonal = 0.7853981633974483;
  std::vector<Part> parts;
  for (double yaw : {kDiagonal, -kDiagonal}) {
    parts.push_back(ellipsoid(Eigen::Vector3d::Zero(), {kArm, 0.022, 0.022}, yaw, 1.2, 1.0));
  }
  for (int i = 0; i < 4; ++i) {
    const double yaw = kDiagonal * (2 * i + 1);
    const Eigen::Vector3d motor(kArm * std::cos(yaw), kArm * std::sin(yaw), 0.0);
    parts.push_back(ellipsoid(motor, {0.035, 0.035, 0.05}, 0.0, 0.8, 1.0));
    parts.push_back(ellipsoid(motor, {0.16, 0.16, 0.004}, 0.0, 1.6, 0.3));
  }
  parts.push_back(ellipsoid(Eigen::Vector3d::Zero(), {0.20, 0.15, 0.16}, 0.0, 1.0, 1.0));
  parts.push_back(ellipsoid(Eigen::Vector3d::Zero(), {0.12, 0.06, 0.05}, 0.0, 2.4, 1.0));
  return parts;
}

// A wing from the body's middle outwards: side 1 is the left one.
Part wing(int side, double length, double chord, double up_rad) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(side * up_rad, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const Eigen::Vector3d half(0.5 * chord, 0.5 * length, 0.012);
  return {turn * Eigen::Vector3d(0.0, side * 0.5 * length, 0.0), turn * half.asDiagonal(), 1.0,
          1.0};
}

std::vector<Part> bird_parts(double wing_rad) {
  return {ellipsoid({0.02, 0.0, 0.0}, {0.20, 0.06, 0.06}, 0.0, 1.0, 1.0),
          ellipsoid({-0.22, 0.0, 0.0}, {0.10, 0.06, 0.01}, 0.0, 1.0, 1.0),
          wing(1, 0.5, 0.2, wing_rad), wing(-1, 0.5, 0.2, wing_rad)};
}

std::vector<Part> aircraft_parts() {
  return {ellipsoid({0.0, 0.0, 0.0}, {0.40, 0.05, 0.05}, 0.0, 1.0, 1.0),
          ellipsoid({-0.36, 0.0, 0.0}, {0.04, 0.16, 0.008}, 0.0, 1.0, 1.0),
          ellipsoid({-0.36, 0.0, 0.06}, {0.05, 0.006, 0.07}, 0.0, 1.0, 1.0),
          wing(1, 0.5, 0.12, 0.05), wing(-1, 0.5, 0.12, 0.05)};
}

std::vector<Part> parts_of(const FlyerView& view) {
  static const std::vector<Part> kDrone = drone_parts(), kAircraft = aircraft_parts();
  switch (view.shape) {
    case FlyerShape::kBird:
      return bird_parts(view.wing_rad);
    case FlyerShape::kAircraft:
      return kAircraft;
    default:
      return kDrone;
  }
}

// A part's image: an ellipse { x : (x - centre)' Q^-1 (x - centre) <= 1 }.
struct Ellipse {
  Eigen::Vector2d centre;
  Eigen::Matrix2d Q;
};

Ellipse image_of(const Part& part, const FlyerView& view) {
  const Eigen::Matrix<double, 2, 3> px_per_span = view.px_per_m * view.span_m;
  const Eigen::Matrix<double, 2, 3> axes = px_per_span * part.half_axes;
  return {view.centre_px + px_per_span * part.centre, axes * axes.transpose()};
}

void over(float& colour, float& covered, float gray, float alpha) {
  colour = colour * (1 - alpha) + gray * alpha;
  covered = covered * (1 - alpha) + alpha;
}

void draw_ellipse(const Ellipse& ellipse, float gray, double opacity, FlyerMatte& canvas) {
  // Thinner than a pixel: drawn one pixel wide and fainter, so that its total light is right.
  constexpr double kLeastHalfAxis = 0.5;
  const Eigen::Matrix2d Q =
      ellipse.Q + kLeastHalfAxis * kLeastHalfAxis * Eigen::Matrix2d::Identity();
  const double thin = std::sqrt(std::max(ellipse.Q.determinant(), 0.0) / Q.determinant());
  const Eigen::Matrix2f inverse = Q.inverse().cast<float>();
  const auto alpha = static_cast<float>(opacity * std::sqrt(thin));
  const Eigen::Vector2d half = Q.diagonal().cwiseSqrt();
  const int x0 = std::max(static_cast<int>(ellipse.centre.x() - half.x()) - 1, canvas.area.x);
  const int y0 = std::max(static_cast<int>(ellipse.centre.y() - half.y()) - 1, canvas.area.y);
  const int x1 =
      std::min(static_cast<int>(ellipse.centre.x() + half.x()) + 2, canvas.area.br().x - 1);
  const int y1 =
      std::min(static_cast<int>(ellipse.centre.y() + half.y()) + 2, canvas.area.br().y - 1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Eigen::Vector2f d = (Eigen::Vector2d(x, y) - ellipse.centre).cast<float>();
      const Eigen::Vector2f g = inverse * d;
      const float r2 = d.dot(g), slope = g.norm();
      // Signed distance to the edge, first order: (1 - r) / |grad r| with grad r = g / r.
      const float r = std::sqrt(r2);
      const float inside = r < 1e-3F ? 1.0F : (1 - r) * r / slope;
      const float coverage = std::clamp(inside + 0.5F, 0.0F, 1.0F);
      if (coverage == 0.0F) continue;
      const int cy = y - canvas.area.y, cx = x - canvas.area.x;
      over(canvas.colour(cy, cx), canvas.covered(cy, cx), gray, coverage * alpha);
    }
  }
}

FlyerMatte draw_still(const FlyerView& view, const cv::Rect& area) {
  FlyerMatte canvas{area, cv::Mat1f::zeros(area.size()), cv::Mat1f::zeros(area.size())};
  for (const Part& part : parts_of(view)) {
    const auto gray =
        static_cast<float>(std::min(255.0, 205.0 * view.brightness * part.brightness));
    draw_ellipse(image_of(part, view), gray, part.opacity, canvas);
  }
  return canvas;
}

cv::Rect area_of(const FlyerView& view, cv::Size picture) {
  const cv::Rect2d box = flyer_box(view);
  const double margin_x = 3.0 + std::abs(view.smear_px.x());
  const double margin_y = 3.0 + std::abs(view.smear_px.y());
  const cv::Rect2d wide(box.x - margin_x, box.y - margin_y, box.width + 2 * margin_x,
                        box.height + 2 * margin_y);
  const cv::Rect2d seen = wide & cv::Rect2d(cv::Point2d(), cv::Size2d(picture));
  if (seen.area() < 1.0) return {};
  const cv::Rect whole(cv::Point(static_cast<int>(seen.x), static_cast<int>(seen.y)),
                       cv::Point(static_cast<int>(std::ceil(seen.br().x)),
                                 static_cast<int>(std::ceil(seen.br().y))));
  return whole & cv::Rect(cv::Point(), picture);
}

}  // namespace

cv::Rect2d flyer_box(const FlyerView& view) {
  Eigen::AlignedBox2d box;
  for (const Part& part : parts_of(view)) {
    const Ellipse ellipse = image_of(part, view);
    const Eigen::Vector2d half = ellipse.Q.diagonal().cwiseMax(0.0).cwiseSqrt();
    box.extend(ellipse.centre - half).extend(ellipse.centre + half);
  }
  const Eigen::Vector2d corner = box.min() + Eigen::Vector2d(0.5, 0.5), size = box.sizes();
  return {corner.x(), corner.y(), size.x(), size.y()};
}

FlyerMatte flyer_matte(const FlyerView& view, cv::Size picture) {
  const cv::Rect area = area_of(view, picture);
  FlyerMatte sum{area, cv::Mat1f::zeros(area.size()), cv::Mat1f::zeros(area.size())};
  if (area.empty()) return sum;
  // The smear is the mean of still images along it, at most half a pixel apart.
  const int stills = std::clamp(static_cast<int>(std::ceil(2.0 * view.smear_px.norm())), 1, 16);
  for (int i = 0; i < stills; ++i) {
    FlyerView still = view;
    still.centre_px += ((i + 0.5) / stills - 0.5) * view.smear_px;
    const FlyerMatte one = draw_still(still, area);
    sum.colour += one.colour / stills;
    sum.covered += one.covered / stills;
  }
  return sum;
}

void draw_flyer(const FlyerView& view, cv::Mat& gray) {
  draw_flyer(flyer_matte(view, gray.size()), gray);
}

void draw_flyer(const FlyerMatte& matte, cv::Mat& gray) {
  if (matte.area.empty()) return;
  cv::Mat behind, mixed;
  gray(matte.area).convertTo(behind, CV_32F);
  mixed = behind.mul(1.0F - matte.covered) + matte.colour;
  mixed.convertTo(gray(matte.area), CV_8U);
}

}  // namespace ols::sim
