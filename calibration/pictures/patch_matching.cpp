#include "calibration/pictures/patch_matching.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ols::calibration {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Refusal = PatchMatch::Refusal;

// 1-sigma of the Gaussian before every comparison: interpolation between pixels needs it.
constexpr double kSmoothing_px = 0.8;
constexpr int kMargin_px = 4;  // of the Gaussian and of the interpolation

// A window of the picture, smoothed; `origin` is where its first pixel is.
struct Window {
  cv::Mat pixels;
  cv::Point origin;
};

std::optional<Window> window_of(const cv::Mat& gray, const Vector2d& centre, double half_px) {
  const int half = static_cast<int>(std::ceil(half_px)) + kMargin_px;
  const cv::Point middle(static_cast<int>(std::lround(centre.x())),
                         static_cast<int>(std::lround(centre.y())));
  const cv::Rect wanted(middle.x - half, middle.y - half, 2 * half + 1, 2 * half + 1);
  const cv::Rect part = wanted & cv::Rect({}, gray.size());
  // The surroundings of the patch may be outside; the patch itself not.
  const cv::Rect core(wanted.x + kMargin_px, wanted.y + kMargin_px, wanted.width - 2 * kMargin_px,
                      wanted.height - 2 * kMargin_px);
  if ((part & core) != core) return std::nullopt;
  Window window{{}, part.tl()};
  gray(part).convertTo(window.pixels, CV_32F);
  cv::GaussianBlur(window.pixels, window.pixels, {}, kSmoothing_px, kSmoothing_px,
                   cv::BORDER_REPLICATE);
  return window;
}

cv::Mat sample(const Window& window, const Vector2d& centre, int side, const Matrix2d& turn) {
  const double half = 0.5 * (side - 1);
  const Vector2d corner =
      centre - Vector2d(window.origin.x, window.origin.y) - turn * Vector2d(half, half);
  const cv::Mat to = (cv::Mat_<double>(2, 3) << turn(0, 0), turn(0, 1), corner.x(), turn(1, 0),
                      turn(1, 1), corner.y());
  cv::Mat out;
  cv::warpAffine(window.pixels, out, to, {side, side}, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return out;
}

// Normal equations of shift (2), gain and offset, without the outermost pixels.
struct Equations {
  Eigen::Matrix4d N = Eigen::Matrix4d::Zero();
  Vector4d b = Vector4d::Zero();
  double squares = 0.0;
  int n = 0;
};

Equations equations(const cv::Mat& patch, const cv::Mat& there, const Vector4d& at) {
  Equations e;
  const auto gain = static_cast<float>(at[2]), offset = static_cast<float>(at[3]);
  for (int y = 1; y + 1 < patch.rows; ++y) {
    for (int x = 1; x + 1 < patch.cols; ++x) {
      const auto slope = [&](const cv::Mat& m) {
        return Vector2d(0.5 * (m.at<float>(y, x + 1) - m.at<float>(y, x - 1)),
                        0.5 * (m.at<float>(y + 1, x) - m.at<float>(y - 1, x)));
      };
      // The mean of both slopes: exact to the second order.
      const Vector2d g = 0.5 * (slope(there) + at[2] * slope(patch));
      const Vector4d row(g.x(), g.y(), -patch.at<float>(y, x), -1.0);
      const double miss = static_cast<double>(gain * patch.at<float>(y, x) + offset) -
                          static_cast<double>(there.at<float>(y, x));
      e.N += row * row.transpose();
      e.b += row * miss;
      e.squares += miss * miss;
      ++e.n;
    }
  }
  return e;
}

double correlation_of(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat score;
  cv::matchTemplate(a, b, score, cv::TM_CCOEFF_NORMED);
  return score.at<float>(0, 0);
}

// The coarse place; nothing, with the reason, where there is none or two.
Refusal search(const Patch& patch, const Window& window, Vector2d& place, double& reach_px) {
  constexpr double kLeastCorrelation = 0.5, kNearlyAsGood = 0.95;
  cv::Mat score;
  cv::matchTemplate(window.pixels, patch.pixels, score, cv::TM_CCOEFF_NORMED);
  double best = 0.0, second = 0.0;
  cv::Point at;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
  if (!(best >= kLeastCorrelation)) return Refusal::kNotFound;
  const int half = patch.pixels.cols / 2;
  // Its own hill is as wide as its finest structure; a second one lies beyond.
  cv::Mat others = score.clone();
  cv::circle(others, at, std::max(3, half / 2), cv::Scalar(-1.0), cv::FILLED);
  cv::minMaxLoc(others, nullptr, &second);
  if (second > kNearlyAsGood * best) return Refusal::kAmbiguous;
  place = Vector2d(window.origin.x + at.x + half, window.origin.y + at.y + half);
  reach_px = 2.0;
  return Refusal::kNone;
}

PatchMatch refused(Refusal why) {
  PatchMatch match;
  match.refusal = why;
  return match;
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kOutside:
      return "outside of the picture";
    case Refusal::kNoStructure:
      return "no structure that holds it in both directions";
    case Refusal::kNotFound:
      return "nothing like it is there";
    case Refusal::kAmbiguous:
      return "two places look alike";
  }
  return "";
}

std::optional<Patch> cut_patch(const cv::Mat& gray, const Vector2d& centre_px, int half_px,
                               const Matrix2d& turn) {
  const double wide = turn.cwiseAbs().rowwise().sum().maxCoeff();
  const auto window = window_of(gray, centre_px, half_px * wide);
  if (!window) return std::nullopt;
  return Patch{sample(*window, centre_px, 2 * half_px + 1, turn)};
}

PatchMatch find_patch(const Patch& patch, const cv::Mat& gray, const Vector2d& near_px,
                      double reach_px) {
  constexpr int kRounds = 12;
  constexpr double kStill_px = 1e-3, kLeastCorrelation = 0.6, kWorst_px = 0.3;
  const int half = patch.pixels.cols / 2;
  const auto window = window_of(gray, near_px, half + reach_px);
  if (!window) return refused(Refusal::kOutside);
  PatchMatch match;
  double within_px = reach_px;
  match.refusal = search(patch, *window, match.centre_px, within_px);
  if (!match) return match;
  const Vector2d coarse = match.centre_px;
  Vector4d at(coarse.x(), coarse.y(), 1.0, 0.0);
  Equations e;
  cv::Mat there;
  for (int round = 0; round < kRounds; ++round) {
    there = sample(*window, at.head<2>(), patch.pixels.cols, Matrix2d::Identity());
    e = equations(patch.pixels, there, at);
    const Vector4d step = e.N.ldlt().solve(e.b);
    if (!step.allFinite()) return refused(Refusal::kNoStructure);
    at += step;
    if ((at.head<2>() - coarse).cwiseAbs().maxCoeff() > within_px)
      return refused(Refusal::kNoStructure);
    if (step.head<2>().norm() < kStill_px) break;
  }
  match.centre_px = at.head<2>();
  match.correlation = correlation_of(there, patch.pixels);
  // Neighbouring pixels share their noise: the Gaussian leaves one of 4 pi s^2 of them.
  const double shared = 4.0 * EIGEN_PI * kSmoothing_px * kSmoothing_px;
  const double variance = shared * e.squares / std::max(1, e.n - 4);
  const Eigen::Matrix2d covariance = variance * e.N.inverse().topLeftCorner<2, 2>();
  match.sd_px = std::sqrt(covariance.diagonal().maxCoeff());
  if (!(match.sd_px < kWorst_px)) return refused(Refusal::kNoStructure);
  if (match.correlation < kLeastCorrelation) return refused(Refusal::kNotFound);
  return match;
}

}  // namespace ols::calibration
