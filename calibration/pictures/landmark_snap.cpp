#include "calibration/pictures/landmark_snap.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibration/pictures/gradients.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Refusal = Snap::Refusal;

constexpr double kSmoothing_px = 1.0;

Snap refused(Refusal why) {
  Snap snap;
  snap.refusal = why;
  return snap;
}

// Lines through pixels: along the edge (its normal is the gradient) or across it. Least squares of
// the point nearest to all of them.
struct Crossing {
  Matrix2d N = Matrix2d::Zero();
  Vector2d b = Vector2d::Zero();
  double c = 0.0, weights = 0.0;

  void add(const Vector2d& normal, const Vector2d& p, double weight) {
    const double along = normal.dot(p);
    N += weight * normal * normal.transpose();
    b += weight * normal * along;
    c += weight * along * along;
    weights += weight;
  }
  Vector2d point() const { return N.ldlt().solve(b); }
  double misfit() const { return std::max(0.0, c - b.dot(point())); }
  // 1 - ((l1 - l2) / (l1 + l2))^2: 1 for edges of all directions, 0 for one alone.
  double isotropy() const {
    return N.trace() > 0.0 ? 4.0 * N.determinant() / (N.trace() * N.trace()) : 0.0;
  }
};

struct Crossings {
  Crossing corner, centre;
  double strength = 0.0;  // mean square of the gradient
};

Crossings around(const Gradients& g, const Vector2d& middle, double radius_px) {
  Crossings all;
  const double sigma = 0.5 * radius_px;
  const int reach = static_cast<int>(std::ceil(radius_px));
  const int x0 = static_cast<int>(std::lround(middle.x()));
  const int y0 = static_cast<int>(std::lround(middle.y()));
  for (int y = std::max(0, y0 - reach); y <= std::min(g.x.rows - 1, y0 + reach); ++y) {
    for (int x = std::max(0, x0 - reach); x <= std::min(g.x.cols - 1, x0 + reach); ++x) {
      const Vector2d p = Vector2d(x, y) - middle;
      const double weight = std::exp(-0.5 * p.squaredNorm() / (sigma * sigma));
      const Vector2d slope(g.x.at<float>(y, x), g.y.at<float>(y, x));
      all.corner.add(slope, p, weight);
      all.centre.add({-slope.y(), slope.x()}, p, weight);
      all.strength += weight * slope.squaredNorm();
    }
  }
  all.strength /= std::max(all.corner.weights, 1e-9);
  return all;
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kOutside:
      return "too near to the picture's edge";
    case Refusal::kNoStructure:
      return "nothing stands out there";
    case Refusal::kEdge:
      return "an edge alone: point at a corner, a tip or a spot";
    case Refusal::kFar:
      return "the nearest structure is too far from the point";
  }
  return "";
}

Snap snap_to_structure(const cv::Mat& gray, const Vector2d& pointed_px, double radius_px) {
  constexpr int kRounds = 8;
  constexpr double kAboveNoise = 3.0, kLeastIsotropy = 0.1, kStill_px = 0.005;
  const cv::Rect2d inner(radius_px, radius_px, gray.cols - 1 - 2 * radius_px,
                         gray.rows - 1 - 2 * radius_px);
  if (!inner.contains({pointed_px.x(), pointed_px.y()})) return refused(Refusal::kOutside);
  const int margin = static_cast<int>(std::ceil(2.0 * radius_px + 4.0 * kSmoothing_px)) + 1;
  const cv::Rect part =
      cv::Rect(static_cast<int>(pointed_px.x()) - margin, static_cast<int>(pointed_px.y()) - margin,
               2 * margin + 1, 2 * margin + 1) &
      cv::Rect({}, gray.size());
  Gradients g = gradients_of(gray(part), kSmoothing_px);
  const Vector2d origin(part.x, part.y);
  Snap snap;
  Vector2d at = pointed_px - origin;
  for (int round = 0; round < kRounds; ++round) {
    const Crossings all = around(g, at, radius_px);
    if (all.strength < std::pow(kAboveNoise * g.sd, 2)) return refused(Refusal::kNoStructure);
    const bool is_corner = all.corner.misfit() <= all.centre.misfit();
    const Crossing& best = is_corner ? all.corner : all.centre;
    if (best.isotropy() < kLeastIsotropy) return refused(Refusal::kEdge);
    const Vector2d step = best.point();
    at += step;
    if ((at + origin - pointed_px).norm() > radius_px) return refused(Refusal::kFar);
    snap.shape = is_corner ? Snap::Shape::kCorner : Snap::Shape::kCentre;
    // Neighbours share their noise: one of 4 pi s^2 pixels counts.
    const double shared = 4.0 * EIGEN_PI * kSmoothing_px * kSmoothing_px;
    const Matrix2d covariance =
        shared * best.misfit() / std::max(1.0, best.weights - 2.0) * best.N.inverse();
    snap.sd_px = std::sqrt(covariance.diagonal().maxCoeff());
    if (step.norm() < kStill_px) break;
  }
  snap.centre_px = at + origin;
  return snap;
}

}  // namespace ols::calibration
