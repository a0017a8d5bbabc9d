#include "edge/detector/outline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

namespace ols::detector {
namespace {

// The surroundings: a strip along the edge of the part, one pixel away from it, where the means of
// 3x3 pixels are still whole.
constexpr int kEdge_px = 1, kStrip_px = 3;
constexpr double kPixels = 9.0;  // of a mean

// The object's part of the image, reduced so that a large object costs no more than a small one.
struct Part {
  cv::Mat1f gray;
  Eigen::Vector2d centre;  // of the object, in pixels of the part
  double reduction = 1.0;
};

std::optional<Part> part_around(const cv::Mat& gray, const Eigen::Vector2d& centre,
                                double extent_px) {
  constexpr double kMost_px = 48.0, kMargin_px = 5.0;
  const int half = static_cast<int>(std::ceil(extent_px + kMargin_px));
  const cv::Point middle(static_cast<int>(std::lround(centre.x())),
                         static_cast<int>(std::lround(centre.y())));
  const cv::Rect square(middle.x - half, middle.y - half, 2 * half + 1, 2 * half + 1);
  const cv::Rect area = square & cv::Rect({}, gray.size());
  if (area.size() != square.size()) return std::nullopt;  // the image's edge cuts it
  Part part;
  part.reduction = std::max(1.0, std::ceil(extent_px / kMost_px));
  cv::Mat reduced;
  cv::resize(gray(area), reduced, {}, 1.0 / part.reduction, 1.0 / part.reduction, cv::INTER_AREA);
  reduced.convertTo(part.gray, CV_32F);
  part.centre.setConstant(0.5 * (part.gray.cols - 1));
  return part;
}

// A plane, because clouds and haze are brighter to one side.
struct Surroundings {
  Eigen::Vector3d plane;  // grey level: its product with x, y and 1
  double sd = 0.0;        // of the means of 3x3 pixels around the plane [grey levels]
};

struct Sample {
  Eigen::Vector3d at;  // x, y and 1
  double level = 0.0, deviation = 0.0;
};

std::vector<Sample> strip_of(const cv::Mat1f& means) {
  const cv::Rect inside(kStrip_px, kStrip_px, means.cols - 2 * kStrip_px,
                        means.rows - 2 * kStrip_px);
  std::vector<Sample> strip;
  for (int y = kEdge_px; y < means.rows - kEdge_px; ++y) {
    for (int x = kEdge_px; x < means.cols - kEdge_px; ++x)
      if (!inside.contains({x, y})) strip.push_back({{x, y, 1.0}, means(y, x)});
  }
  return strip;
}

Eigen::Vector3d plane_through(std::span<const Sample> samples) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const Sample& sample : samples) {
    A += sample.at * sample.at.transpose();
    b += sample.level * sample.at;
  }
  return A.ldlt().solve(b);
}

// By the three quarters of the strip that deviate least from the plane, so that a neighbour does
// not count. The spread of the means tells a texture from the noise of single pixels.
Surroundings surroundings_of(const cv::Mat1f& means) {
  constexpr double kShare = 0.75, kNormal = 1.943;  // by the mean of |z| below its 75 %
  constexpr double kFloor = 0.17;                   // what the rounding hides
  constexpr int kPasses = 3;
  std::vector<Sample> strip = strip_of(means);
  const auto kept =
      std::span(strip).first(static_cast<std::size_t>(kShare * static_cast<double>(strip.size())));
  std::ranges::nth_element(strip, strip.begin() + std::ssize(strip) / 2, {}, &Sample::level);
  Surroundings around{{0.0, 0.0, strip[strip.size() / 2].level}};
  for (int pass = 0; pass < kPasses; ++pass) {
    for (Sample& sample : strip)
      sample.deviation = std::abs(sample.level - around.plane.dot(sample.at));
    std::ranges::sort(strip, {}, &Sample::deviation);
    around.plane = plane_through(kept);
  }
  double deviations = 0.0;
  for (const Sample& sample : kept) deviations += sample.deviation;
  // Nine means share a pixel, and the plane takes three degrees of freedom.
  const double count = static_cast<double>(kept.size()), independent = count / kPixels;
  const double unbiased = std::sqrt(independent / (independent - 3.0));
  around.sd = std::max(kFloor, kNormal * unbiased * deviations / count);
  return around;
}

void subtract(const Eigen::Vector3d& plane, cv::Mat1f& image) {
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image(y, x) -= static_cast<float>(plane.dot(Eigen::Vector3d(x, y, 1.0)));
  }
}

// The largest connected area near the centre that stands out from the surroundings; empty if there
// is none, or if it reaches the strip.
cv::Mat1b object_in(const cv::Mat1b& stands_out, const Part& part, double extent_px) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(stands_out, labels, stats, centres);
  int largest = 0, most = 0;
  for (int i = 1; i < count; ++i) {
    const Eigen::Vector2d at(centres.at<double>(i, 0), centres.at<double>(i, 1));
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    if ((at - part.centre).norm() > 0.75 * extent_px / part.reduction + 2.0 || area <= most)
      continue;
    most = area;
    largest = i;
  }
  if (largest == 0) return {};
  const auto* box = stats.ptr<int>(largest);
  const cv::Rect found(box[cv::CC_STAT_LEFT], box[cv::CC_STAT_TOP], box[cv::CC_STAT_WIDTH],
                       box[cv::CC_STAT_HEIGHT]);
  const cv::Rect inside(kStrip_px, kStrip_px, labels.cols - 2 * kStrip_px,
                        labels.rows - 2 * kStrip_px);
  if ((found & inside) != found) return {};
  return labels == largest;
}

// The outline by the moments of `weights`, whose noise is independent from pixel to pixel; nullopt
// if most of them cancel.
std::optional<Outline> moments_of(const cv::Mat1f& weights, const cv::Mat1b& object, double noise) {
  constexpr double kSide = 4.0;  // of an ellipse, in its standard deviations
  std::vector<cv::Point> pixels;
  cv::findNonZero(object, pixels);
  const auto off = [](const cv::Point& at) { return Eigen::Array2d(at.x, at.y); };
  double sum = 0.0, all = 0.0;
  Eigen::Array2d first = Eigen::Array2d::Zero(), second = first, spread = first;
  for (const cv::Point& at : pixels) {
    sum += weights(at);
    all += std::abs(weights(at));
    first += weights(at) * off(at);
  }
  if (sum <= 0.5 * all) return std::nullopt;
  first /= sum;
  for (const cv::Point& at : pixels) second += weights(at) / sum * (off(at) - first).square();
  for (const cv::Point& at : pixels) spread += ((off(at) - first).square() - second).square();
  const Eigen::Array2d sd = second.max(1.0 / 12.0).sqrt();  // a pixel's own, at least
  return Outline{kSide * sd, kSide * (noise / sum * spread.sqrt()) / (2.0 * sd)};
}

}  // namespace

std::optional<Outline> outline_at(const cv::Mat& gray, const Eigen::Vector2d& centre,
                                  double extent_px) {
  const std::optional<Part> part = part_around(gray, centre, extent_px);
  if (!part) return std::nullopt;
  // Below kClear thresholds, much of the object may not stand out.
  constexpr double kThreshold_sd = 4.5, kClear = 4.0;
  cv::Mat1f means;
  cv::boxFilter(part->gray, means, -1, {3, 3});
  const Surroundings around = surroundings_of(means);
  subtract(around.plane, means);
  const cv::Mat1b stands_out = cv::abs(means) > kThreshold_sd * around.sd;
  const cv::Mat1b object = object_in(stands_out, *part, extent_px);
  if (object.empty()) return std::nullopt;
  double most = 0.0;
  cv::minMaxLoc(cv::abs(means), nullptr, &most, nullptr, nullptr, object);
  if (most < kClear * kThreshold_sd * around.sd) return std::nullopt;
  // Parts of it may be brighter than the surroundings, and others darker.
  cv::Mat1f weights = part->gray;
  subtract(around.plane, weights);
  cv::subtract(cv::Mat1f::zeros(weights.size()), weights, weights, means < 0.0F);
  std::optional<Outline> outline = moments_of(weights, object, std::sqrt(kPixels) * around.sd);
  if (!outline) return std::nullopt;
  outline->size_px *= part->reduction;
  outline->sd_px *= part->reduction;
  return outline;
}

}  // namespace ols::detector
