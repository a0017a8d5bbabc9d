#include "calibration/pictures/level_lines.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "calibration/pictures/gradients.h"
#include "calibration/pictures/line_fit.h"
#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Refusal = LevelLines::Refusal;

constexpr double kSmoothing_px = 2.0;
constexpr double kSteepest = 0.14;  // 8 degrees
constexpr double kWidest_px = 40.0;

LevelLines refused(Refusal why) {
  LevelLines lines;
  lines.refusal = why;
  return lines;
}

// Mean of the gradient along each line y = offset + slope (x - middle), by whole offsets.
std::vector<double> profile_along(const cv::Mat& gradient, double slope) {
  const double middle = 0.5 * (gradient.cols - 1);
  std::vector<double> sums(static_cast<std::size_t>(gradient.rows), 0.0);
  for (int x = 0; x < gradient.cols; ++x) {
    const int shift = static_cast<int>(std::lround(slope * (x - middle)));
    const int from = std::max(0, -shift), to = std::min(gradient.rows, gradient.rows - shift);
    for (int y = from; y < to; ++y) {
      sums[static_cast<std::size_t>(y)] += gradient.at<float>(y + shift, x);
    }
  }
  for (double& sum : sums) sum /= gradient.cols;
  return sums;
}

double best_slope(const cv::Mat& gradient) {
  constexpr int kSmaller = 4;
  constexpr double kStep = 0.003;  // half a pixel at the edge of the small picture
  cv::Mat small;
  cv::resize(gradient, small, {}, 1.0 / kSmaller, 1.0 / kSmaller, cv::INTER_AREA);
  double best = 0.0, strongest = -1.0;
  for (double slope = -kSteepest; slope <= kSteepest; slope += kStep) {
    double strength = 0.0;
    for (const double mean : profile_along(small, slope)) strength += mean * mean;
    if (strength > strongest) strongest = strength, best = slope;
  }
  return best;
}

struct Peak {
  double offset = 0.0, strength = 0.0;  // with its sign
  double width_px = 0.0;                // full width at half of its height
};

// Local extremes that stand above the noise and above a share of the strongest.
std::vector<Peak> peaks_of(const std::vector<double>& profile, double noise) {
  constexpr double kShare = 0.2;
  constexpr int kApart_px = 4;
  double most = 0.0;
  for (const double value : profile) most = std::max(most, std::abs(value));
  const double least = std::max(noise, kShare * most);
  std::vector<Peak> peaks;
  const int n = static_cast<int>(profile.size());
  const auto at = [&profile](int i) { return profile[static_cast<std::size_t>(i)]; };
  for (int i = kApart_px; i + kApart_px < n; ++i) {
    const double here = std::abs(at(i));
    if (here < least) continue;
    bool highest = true;
    for (int k = -kApart_px; k <= kApart_px && highest; ++k) {
      highest = std::abs(at(i + k)) < here || (k >= 0 && std::abs(at(i + k)) <= here);
    }
    if (!highest) continue;
    int low = i, high = i;
    while (low > 0 && at(low) * at(i) > 0.5 * here * here) --low;
    while (high + 1 < n && at(high) * at(i) > 0.5 * here * here) ++high;
    peaks.push_back({static_cast<double>(i), at(i), static_cast<double>(high - low - 1)});
  }
  return peaks;
}

// Where the edge crosses each column, within a reach of the line.
LinePoints crossings(const cv::Mat& gradient, double offset, double slope, double sign,
                     double reach_px, double least_mass) {
  const double middle = 0.5 * (gradient.cols - 1);
  LinePoints points;
  for (int x = 0; x < gradient.cols; ++x) {
    const double line = offset + slope * (x - middle);
    const int from = std::max(0, static_cast<int>(std::ceil(line - reach_px)));
    const int to = std::min(gradient.rows - 1, static_cast<int>(std::floor(line + reach_px)));
    if (from > line || to < line) continue;
    double most = 0.0, mass = 0.0, sum = 0.0;
    for (int y = from; y <= to; ++y) {
      most = std::max(most, sign * static_cast<double>(gradient.at<float>(y, x)));
    }
    constexpr double kFoot = 0.25;  // what lies below is light that changes slowly
    for (int y = from; y <= to; ++y) {
      const double w = sign * static_cast<double>(gradient.at<float>(y, x)) - kFoot * most;
      if (w <= 0.0) continue;
      mass += w;
      sum += w * y;
    }
    if (mass < least_mass) continue;
    points.x.push_back(x);
    points.y.push_back(sum / mass);
  }
  return points;
}

std::optional<LevelEdge> edge_at(const cv::Mat& gradient, const Peak& peak, double slope) {
  // Neighbouring columns share their noise, and a printed edge its small waves.
  const double shared = 2.0 * std::sqrt(CV_PI) * kSmoothing_px;
  constexpr double kLeastShare = 0.25, kFloor_px = 0.02;
  const double sign = peak.strength > 0.0 ? 1.0 : -1.0;
  const double reach_px = std::max(6.0, 1.2 * peak.width_px);
  const double least_mass = 0.3 * std::abs(peak.strength) * peak.width_px;
  FittedLine line;
  line.offset = peak.offset;
  line.slope = slope;
  line.middle = 0.5 * (gradient.cols - 1);
  for (int round = 0; round < 3; ++round) {
    const double through = line.offset + line.slope * (0.5 * (gradient.cols - 1) - line.middle);
    const auto better =
        fit_line(crossings(gradient, through, line.slope, sign, reach_px, least_mass), line);
    if (!better) return std::nullopt;
    line = *better;
  }
  if (static_cast<double>(line.columns) < kLeastShare * gradient.cols) return std::nullopt;
  LevelEdge edge;
  const Vector2d half(line.gyration_px, line.slope * line.gyration_px);
  const Vector2d middle(line.middle, line.offset);
  edge.left_px = middle - half;
  edge.right_px = middle + half;
  edge.sd_px = std::hypot(
      kFloor_px, line.rms_px * std::sqrt(2.0 * shared / static_cast<double>(line.columns)));
  return edge;
}

double slope_of(const LevelEdge& edge) {
  const Vector2d along = edge.right_px - edge.left_px;
  return along.y() / along.x();
}

// A shadow or a roof is not parallel to the others.
void keep_parallel(std::vector<LevelEdge>& edges) {
  constexpr double kParallel = 0.02;
  std::vector<double> slopes;
  slopes.reserve(edges.size());
  for (const LevelEdge& edge : edges) slopes.push_back(slope_of(edge));
  const double common = median(std::move(slopes));
  std::erase_if(edges, [common](const LevelEdge& edge) {
    return std::abs(slope_of(edge) - common) > kParallel;
  });
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kNothing:
      return "no level line stands out";
    case Refusal::kShort:
      return "no line is seen over a quarter of the picture's width: the target is too small, too "
             "far away, or hidden";
    case Refusal::kSteep:
      return "the lines lean by more than 8 degrees: is the target level, is the camera upright?";
    case Refusal::kBlurred:
      return "the lines are blurred over more than 40 px: put the target farther away";
  }
  return "";
}

LevelLines find_level_lines(const cv::Mat& gray) {
  constexpr double kAboveNoise = 6.0;
  constexpr int kLeastSize_px = 64;
  if (gray.cols < kLeastSize_px || gray.rows < kLeastSize_px) return refused(Refusal::kNothing);
  const Gradients gradients = gradients_of(gray, kSmoothing_px);
  const double slope = best_slope(gradients.y);
  const double noise =
      kAboveNoise * gradients.sd * std::sqrt(2.0 * std::sqrt(CV_PI) * kSmoothing_px / gray.cols);
  const std::vector<Peak> peaks = peaks_of(profile_along(gradients.y, slope), noise);
  if (peaks.empty()) return refused(Refusal::kNothing);
  if (std::abs(slope) > kSteepest - 0.004) return refused(Refusal::kSteep);
  LevelLines lines;
  bool blurred = false;
  for (const Peak& peak : peaks) {
    if (peak.width_px > kWidest_px) {
      blurred = true;
    } else if (const auto edge = edge_at(gradients.y, peak, slope)) {
      lines.edges.push_back(*edge);
    }
  }
  if (lines.edges.empty()) return refused(blurred ? Refusal::kBlurred : Refusal::kShort);
  keep_parallel(lines.edges);
  for (const LevelEdge& edge : lines.edges) {
    lines.slope += slope_of(edge) / static_cast<double>(lines.edges.size());
  }
  return lines;
}

}  // namespace ols::calibration
