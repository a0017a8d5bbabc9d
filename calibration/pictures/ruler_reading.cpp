#include "calibration/pictures/ruler_reading.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "calibration/pictures/gradients.h"
#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Refusal = RulerReading::Refusal;

constexpr double kZeroBars = 3.0;  // height of the zero

RulerReading refused(Refusal why, double scale = 1.0) {
  RulerReading reading;
  reading.refusal = why;
  reading.scale = scale;
  return reading;
}

// Mean of a strip of the ruler, row by row, a little smoothed.
std::vector<double> profile_at(const cv::Mat& gray, double x_px, double bar_px) {
  constexpr double kStrip = 0.5, kSmooth = 0.08;
  const int half = std::max(1, static_cast<int>(std::lround(kStrip * bar_px)));
  const cv::Rect strip =
      cv::Rect(static_cast<int>(std::lround(x_px)) - half, 0, 2 * half + 1, gray.rows) &
      cv::Rect({}, gray.size());
  cv::Mat mean;
  cv::reduce(gray(strip), mean, 1, cv::REDUCE_AVG, CV_32F);
  cv::GaussianBlur(mean, mean, {1, 0}, 0.0, std::max(1.0, kSmooth * bar_px), cv::BORDER_REPLICATE);
  std::vector<double> profile;
  for (int y = 0; y < mean.rows; ++y) profile.push_back(mean.at<float>(y, 0));
  return profile;
}

struct Edge {
  double y = 0.0;
  double slope = 0.0;  // [gray/px], downwards: > 0 from black to white
};

// The steepest places of the profile, each between its neighbours of the other sign.
std::vector<Edge> edges_of(const std::vector<double>& profile, double bar_px, double noise) {
  constexpr double kShare = 0.35, kReach = 0.3;
  const int n = static_cast<int>(profile.size());
  std::vector<double> slope(profile.size(), 0.0);
  for (int y = 1; y + 1 < n; ++y) {
    const auto i = static_cast<std::size_t>(y);
    slope[i] = 0.5 * (profile[i + 1] - profile[i - 1]);
  }
  double most = 0.0;
  for (const double value : slope) most = std::max(most, std::abs(value));
  const double least = std::max(kShare * most, noise);
  std::vector<Edge> edges;
  for (int y = 1; y + 1 < n; ++y) {
    const auto i = static_cast<std::size_t>(y);
    const double here = std::abs(slope[i]);
    if (here < least || here < std::abs(slope[i - 1]) || here <= std::abs(slope[i + 1])) continue;
    const double sign = slope[i] > 0.0 ? 1.0 : -1.0;
    const int reach = std::max(2, static_cast<int>(std::lround(kReach * bar_px)));
    double mass = 0.0, sum = 0.0;
    for (int k = std::max(0, y - reach); k <= std::min(n - 1, y + reach); ++k) {
      const double w = std::max(0.0, sign * slope[static_cast<std::size_t>(k)]);
      mass += w;
      sum += w * k;
    }
    const Edge edge{sum / mass, slope[i]};
    // Two maxima of one edge: the steeper one stays.
    if (!edges.empty() && edges.back().slope * edge.slope > 0.0 &&
        edge.y - edges.back().y < 0.5 * bar_px) {
      if (std::abs(edge.slope) > std::abs(edges.back().slope)) edges.back() = edge;
      continue;
    }
    edges.push_back(edge);
  }
  return edges;
}

// Height of a bar by the gaps between neighbours, those of the zero left out.
double median_gap(const std::vector<Edge>& edges) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < edges.size(); ++i) gaps.push_back(edges[i].y - edges[i - 1].y);
  return median(std::move(gaps));
}

// A dark gap of three bars between two neighbours: upper edge's index. Two of them: none.
std::optional<std::size_t> zero_of(const std::vector<Edge>& edges, double bar_px) {
  constexpr double kOff = 0.35;  // bars
  std::optional<std::size_t> zero;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const double bars = (edges[i].y - edges[i - 1].y) / bar_px;
    const bool is_dark = edges[i - 1].slope < 0.0 && edges[i].slope > 0.0;
    if (!is_dark || std::abs(bars - kZeroBars) > kOff) continue;
    if (zero) return std::nullopt;
    zero = i - 1;
  }
  return zero;
}

struct Mark {
  double y = 0.0, bars = 0.0;
};

// Each edge's height over the zero; those that are where no bar can end are left out.
std::vector<Mark> marks_of(const std::vector<Edge>& edges, std::size_t zero, double bar_px) {
  constexpr double kOff = 0.25;
  std::vector<Mark> marks;
  for (const int way : {-1, 1}) {
    const Edge& first = edges[zero + (way > 0 ? 1 : 0)];
    Mark last{first.y, -0.5 * kZeroBars * way};
    marks.push_back(last);
    double bar = bar_px;
    for (auto i = static_cast<std::ptrdiff_t>(zero) + (way > 0 ? 2 : -1);
         i >= 0 && i < static_cast<std::ptrdiff_t>(edges.size()); i += way) {
      const Edge& edge = edges[static_cast<std::size_t>(i)];
      const double gap = way * (edge.y - last.y) / bar;
      const double whole = std::round(gap);
      if (whole < 1.0 || std::abs(gap - whole) > kOff) continue;
      // Colours alternate: an odd number of bars from one edge to one of the other sign.
      const double bars = last.bars - way * whole;
      const bool is_odd = std::lround(std::abs(bars + 0.5 * kZeroBars * way)) % 2 != 0;
      if ((edge.slope * first.slope > 0.0) == is_odd) continue;
      last = {edge.y, bars};
      marks.push_back(last);
    }
  }
  return marks;
}

struct Fit {
  double zero_px = 0.0, bar_px = 0.0, rms_px = 0.0, n = 0.0, middle = 0.0, spread = 0.0;
};

// y = zero - bar h
Fit fit(const std::vector<Mark>& marks) {
  Fit result;
  double sh = 0.0, sy = 0.0, shh = 0.0, shy = 0.0, squares = 0.0;
  result.n = static_cast<double>(marks.size());
  for (const Mark& mark : marks) {
    sh += mark.bars;
    sy += mark.y;
  }
  result.middle = sh / result.n;
  for (const Mark& mark : marks) {
    shh += (mark.bars - result.middle) * (mark.bars - result.middle);
    shy += (mark.bars - result.middle) * (mark.y - sy / result.n);
  }
  result.spread = shh;
  result.bar_px = -shy / shh;
  result.zero_px = sy / result.n + result.bar_px * result.middle;
  for (const Mark& mark : marks) {
    squares += std::pow(mark.y - result.zero_px + result.bar_px * mark.bars, 2);
  }
  result.rms_px = std::sqrt(squares / std::max(1.0, result.n - 2.0));
  return result;
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kNothing:
      return "no ruler is there";
    case Refusal::kScale:
      return "the bars do not have the height that the distance gives";
    case Refusal::kNoZero:
      return "its zero, the one bar of three times the height, is not seen, or not alone";
    case Refusal::kShort:
      return "it does not reach the middle of the picture: tilt the unit";
    case Refusal::kUneven:
      return "its bars do not follow each other evenly: it is blurred or half hidden";
  }
  return "";
}

std::optional<Eigen::Vector2d> find_ruler(const cv::Mat& gray, double bar_px) {
  constexpr double kBar_px = 4.0;  // in the small picture
  constexpr double kLeastContrast = 6.0, kPeriods = 6.0;
  const double shrink = std::min(1.0, kBar_px / bar_px), period = 2.0 * bar_px * shrink;
  cv::Mat small, wave, other;
  gray.convertTo(small, CV_32F);
  cv::resize(small, small, {}, shrink, shrink, cv::INTER_AREA);
  // The strength of the period along each column (a Gabor filter), of ruler's width across.
  const int half = static_cast<int>(std::ceil(2.0 * period));
  cv::Mat cosine(2 * half + 1, 1, CV_32F), sine(2 * half + 1, 1, CV_32F);
  for (int k = -half; k <= half; ++k) {
    const double window = std::exp(-0.5 * k * k / (period * period));
    cosine.at<float>(k + half) = static_cast<float>(window * std::cos(CV_2PI * k / period));
    sine.at<float>(k + half) = static_cast<float>(window * std::sin(CV_2PI * k / period));
  }
  cosine -= cv::mean(cosine)[0];
  const double norm = cv::norm(cosine, cv::NORM_L1);
  cv::filter2D(small, wave, CV_32F, cosine / norm, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  cv::filter2D(small, other, CV_32F, sine / norm, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  const int width = 2 * std::max(1, static_cast<int>(0.5 * kBar_px)) + 1;
  cv::blur(wave, wave, {width, 1});
  cv::blur(other, other, {width, 1});
  cv::Mat strength;
  cv::magnitude(wave, other, strength);
  cv::blur(strength, strength, {1, std::max(3, static_cast<int>(kPeriods * period))});
  double most = 0.0;
  cv::Point at;
  cv::minMaxLoc(strength, nullptr, &most, nullptr, &at);
  if (most < kLeastContrast) return std::nullopt;
  return (Eigen::Vector2d(at.x, at.y) + Eigen::Vector2d::Constant(0.5)) / shrink -
         Eigen::Vector2d::Constant(0.5);
}

RulerReading read_ruler(const cv::Mat& gray, const Eigen::Vector2d& at_px, double bar_px,
                        double row_px) {
  constexpr double kScale = 0.1, kUneven = 0.1, kFloor_px = 0.03, kAboveNoise = 4.0;
  constexpr std::size_t kLeastEdges = 6;
  if (!cv::Rect2d({}, cv::Size2d(gray.size())).contains({at_px.x(), at_px.y()})) {
    return refused(Refusal::kNothing);
  }
  const auto edges = edges_of(profile_at(gray, at_px.x(), bar_px), bar_px,
                              kAboveNoise * gradients_of(gray, 1.0).sd / std::sqrt(bar_px));
  if (edges.size() < kLeastEdges) return refused(Refusal::kNothing);
  const double gap_px = median_gap(edges);
  const auto zero = zero_of(edges, gap_px);
  if (std::abs(gap_px / bar_px - 1.0) > 2.0 * kScale)
    return refused(Refusal::kScale, gap_px / bar_px);
  if (!zero) return refused(Refusal::kNoZero, gap_px / bar_px);
  const std::vector<Mark> marks = marks_of(edges, *zero, gap_px);
  if (marks.size() < kLeastEdges) return refused(Refusal::kUneven, gap_px / bar_px);
  const Fit line = fit(marks);
  RulerReading reading;
  reading.scale = line.bar_px / bar_px;
  if (std::abs(reading.scale - 1.0) > kScale) return refused(Refusal::kScale, reading.scale);
  if (line.rms_px > kUneven * line.bar_px) return refused(Refusal::kUneven, reading.scale);
  const auto [low, high] = std::ranges::minmax(marks, {}, &Mark::bars);
  reading.bars = (line.zero_px - row_px) / line.bar_px;
  if (reading.bars < low.bars || reading.bars > high.bars)
    return refused(Refusal::kShort, reading.scale);
  reading.x_px = at_px.x();
  reading.zero_px = line.zero_px;
  const double share = 1.0 / line.n + std::pow(reading.bars - line.middle, 2) / line.spread;
  reading.sd_px = std::hypot(kFloor_px, line.rms_px * std::sqrt(share));
  return reading;
}

}  // namespace ols::calibration
