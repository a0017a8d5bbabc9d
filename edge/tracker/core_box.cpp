#include "edge/tracker/core_box.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace ols::tracker {
namespace {

constexpr double kCertain = 5.0;     // standard deviations of the surroundings
constexpr double kShare = 0.35;      // of the maximum difference: still the target
constexpr double kLeastNoise = 0.7;  // [grey levels]
constexpr double kMostFill = 0.6;    // of the box's area: beyond it the box is the core
constexpr double kLeastSide = 8.0;   // [px]
constexpr double kElsewhere = 0.15;  // of what stands out in the box, at most, beside the core

struct Ground {
  Eigen::Vector3d plane;  // grey level = plane . (x, y, 1)
  double sd;              // of the plane's residuals, robust
};

// A plane through the outermost pixels of the box: the sky's gradient.
Ground fit_ground(const cv::Mat& gray) {
  const int band = std::max(1, std::min(gray.cols, gray.rows) / 8);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto each = [&](const auto& visit) {
    for (int y = 0; y < gray.rows; ++y) {
      for (int x = 0; x < gray.cols; ++x) {
        const bool inner = x >= band && y >= band && x < gray.cols - band && y < gray.rows - band;
        if (!inner) visit(Eigen::Vector3d(x, y, 1.0), static_cast<double>(gray.at<float>(y, x)));
      }
    }
  };
  each([&](const Eigen::Vector3d& row, double value) {
    normal += row * row.transpose();
    right += row * value;
  });
  Ground ground{normal.ldlt().solve(right), 0.0};
  std::vector<double> left;
  each([&](const Eigen::Vector3d& row, double value) {
    left.push_back(std::abs(value - row.dot(ground.plane)));
  });
  const auto middle = left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2);
  std::nth_element(left.begin(), middle, left.end());
  ground.sd = std::max(kLeastNoise, 1.4826 * *middle);
  return ground;
}

// |gray - ground|, weighted down away from the centre, where the operator put the target.
cv::Mat difference_from(const cv::Mat& gray, const Ground& ground, cv::Mat& weighted) {
  cv::Mat difference(gray.size(), CV_32F);
  weighted.create(gray.size(), CV_32F);
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) {
      const double off = std::abs(static_cast<double>(gray.at<float>(y, x)) -
                                  Eigen::Vector3d(x, y, 1.0).dot(ground.plane));
      const double u = (x + 0.5) / gray.cols - 0.5;
      const double v = (y + 0.5) / gray.rows - 0.5;
      difference.at<float>(y, x) = static_cast<float>(off);
      weighted.at<float>(y, x) = static_cast<float>(off * std::exp(-6.0 * (u * u + v * v)));
    }
  }
  return difference;
}

// The bounds of what stands out at the peak, with what all but touches it.
cv::Rect bounds_of(const cv::Mat& standing_out, const cv::Point& peak) {
  cv::Mat mask, labels, statistics, centroids;
  const int side = std::max(3, std::min(mask.cols, mask.rows) / 6) | 1;
  cv::morphologyEx(standing_out, mask, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  cv::connectedComponentsWithStats(mask, labels, statistics, centroids);
  const int part = labels.at<int>(peak);
  return {statistics.at<int>(part, cv::CC_STAT_LEFT), statistics.at<int>(part, cv::CC_STAT_TOP),
          statistics.at<int>(part, cv::CC_STAT_WIDTH),
          statistics.at<int>(part, cv::CC_STAT_HEIGHT)};
}

// Whether what stands out is one thing in a generous box: it leaves the box's border free, and
// hardly anything else stands out. The head of a walker does too, and so do his feet.
bool is_alone(const cv::Mat& standing_out, const cv::Rect& part) {
  if (part.x == 0 || part.y == 0 || part.br().x == standing_out.cols ||
      part.br().y == standing_out.rows) {
    return false;
  }
  const int own = cv::countNonZero(standing_out(part));
  return own >= (1.0 - kElsewhere) * cv::countNonZero(standing_out);
}

}  // namespace

cv::Rect2d find_core(const cv::Mat& gray, const cv::Rect2d& box) {
  const cv::Rect whole(static_cast<int>(std::floor(box.x)), static_cast<int>(std::floor(box.y)),
                       static_cast<int>(std::ceil(box.width)),
                       static_cast<int>(std::ceil(box.height)));
  const cv::Rect area = whole & cv::Rect(0, 0, gray.cols, gray.rows);
  if (std::min(area.width, area.height) < 1.5 * kLeastSide) return box;
  cv::Mat smooth, weighted;
  gray(area).convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {3, 3}, 0.8);
  const Ground ground = fit_ground(smooth);
  const cv::Mat difference = difference_from(smooth, ground, weighted);
  cv::Point peak;
  cv::minMaxLoc(weighted, nullptr, nullptr, nullptr, &peak);
  const double most = static_cast<double>(difference.at<float>(peak));
  if (most < kCertain * ground.sd) return box;
  const double threshold = std::max(0.6 * kCertain * ground.sd, kShare * most);
  const cv::Mat standing_out = difference > threshold;
  const cv::Rect part = bounds_of(standing_out, peak);
  if (!is_alone(standing_out, part)) return box;
  const double width = std::max(kLeastSide, 1.3 * part.width + 2.0);
  const double height = std::max(kLeastSide, 1.3 * part.height + 2.0);
  const cv::Rect2d core(area.x + part.x + 0.5 * (part.width - width),
                        area.y + part.y + 0.5 * (part.height - height), width, height);
  return core.area() < kMostFill * box.area() ? core : box;
}

}  // namespace ols::tracker
