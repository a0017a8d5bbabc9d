#include "calibration/pictures/sun_disc.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRadius_rad = 959.63 / 206264.806;  // at one astronomical unit
constexpr double kSize = 0.03;

struct Blob {
  Vector2d centre = Vector2d::Zero();
  cv::Rect box;
  double area = 0.0;
  double level = 0.0;  // [gray] half way between the disc and what is around
};

// The one bright thing; nothing where there is none, or a second one of a tenth of its size.
std::optional<Blob> bright_thing(const cv::Mat& gray) {
  constexpr double kLeastContrast = 25.0;
  constexpr double kSecond = 0.1;
  cv::Mat mask, labels, stats, centres;
  const double level = cv::threshold(gray, mask, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const double contrast = cv::mean(gray, mask)[0] - cv::mean(gray, ~mask)[0];
  if (contrast < kLeastContrast) return std::nullopt;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centres, 8);
  Blob best;
  double second = 0.0;
  for (int i = 1; i < count; ++i) {
    const double area = stats.at<int>(i, cv::CC_STAT_AREA);
    if (area <= best.area) {
      second = std::max(second, area);
      continue;
    }
    second = best.area;
    best.area = area;
    best.centre = {centres.at<double>(i, 0), centres.at<double>(i, 1)};
    best.box = {stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)};
  }
  best.level = level;
  if (best.area == 0.0 || second > kSecond * best.area) return std::nullopt;
  return best;
}

double value(const cv::Mat& gray, const Vector2d& at) {
  const int x = static_cast<int>(at.x()), y = static_cast<int>(at.y());
  if (x < 0 || y < 0 || x + 1 >= gray.cols || y + 1 >= gray.rows) return 0.0;
  const double fx = at.x() - x, fy = at.y() - y;
  const auto g = [&gray](int row, int column) {
    return static_cast<double>(gray.at<unsigned char>(row, column));
  };
  return (1 - fy) * ((1 - fx) * g(y, x) + fx * g(y, x + 1)) +
         fy * ((1 - fx) * g(y + 1, x) + fx * g(y + 1, x + 1));
}

// Where rays from the middle fall below the level: the limb.
std::vector<Vector2d> limb(const cv::Mat& gray, const Blob& blob, double radius_px) {
  constexpr int kRays = 180;
  constexpr double kStep_px = 0.25, kPi = 3.14159265358979323846;
  std::vector<Vector2d> points;
  for (int i = 0; i < kRays; ++i) {
    const Vector2d along(std::cos(2.0 * kPi * i / kRays), std::sin(2.0 * kPi * i / kRays));
    double before = value(gray, blob.centre + 0.5 * radius_px * along);
    for (double r = 0.5 * radius_px + kStep_px; r < 1.5 * radius_px; r += kStep_px) {
      const double now = value(gray, blob.centre + r * along);
      if (before >= blob.level && now < blob.level) {
        const double back = kStep_px * (blob.level - now) / (before - now);
        points.push_back(blob.centre + (r - back) * along);
        break;
      }
      before = now;
    }
  }
  return points;
}

// A. Kasa, A Circle Fitting Procedure and its Error Analysis, 1976: x^2 + y^2 = 2 a x + 2 b y + c.
Vector3d circle(const std::vector<Vector2d>& points, const Vector2d& about) {
  Eigen::MatrixXd A(static_cast<Eigen::Index>(points.size()), 3);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const Vector2d p = points[static_cast<std::size_t>(i)] - about;
    A.row(i) << 2.0 * p.x(), 2.0 * p.y(), 1.0;
    b[i] = p.squaredNorm();
  }
  const Vector3d x = A.colPivHouseholderQr().solve(b);
  return {x[0] + about.x(), x[1] + about.y(),
          std::sqrt(std::max(0.0, x[2] + x[0] * x[0] + x[1] * x[1]))};
}

}  // namespace

const char* to_string(SunDisc::Refusal refusal) {
  switch (refusal) {
    case SunDisc::Refusal::kNone:
      return "the sun's disc";
    case SunDisc::Refusal::kNoDisc:
      return "no disc stands out";
    case SunDisc::Refusal::kAtTheEdge:
      return "the disc is cut by the picture's edge";
    case SunDisc::Refusal::kOtherSize:
      return "what is bright has not the sun's size";
    case SunDisc::Refusal::kNotRound:
      return "the disc is not round: clouds, or too long an exposure";
  }
  return "";
}

SunDisc find_sun(const cv::Mat& gray, double focal_px) {
  constexpr double kAround_px = 3.0;  // of the disc, for its limb's slope
  constexpr double kRound_px = 0.7;   // RMS of the limb about its circle
  constexpr double kFloor_px = 0.05;  // seeing, and what the filter does
  constexpr double kLimbFound = 0.9;  // of the rays
  constexpr int kRays = 180;
  SunDisc disc;
  const auto blob = bright_thing(gray);
  if (!blob) return disc;
  disc.refusal = SunDisc::Refusal::kAtTheEdge;
  const cv::Rect inside(static_cast<int>(kAround_px), static_cast<int>(kAround_px),
                        gray.cols - 2 * static_cast<int>(kAround_px),
                        gray.rows - 2 * static_cast<int>(kAround_px));
  if ((blob->box & inside) != blob->box) return disc;
  disc.refusal = SunDisc::Refusal::kOtherSize;
  const double wanted_px = focal_px * kRadius_rad;
  const double by_area_px = std::sqrt(blob->area / 3.14159265358979323846);
  if (std::abs(by_area_px / wanted_px - 1.0) > 3.0 * kSize) return disc;
  disc.refusal = SunDisc::Refusal::kNotRound;
  const std::vector<Vector2d> points = limb(gray, *blob, wanted_px);
  if (points.size() < kLimbFound * kRays) return disc;
  const Vector3d fit = circle(points, blob->centre);
  double squares = 0.0;
  for (const Vector2d& p : points) squares += std::pow((p - fit.head<2>()).norm() - fit[2], 2);
  const double rms_px = std::sqrt(squares / static_cast<double>(points.size()));
  if (rms_px > kRound_px) return disc;
  disc.centre_px = fit.head<2>();
  disc.radius_px = fit[2];
  disc.sd_px = std::hypot(kFloor_px, rms_px * std::sqrt(2.0 / static_cast<double>(points.size())));
  const bool is_sun = std::abs(disc.radius_px / wanted_px - 1.0) < kSize;
  disc.refusal = is_sun ? SunDisc::Refusal::kNone : SunDisc::Refusal::kOtherSize;
  return disc;
}

bool is_black(const cv::Mat& gray) {
  constexpr double kMean = 8.0, kMost = 40.0;
  cv::Mat smooth;
  cv::blur(gray, smooth, {5, 5});  // hot pixels are no sky
  double most = 0.0;
  cv::minMaxLoc(smooth, nullptr, &most);
  return cv::mean(gray)[0] < kMean && most < kMost;
}

}  // namespace ols::calibration
