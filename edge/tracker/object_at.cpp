#include "edge/tracker/object_at.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace ols::tracker {
namespace {

constexpr int kReach_px = 110;  // of what is looked at, around the pixel
constexpr double kNear_px = 24.0;
constexpr int kLargest_px = 90, kSmallest_px = 3;
constexpr double kLeastContrast = 8.0;  // [grey levels]
constexpr double kSpreads = 5.0;

double quantile(const cv::Mat& image, double share) {
  std::vector<std::uint8_t> values(image.begin<std::uint8_t>(), image.end<std::uint8_t>());
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// Smaller than the element and darker (black hat) or brighter (top hat) than all around; edges do
// not count. Apart from each other: the sky between two dark things is a bright one.
cv::Mat standing_out(const cv::Mat& gray, cv::MorphTypes how) {
  cv::Mat smooth, cue;
  cv::GaussianBlur(gray, smooth, cv::Size(0, 0), 1.0);
  const cv::Mat element =
      cv::getStructuringElement(cv::MORPH_RECT, {kLargest_px + 1, kLargest_px + 1});
  cv::morphologyEx(smooth, cue, how, element);
  return cue;
}

double distance_px(const cv::Rect& box, const Eigen::Vector2d& pixel) {
  const double dx = std::max({box.x - pixel.x(), pixel.x() - (box.x + box.width - 1), 0.0});
  const double dy = std::max({box.y - pixel.y(), pixel.y() - (box.y + box.height - 1), 0.0});
  return std::hypot(dx, dy);
}

// The nearest one that stands out in the cue, if it is nearer than `nearest`.
void look(const cv::Mat& cue, const cv::Point& corner, const Eigen::Vector2d& pixel,
          std::optional<cv::Rect>& nearest) {
  const double middle = quantile(cue, 0.5);
  const double spread = std::max(0.5, (quantile(cue, 0.75) - middle) / 0.6745);
  cv::Mat mask, labels, statistics, centroids;
  cv::threshold(cue, mask, std::max(kLeastContrast, middle + kSpreads * spread), 255.0,
                cv::THRESH_BINARY);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {9, 9}));
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids);
  for (int i = 1; i < count; ++i) {
    const cv::Rect box =
        cv::Rect(statistics.at<int>(i, cv::CC_STAT_LEFT), statistics.at<int>(i, cv::CC_STAT_TOP),
                 statistics.at<int>(i, cv::CC_STAT_WIDTH),
                 statistics.at<int>(i, cv::CC_STAT_HEIGHT)) +
        corner;
    const int longer = std::max(box.width, box.height);
    if (longer < kSmallest_px || longer > kLargest_px) continue;
    if (distance_px(box, pixel) > kNear_px) continue;
    if (!nearest || distance_px(box, pixel) < distance_px(*nearest, pixel)) nearest = box;
  }
}

}  // namespace

std::optional<cv::Rect2d> object_at(const cv::Mat& gray, const Eigen::Vector2d& pixel) {
  const cv::Rect frame(0, 0, gray.cols, gray.rows);
  if (gray.empty() || !pixel.allFinite() || pixel.x() < 0.0 || pixel.y() < 0.0 ||
      pixel.x() > gray.cols || pixel.y() > gray.rows) {
    return std::nullopt;
  }
  const cv::Point centre(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
  const cv::Rect area =
      cv::Rect(centre.x - kReach_px, centre.y - kReach_px, 2 * kReach_px, 2 * kReach_px) & frame;
  std::optional<cv::Rect> nearest;
  for (const cv::MorphTypes how : {cv::MORPH_BLACKHAT, cv::MORPH_TOPHAT}) {
    look(standing_out(gray(area), how), area.tl(), pixel, nearest);
  }
  return nearest ? std::optional(cv::Rect2d(*nearest)) : std::nullopt;
}

}  // namespace ols::tracker
