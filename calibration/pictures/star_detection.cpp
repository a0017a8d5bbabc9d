#include "calibration/pictures/star_detection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace ols::calibration {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kSmoothing_px = 1.0;  // about a star's own width: the matched filter
constexpr int kBorder_px = 4;

// The sky's brightness without what is small: the median of a coarse picture.
cv::Mat background_of(const cv::Mat& picture) {
  constexpr int kCoarse = 8, kMedian = 5;
  cv::Mat coarse, smooth, result;
  cv::resize(picture, coarse,
             {std::max(kMedian, picture.cols / kCoarse), std::max(kMedian, picture.rows / kCoarse)},
             0, 0, cv::INTER_AREA);
  cv::medianBlur(coarse, smooth, kMedian);
  cv::resize(smooth, result, picture.size(), 0, 0, cv::INTER_LINEAR);
  return result;
}

// 1-sigma of a pixel's noise; what stands out does not count. (A median would be wrong by a quarter
// where the noise is of few gray levels.)
double noise_above(const cv::Mat& sky) {
  constexpr double kClip = 3.0, kOfClipped = 0.9866, kRounding = 0.29;
  constexpr int kRounds = 8;
  const cv::Mat squares = sky.mul(sky);
  double sd = std::sqrt(cv::mean(squares)[0]);
  for (int round = 0; round < kRounds; ++round) {
    const cv::Scalar inner = cv::mean(squares, squares < kClip * kClip * sd * sd);
    sd = std::max(kRounding, std::sqrt(inner[0]) / kOfClipped);
  }
  return sd;
}

// What is bright around a peak.
struct Moments {
  double flux = 0.0, peak = 0.0, neighbours = 0.0;
  int pixels = 0;
  Vector2d mean = Vector2d::Zero();
  Matrix2d spread = Matrix2d::Zero();
};

constexpr int kReach_px = 5;

// Centred by a Gaussian weight that follows the centroid: pixels far away only add noise.
Moments moments_at(const cv::Mat& sky, const Vector2d& start, double weight_px) {
  constexpr int kRounds = 6;
  Moments m;
  m.mean = start;
  for (int round = 0; round < kRounds; ++round) {
    Moments next;
    const int x0 = static_cast<int>(std::lround(m.mean.x()));
    const int y0 = static_cast<int>(std::lround(m.mean.y()));
    Vector2d first = Vector2d::Zero();
    double sum = 0.0;
    for (int y = y0 - kReach_px; y <= y0 + kReach_px; ++y) {
      for (int x = x0 - kReach_px; x <= x0 + kReach_px; ++x) {
        if (x < 0 || y < 0 || x >= sky.cols || y >= sky.rows) continue;
        const double light = sky.at<float>(y, x);
        const Vector2d p = Vector2d(x, y) - m.mean;
        const double w = std::exp(-0.5 * p.squaredNorm() / (weight_px * weight_px)) * light;
        next.flux += light;
        next.peak = std::max(next.peak, light);
        sum += w;
        first += w * p;
        next.spread += w * p * p.transpose();
      }
    }
    if (sum <= 0.0) return m;
    // Of a Gaussian image and a Gaussian weight the weighted centroid moves half the way where both
    // are equally wide.
    const Vector2d step = 2.0 * first / sum;
    next.mean = m.mean + step;
    next.spread /= sum;
    m = next;
    if (step.norm() < 1e-3) break;
  }
  return m;
}

bool is_hot_pixel(const cv::Mat& sky, cv::Point at, double noise) {
  constexpr double kShare = 0.12;  // a star of 0.5 px, centred, leaves more in each neighbour
  double neighbours = 0.0;
  for (const cv::Point by : {cv::Point(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    neighbours += sky.at<float>(at + by);
  }
  return neighbours < 4.0 * std::max(noise, kShare * static_cast<double>(sky.at<float>(at)));
}

class Detector {
 public:
  Detector(const cv::Mat& gray, const StarDetectionOptions& options) : options_(options) {
    white_ = gray.depth() == CV_16U ? 65535.0 : 255.0;
    cv::Mat picture;
    gray.convertTo(picture, CV_32F);
    sky_ = picture - background_of(picture);
    picture_ = picture;
    field_.noise = noise_above(sky_);
    cv::GaussianBlur(sky_, smooth_, {}, kSmoothing_px);
  }

  StarField run() {
    // The Gaussian leaves 1 / (2 sqrt(pi) s) of white noise.
    const double smooth_noise = field_.noise / (2.0 * std::sqrt(CV_PI) * kSmoothing_px);
    cv::Mat bright, labels, statistics, centroids;
    cv::compare(smooth_, options_.threshold * smooth_noise, bright, cv::CMP_GT);
    const int n = cv::connectedComponentsWithStats(bright, labels, statistics, centroids);
    for (int i = 1; i < n; ++i) judge(i, labels, statistics);
    std::ranges::sort(field_.stars, std::greater<>(), &DetectedStar::flux);
    return field_;
  }

 private:
  cv::Point brightest_of(int label, const cv::Mat& labels, const cv::Rect& box) const {
    cv::Point at;
    cv::minMaxLoc(sky_(box), nullptr, nullptr, nullptr, &at, labels(box) == label);
    return at + box.tl();
  }

  void judge(int label, const cv::Mat& labels, const cv::Mat& statistics) {
    const int* s = statistics.ptr<int>(label);
    const cv::Rect box(s[cv::CC_STAT_LEFT], s[cv::CC_STAT_TOP], s[cv::CC_STAT_WIDTH],
                       s[cv::CC_STAT_HEIGHT]);
    const cv::Rect inner(kBorder_px, kBorder_px, sky_.cols - 2 * kBorder_px,
                         sky_.rows - 2 * kBorder_px);
    const cv::Point at = brightest_of(label, labels, box);
    if (!inner.contains(at)) return;
    if (is_hot_pixel(sky_, at, field_.noise)) {
      ++field_.hot_pixels;
      return;
    }
    const double widest = 6.0 * options_.widest_px;
    if (is_long(label, labels, box)) {
      ++field_.streaks;
    } else if (std::max(box.width, box.height) > widest) {
      ++field_.surfaces;
    } else {
      add(at);
    }
  }

  // By the second moments of the bright pixels.
  bool is_long(int label, const cv::Mat& labels, const cv::Rect& box) const {
    constexpr int kLeast_px = 8;  // a shorter one is not resolved
    if (std::max(box.width, box.height) < kLeast_px) return false;
    const cv::Moments m = cv::moments(labels(box) == label, true);
    if (m.m00 <= 0.0) return false;
    Matrix2d spread;
    spread << m.mu20, m.mu11, m.mu11, m.mu02;
    const Vector2d axes =
        Eigen::SelfAdjointEigenSolver<Matrix2d>(spread / m.m00).eigenvalues().cwiseMax(1.0 / 12.0);
    return std::sqrt(axes[1] / axes[0]) > options_.longest;
  }

  void add(const cv::Point& at) {
    constexpr double kWeight_px = 1.5, kLeastNoise = 0.3;
    const Moments m = moments_at(sky_, Vector2d(at.x, at.y), kWeight_px);
    if ((m.mean - Vector2d(at.x, at.y)).cwiseAbs().maxCoeff() > 2.0 || m.flux <= 0.0) return;
    DetectedStar star;
    star.centre_px = m.mean;
    star.flux = m.flux;
    star.saturated = picture_.at<float>(at) >= white_ - 0.5;
    // Of a Gaussian image of s and white noise: sd = s / SNR with SNR = flux / (noise 2 sqrt(pi)
    // s), and the flux's own noise; a centroid with this weight is a little worse.
    const double within = std::max(0.0, 0.5 * m.spread.trace());
    const double w2 = kWeight_px * kWeight_px;
    const double s = std::sqrt(std::clamp(within / std::max(0.1, 1.0 - within / w2), 0.25, 16.0));
    const double snr = m.flux / (std::max(kLeastNoise, field_.noise) * 2.0 * std::sqrt(CV_PI) * s);
    constexpr double kOfCentroid = 1.3, kPixelGrid_px = 0.02, kSaturated_px = 0.3;
    star.sd_px = std::hypot(kOfCentroid * std::sqrt(2.0) * s / std::max(1.0, snr), kPixelGrid_px);
    if (star.saturated) star.sd_px = std::hypot(star.sd_px, kSaturated_px);
    field_.stars.push_back(star);
  }

  StarDetectionOptions options_;
  double white_ = 255.0;
  cv::Mat picture_, sky_, smooth_;
  StarField field_;
};

}  // namespace

StarField detect_stars(const cv::Mat& gray, const StarDetectionOptions& options) {
  constexpr int kLeast_px = 64;
  if (gray.rows < kLeast_px || gray.cols < kLeast_px) return {};
  return Detector(gray, options).run();
}

}  // namespace ols::calibration
