#include "edge/tracker/mover_detection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/tracker/alignment.h"
#include "edge/tracker/patch.h"

namespace ols {
namespace {

// Brighter than all, or darker than all of the earlier image within a pixel.
cv::Mat tolerant_difference(const cv::Mat& now, const cv::Mat& before) {
  const cv::Mat element = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  cv::Mat low, high, above, below;
  cv::erode(before, low, element);
  cv::dilate(before, high, element);
  cv::subtract(now, high, above);  // saturates at zero
  cv::subtract(low, now, below);
  return cv::max(above, below);
}

// The root mean square of the lower nine tenths: what the picture differs by anyway.
double fluctuation(const cv::Mat& difference) {
  std::array<int, 256> histogram{};
  for (int row = 0; row < difference.rows; ++row) {
    const auto* line = difference.ptr<std::uint8_t>(row);
    for (int i = 0; i < difference.cols; ++i) ++histogram[line[i]];
  }
  const double wanted = 0.9 * static_cast<double>(difference.total());
  double count = 0.0, squares = 0.0;
  for (std::size_t value = 0; value < histogram.size() && count < wanted; ++value) {
    count += histogram[value];
    squares += histogram[value] * static_cast<double>(value * value);
  }
  return std::max(0.7, std::sqrt(squares / std::max(1.0, count)));
}

// One connected part, by the moments of its difference.
MoverCandidate candidate_of(const cv::Mat& difference, const cv::Mat& labels, int label,
                            const cv::Rect& bounds, double sd) {
  double sum = 0.0, greatest = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (int y = bounds.y; y < bounds.br().y; ++y) {
    for (int x = bounds.x; x < bounds.br().x; ++x) {
      if (labels.at<int>(y, x) != label) continue;
      const double value = difference.at<std::uint8_t>(y, x);
      const Eigen::Vector2d at(x, y);
      sum += value;
      first += value * at;
      second += value * at * at.transpose();
      greatest = std::max(greatest, value);
    }
  }
  MoverCandidate made;
  made.pixel = first / sum;
  made.strength = greatest / sd;
  // A centroid's variance: the extent by the signal's strength, and a pixel's own width.
  const Eigen::Matrix2d extent = second / sum - made.pixel * made.pixel.transpose();
  made.covariance_px2 = extent / std::max(1.0, made.strength) + Eigen::Matrix2d::Identity() / 12.0;
  made.box = bounds;
  return made;
}

void to_full_frame(MoverCandidate& candidate, const cv::Rect& area, const ReducedFrame& frame) {
  const double scale = frame.reduction;
  const Eigen::Vector2d in_frame = candidate.pixel + Eigen::Vector2d(area.x, area.y);
  candidate.pixel = transform(frame.to_full(), in_frame);
  candidate.covariance_px2 *= scale * scale;
  candidate.box = {(candidate.box.x + area.x) * scale, (candidate.box.y + area.y) * scale,
                   candidate.box.width * scale, candidate.box.height * scale};
}

}  // namespace

std::vector<MoverCandidate> detect_movers(const cv::Mat& earlier, const Eigen::Matrix3d& to_present,
                                          const ReducedFrame& current, const MoverSearch& search) {
  const bool usable =
      !earlier.empty() && earlier.type() == CV_8UC1 && !current.image.empty() && aligns(to_present);
  if (!usable) return {};
  const cv::Rect area = reduced_area(current, search.area);
  if (area.width < 3 || area.height < 3) return {};
  const cv::Mat now = current.image(area);
  const Eigen::Matrix3d to_reduced = current.to_full().inverse() * to_present;
  const cv::Mat difference =
      tolerant_difference(now, brought_to_present(earlier, to_reduced, now, area.tl()));
  // The tolerance hides most of the noise from the difference: what is left is its rare peaks.
  const double sd = std::max(fluctuation(difference), pixel_noise(now));
  cv::Mat mask, labels, statistics, centroids;
  cv::threshold(difference, mask, std::max(search.least_levels, search.threshold_sd * sd), 255.0,
                cv::THRESH_BINARY);
  const int parts = cv::connectedComponentsWithStats(mask, labels, statistics, centroids);
  std::vector<MoverCandidate> found;
  for (int part = 1; part < parts; ++part) {
    const cv::Rect bounds(
        statistics.at<int>(part, cv::CC_STAT_LEFT), statistics.at<int>(part, cv::CC_STAT_TOP),
        statistics.at<int>(part, cv::CC_STAT_WIDTH), statistics.at<int>(part, cv::CC_STAT_HEIGHT));
    if (std::max(bounds.width, bounds.height) * current.reduction > search.most_side_px) continue;
    found.push_back(candidate_of(difference, labels, part, bounds, sd));
    to_full_frame(found.back(), area, current);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.strength > b.strength; });
  if (static_cast<int>(found.size()) > search.most) {
    found.resize(static_cast<std::size_t>(search.most));
  }
  return found;
}

}  // namespace ols
