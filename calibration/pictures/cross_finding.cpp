#include "calibration/pictures/cross_finding.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "calibration/pictures/line_fit.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Refusal = Crosses::Refusal;

constexpr double kAlike = 0.6;   // correlation of a cross
constexpr double kScale = 0.12;  // by which its size may be off
constexpr double kApart = 0.06;  // by which the distance of two may be off, of the one expected
constexpr double kLevel = 0.15;  // slope of the line through both

struct Candidate {
  Vector2d px = Vector2d::Zero();  // of the small picture
  double alike = 0.0;
};

// A little blurred: arms of real pictures have soft edges.
cv::Mat drawn_cross(double arm_px, double width_px) {
  const int half = static_cast<int>(std::ceil(1.15 * arm_px + 1.0));
  constexpr int kFine = 4;
  const int size = (2 * half + 1) * kFine, middle = size / 2;
  cv::Mat fine(size, size, CV_32F, cv::Scalar(1.0));
  const auto arm = static_cast<int>(std::lround(arm_px * kFine));
  const auto width = static_cast<int>(std::lround(0.5 * width_px * kFine));
  const auto bar = [&](int x, int y) {
    cv::rectangle(fine, {middle - x, middle - y}, {middle + x, middle + y}, 0.0, cv::FILLED);
  };
  bar(arm, width);
  bar(width, arm);
  cv::Mat cross;
  cv::resize(fine, cross, {2 * half + 1, 2 * half + 1}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(cross, cross, {}, 0.25 * width_px);
  return cross;
}

// The best places, none nearer to another than half an arm.
std::vector<Candidate> candidates(const cv::Mat& picture, double arm_px, double width_px) {
  constexpr std::size_t kMost = 8;
  const cv::Mat cross = drawn_cross(arm_px, width_px);
  std::vector<Candidate> found;
  if (cross.cols >= picture.cols || cross.rows >= picture.rows) return found;
  cv::Mat alike;
  cv::matchTemplate(picture, cross, alike, cv::TM_CCOEFF_NORMED);
  const Vector2d half(0.5 * (cross.cols - 1), 0.5 * (cross.rows - 1));
  while (found.size() < kMost) {
    double most = 0.0;
    cv::Point at;
    cv::minMaxLoc(alike, nullptr, &most, nullptr, &at);
    if (!(most >= kAlike)) break;
    found.push_back({Vector2d(at.x, at.y) + half, most});
    cv::circle(alike, at, std::max(2, static_cast<int>(0.5 * arm_px)), -1.0, cv::FILLED);
  }
  return found;
}

struct Match {
  Candidate left, right;
  double scale = 1.0;
  bool is_pair = false;
  double score() const { return 0.5 * (left.alike + right.alike); }
};

// Two on a level line, as far apart as they should be; else the best one.
std::optional<Match> match_at(const cv::Mat& picture, const CrossSize& small, double scale) {
  const auto all = candidates(picture, small.arm_px * scale, small.width_px * scale);
  if (all.empty()) return std::nullopt;
  Match best{all[0], all[0], scale, false};
  if (small.apart_px <= 0.0) return best;
  for (const Candidate& left : all) {
    for (const Candidate& right : all) {
      const Vector2d way = right.px - left.px;
      const double apart = small.apart_px * scale;
      const double tolerance = kApart * apart + 2.0;
      if (std::abs(way.x() - apart) > tolerance || std::abs(way.y()) > kLevel * apart + 2.0) {
        continue;
      }
      const Match pair{left, right, scale, true};
      if (!best.is_pair || pair.score() > best.score()) best = pair;
    }
  }
  return best;
}

Crosses refused(Refusal why, double scale = 1.0) {
  Crosses crosses;
  crosses.refusal = why;
  crosses.scale = scale;
  return crosses;
}

// Of several sizes the one that fits best. A pair tells more than one cross does, if none of the
// two is much less alike than the best cross of all: else one is hidden, and the other thing is
// none.
std::optional<Match> best_match(const cv::Mat& picture, const CrossSize& small) {
  constexpr double kAsGood = 0.8;
  std::vector<Match> all;
  double most = 0.0;
  for (const double scale : {1.0, 0.9, 1.1, 0.8, 1.22, 0.7, 1.36, 0.6, 1.5, 1.7}) {
    const auto match = match_at(picture, small, scale);
    if (!match) continue;
    most = std::max({most, match->left.alike, match->right.alike});
    all.push_back(*match);
  }
  std::optional<Match> best;
  for (Match& match : all) {
    match.is_pair = match.is_pair && std::min(match.left.alike, match.right.alike) > kAsGood * most;
    const bool better = !best || (match.is_pair && !best->is_pair) ||
                        (match.is_pair == best->is_pair && match.score() > best->score());
    if (better) best = match;
  }
  return best;
}

// Centroids of the dark arm along x, or of the other one along y: in each column, but those that
// the other arm covers, within a reach of the line.
LinePoints arm_points(const cv::Mat& gray, const Vector2d& centre, const CrossSize& size,
                      const FittedLine& line, bool along_x) {
  const int x0 = static_cast<int>(std::lround(along_x ? centre.x() : centre.y()));
  const int from = static_cast<int>(std::ceil(1.5 * size.width_px));
  const int to = std::max(from, static_cast<int>(0.9 * size.arm_px));
  const double reach_px = 1.3 * size.width_px + 2.0;
  const auto value = [&](int x, int y) {
    return static_cast<double>(along_x ? gray.at<std::uint8_t>(y, x) : gray.at<std::uint8_t>(x, y));
  };
  const int most_x = (along_x ? gray.cols : gray.rows) - 1;
  const int most_y = (along_x ? gray.rows : gray.cols) - 1;
  LinePoints points;
  for (int dx = -to; dx <= to; ++dx) {
    const int x = x0 + dx;
    if (std::abs(dx) < from || x < 0 || x > most_x) continue;
    const double middle = line.offset + line.slope * (x - line.middle);
    const int low = static_cast<int>(std::ceil(middle - reach_px));
    const int high = static_cast<int>(std::floor(middle + reach_px));
    if (low < 0 || high > most_y) continue;
    double mass = 0.0, sum = 0.0;
    for (int y = low; y <= high; ++y) {
      // The light board around it, which is a slope where the light is uneven.
      const double share = static_cast<double>(y - low) / (high - low);
      const double light = (1.0 - share) * value(x, low) + share * value(x, high);
      const double dark = std::max(0.0, light - value(x, y));
      mass += dark;
      sum += dark * y;
    }
    constexpr double kLeastContrast = 15.0;
    if (mass < kLeastContrast * size.width_px) continue;
    points.x.push_back(x);
    points.y.push_back(sum / mass);
  }
  return points;
}

struct Placed {
  Vector2d px = Vector2d::Zero();
  double sd_px = 0.0;
};

// Where the middle lines of the two arms cross; nothing where too little of an arm is seen.
std::optional<Placed> placed(const cv::Mat& gray, Vector2d centre, const CrossSize& size) {
  constexpr int kRounds = 3;
  constexpr double kLeastShare = 0.35, kFloor_px = 0.02;
  const double expected = 2.0 * std::max(1.0, 0.9 * size.arm_px - 1.5 * size.width_px);
  FittedLine across, upright;
  across.offset = centre.y(), across.middle = centre.x();
  upright.offset = centre.x(), upright.middle = centre.y();
  double variance = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const auto h = fit_line(arm_points(gray, centre, size, across, true), across);
    const auto v = fit_line(arm_points(gray, centre, size, upright, false), upright);
    const double least = kLeastShare * expected;
    if (!h || !v || static_cast<double>(std::min(h->columns, v->columns)) < least) {
      return std::nullopt;
    }
    across = *h;
    upright = *v;
    // y = a + b (x - xm), x = c + d (y - ym)
    const double x =
        (upright.offset +
         upright.slope * (across.offset - across.slope * across.middle - upright.middle)) /
        (1.0 - upright.slope * across.slope);
    centre = {x, across.offset + across.slope * (x - across.middle)};
    variance = std::max(across.rms_px * across.rms_px / static_cast<double>(across.columns),
                        upright.rms_px * upright.rms_px / static_cast<double>(upright.columns));
  }
  return Placed{centre, std::hypot(kFloor_px, std::sqrt(variance))};
}

}  // namespace

const char* to_string(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "none";
    case Refusal::kNothing:
      return "no cross of the stated size is in the picture";
    case Refusal::kOne:
      return "only one of the two crosses is in the picture";
    case Refusal::kScale:
      return "the crosses do not have the size that their distance gives";
    case Refusal::kBlurred:
      return "the cross is blurred or half hidden: put the target farther away, or clear the view";
  }
  return "";
}

Crosses find_crosses(const cv::Mat& gray, const CrossSize& expected) {
  constexpr double kArm_px = 5.0;  // width of an arm in the small picture
  constexpr double kPoor_px = 0.33;
  const double shrink = std::min(1.0, kArm_px / expected.width_px);
  cv::Mat small;
  gray.convertTo(small, CV_32F);
  cv::resize(small, small, {}, shrink, shrink, cv::INTER_AREA);
  const auto match = best_match(
      small, {expected.arm_px * shrink, expected.width_px * shrink, expected.apart_px * shrink});
  if (!match) return refused(Refusal::kNothing);
  if (expected.apart_px > 0.0 && !match->is_pair) return refused(Refusal::kOne);
  // The two tell their size better than the arms do.
  const double scale =
      match->is_pair ? (match->right.px - match->left.px).norm() / (expected.apart_px * shrink)
                     : match->scale;
  if (std::abs(scale - 1.0) > kScale) return refused(Refusal::kScale, scale);
  const auto in_full = [shrink](const Candidate& one) -> Vector2d {
    // Pixels of the small picture cover several of the large one.
    return (one.px + Vector2d::Constant(0.5)) / shrink - Vector2d::Constant(0.5);
  };
  const auto left = placed(gray, in_full(match->left), expected);
  const auto right = placed(gray, in_full(match->right), expected);
  if (!left || !right || right->sd_px > kPoor_px) return refused(Refusal::kBlurred, scale);
  return {Refusal::kNone, scale, left->px, right->px, right->sd_px};
}

}  // namespace ols::calibration
