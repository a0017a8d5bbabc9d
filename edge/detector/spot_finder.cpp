#include "edge/detector/spot_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

namespace ols::detector {
namespace {

constexpr int kReach = 8;       // [px of a level] of the ring, from the centre
constexpr int kInside = 5;      // where the ring begins
constexpr int kMargin = 4;      // [px of a level] nearest place to the image's edge
constexpr double kFloor = 0.5;  // [grey levels] a smooth sky's noise hides in the rounding

// `at` is not at the edge.
int sum_of_nine(const cv::Mat& level, const cv::Point& at) {
  int sum = 0;
  for (int y = -1; y <= 1; ++y) {
    const auto* here = level.ptr<std::uint8_t>(at.y + y) + at.x;
    sum += here[-1] + here[0] + here[1];
  }
  return sum;
}

std::int16_t greatest(const cv::Mat& residual, int y, int from, int to) {
  std::int16_t value = 0;
  const auto* row = residual.ptr<std::int16_t>(y);
  for (int x = from; x < to; ++x) value = std::max(value, row[x]);
  return value;
}

// In the 5x5 pixels around it.
bool is_greatest_nearby(const cv::Mat& residual, const cv::Point& at) {
  const auto value = residual.at<std::int16_t>(at);
  for (int y = -2; y <= 2; ++y) {
    const auto* row = residual.ptr<std::int16_t>(at.y + y) + at.x;
    for (int x = -2; x <= 2; ++x) {
      if (row[x] > value) return false;
    }
  }
  return true;
}

// Whether the place stands out to nearly all sides: rejects most of a texture at little cost.
bool stands_out(const cv::Mat& level, const cv::Point& at, int centre) {
  static constexpr std::array<std::array<int, 2>, 12> kAround{{{6, 0},
                                                               {5, 3},
                                                               {3, 5},
                                                               {0, 6},
                                                               {-3, 5},
                                                               {-5, 3},
                                                               {-6, 0},
                                                               {-5, -3},
                                                               {-3, -5},
                                                               {0, -6},
                                                               {3, -5},
                                                               {5, -3}}};
  int brighter = 0, darker = 0, seen = 0;
  for (const auto& [x, y] : kAround) {
    const cv::Point there(at.x + x, at.y + y);
    if (there.x < 0 || there.y < 0 || there.x >= level.cols || there.y >= level.rows) continue;
    const int value = level.at<std::uint8_t>(there);
    ++seen;
    if (value < centre) ++brighter;
    if (value > centre) ++darker;
  }
  return std::max(brighter, darker) >= seen - 1;
}

// Order statistics of the ring's grey levels, by their histogram.
class Ring {
 public:
  Ring(const cv::Mat& level, const cv::Point& at) {
    std::array<int, kLevels> levels{};
    for (int y = -kReach; y <= kReach; ++y) {
      if (at.y + y < 0 || at.y + y >= level.rows) continue;
      const auto* row = level.ptr<std::uint8_t>(at.y + y);
      for (int x = -kReach; x <= kReach; ++x) {
        if (std::max(std::abs(x), std::abs(y)) < kInside) continue;
        if (at.x + x < 0 || at.x + x >= level.cols) continue;
        ++levels[row[at.x + x]];
        ++count_;
      }
    }
    median_ = order(levels, 0.5);
    for (int i = 0; i < kLevels; ++i) deviations_[std::abs(i - median_)] += levels[i];
  }
  int median() const { return median_; }
  double clutter() const { return order(deviations_, 0.95); }
  // From the lower three quarters of the deviations. Their median would be a whole grey level: a
  // noise of 1 and one of 2 could not be told apart.
  double noise() const {
    constexpr double kShare = 0.75, kNormal = 1.943;  // by the mean of |z| below its 75 %
    const int wanted = rank(kShare) + 1;
    int seen = 0, sum = 0;
    for (int i = 0; seen < wanted; ++i) {
      const int more = std::min(deviations_[i], wanted - seen);
      seen += more;
      sum += more * i;
    }
    return std::max(kFloor, kNormal * sum / wanted);
  }

 private:
  static constexpr int kLevels = 256;
  int rank(double share) const { return static_cast<int>(share * (count_ - 1.0)); }
  int order(const std::array<int, kLevels>& histogram, double share) const {
    const int wanted = rank(share);
    int value = 0;
    for (int seen = histogram[0]; seen <= wanted; seen += histogram[++value]) {
    }
    return value;
  }
  std::array<int, kLevels> deviations_{};
  int count_ = 0;
  int median_ = 0;
};

// Centre and size of a spot, pixels of the level.
struct Extent {
  Eigen::Vector2d centre, size;
};

// The connected pixels beyond two fifths of the peak. Empty if they reach the ring's outer edge:
// then the spot is part of something larger, such as a branch or a mast.
std::optional<Extent> island_at(const cv::Mat& level, const cv::Point& at, double surroundings,
                                double peak) {
  const cv::Rect inside({}, level.size());
  cv::Mat_<std::uint8_t> visited = cv::Mat_<std::uint8_t>::zeros(2 * kReach + 1, 2 * kReach + 1);
  std::vector<cv::Point> border;  // relative to `at`
  double weights = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  cv::Rect bounds;
  const auto visit = [&](const cv::Point& off) {
    if (!inside.contains(at + off)) return;
    std::uint8_t& mark = visited(off.y + kReach, off.x + kReach);
    if (mark != 0) return;
    mark = 1;
    const double value = (level.at<std::uint8_t>(at + off) - surroundings) / peak;
    if (value < 0.4) return;
    weights += value;
    first += value * Eigen::Vector2d(off.x, off.y);
    bounds |= cv::Rect(at + off, cv::Size(1, 1));
    border.push_back(off);
  };
  const auto visit_around = [&](const cv::Point& off) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) visit(off + cv::Point(x, y));
    }
  };
  visit_around({0, 0});
  while (!border.empty()) {
    const cv::Point off = border.back();
    border.pop_back();
    if (std::max(std::abs(off.x), std::abs(off.y)) == kReach) return std::nullopt;
    visit_around(off);
  }
  if (weights <= 0.0) return std::nullopt;
  return Extent{Eigen::Vector2d(at.x, at.y) + first / weights,
                Eigen::Vector2d(bounds.width, bounds.height)};
}

// Whether one pixel of the full image has most of a spot's light. Optics spread that of an object
// over several pixels, so a defect of the sensor is likely.
bool lone_pixel(const cv::Mat& gray, const Eigen::Vector2d& centre, double surroundings,
                double light) {
  constexpr int kNear_px = 3;
  constexpr double kMost = 0.7;
  const cv::Point at(static_cast<int>(centre.x()), static_cast<int>(centre.y()));
  const cv::Rect near_by(at.x - kNear_px, at.y - kNear_px, 2 * kNear_px + 1, 2 * kNear_px + 1);
  double lowest = 0.0, highest = 0.0;
  cv::minMaxLoc(gray(near_by & cv::Rect({}, gray.size())), &lowest, &highest);
  const double greatest = light > 0.0 ? highest - surroundings : surroundings - lowest;
  return greatest > kMost * std::abs(light);
}

bool overlap(const Detection& a, const Detection& b) {
  const Eigen::Vector2d apart = (a.pixel - b.pixel).cwiseAbs();
  const Eigen::Vector2d reach = 0.5 * (a.size_px + b.size_px) + Eigen::Vector2d(3.0, 3.0);
  return apart.x() <= reach.x() && apart.y() <= reach.y();
}

// One spot shows in several levels, and a large one in several places: the strongest remains.
std::vector<Detection> distinct(std::vector<Detection> spots, std::size_t most) {
  std::stable_sort(spots.begin(), spots.end(), [](const Detection& a, const Detection& b) {
    return a.signal_to_noise > b.signal_to_noise;
  });
  std::vector<Detection> kept;
  for (const Detection& spot : spots) {
    if (kept.size() == most) break;
    const auto same = [&](const Detection& other) { return overlap(spot, other); };
    if (std::none_of(kept.begin(), kept.end(), same)) kept.push_back(spot);
  }
  return kept;
}

}  // namespace

void SpotFinder::find_in(const cv::Mat& gray, const cv::Mat& level, int reduction,
                         std::vector<Detection>& spots) {
  residual_.measure(level);
  usual_.begin(residual_.image());
  for (int row = 0; row < usual_.rows(); ++row) {
    for (int column = 0; column < usual_.columns(); ++column) {
      find_peaks(column, row);
      for (const cv::Point& at : peaks_) {
        if (auto spot = spot_at(gray, level, at, reduction)) spots.push_back(*spot);
      }
    }
  }
}

// In white noise, a peak that just reaches `threshold_sd` is 20 times the median of the residual.
// To require a fifth of that rejects most of a texture's peaks at little cost, and none of a
// target's.
void SpotFinder::find_peaks(int column, int row) {
  constexpr std::int16_t kTimesUsual = 4;
  const cv::Mat& residual = residual_.image();
  const cv::Rect inside(kMargin, kMargin, residual.cols - 2 * kMargin, residual.rows - 2 * kMargin);
  const cv::Rect tile = usual_.tile(column, row) & inside;
  const auto least = static_cast<std::int16_t>(BoxResidual::kUnits * config_.least_levels);
  std::optional<std::int16_t> wanted;
  peaks_.clear();
  for (int y = tile.y; y < tile.br().y; ++y) {
    const std::int16_t most = greatest(residual, y, tile.x, tile.br().x);
    if (most < least) continue;
    if (!wanted) wanted = std::max<std::int16_t>(least, kTimesUsual * usual_.median(column, row));
    if (most < *wanted) continue;
    const auto* here = residual.ptr<std::int16_t>(y);
    for (int x = tile.x; x < tile.br().x; ++x) {
      if (here[x] >= *wanted && is_greatest_nearby(residual, {x, y})) peaks_.emplace_back(x, y);
    }
  }
}

std::optional<Detection> SpotFinder::spot_at(const cv::Mat& gray, const cv::Mat& level,
                                             const cv::Point& at, int reduction) {
  const int sum = sum_of_nine(level, at);
  if (!stands_out(level, at, sum / 9)) return std::nullopt;
  const Ring ring(level, at);
  const double peak = sum / 9.0 - ring.median();
  const double height = std::abs(peak), noise = ring.noise();
  if (height < config_.least_levels || height < config_.threshold_sd * noise) return std::nullopt;
  if (ring.clutter() > config_.most_clutter * height) return std::nullopt;
  const std::optional<Extent> extent = island_at(level, at, ring.median(), peak);
  if (!extent) return std::nullopt;
  // Pixel centres: full = (reduced + 0.5) * reduction - 0.5.
  const Eigen::Vector2d centre = (extent->centre.array() + 0.5) * reduction - 0.5;
  const double light = peak * 9.0 * reduction * reduction;
  const bool clear = exceeds_surroundings(at) && !lone_pixel(gray, centre, ring.median(), light);
  return Detection{centre,     extent->size * reduction, height / noise,
                   peak > 0.0, Evidence::kSpot,          clear};
}

bool SpotFinder::exceeds_surroundings(const cv::Point& at) {
  constexpr double kSdOfMedian = 1.4826;  // of a normal distribution
  const double noise =
      std::max(kFloor * BoxResidual::kUnits, kSdOfMedian * usual_.largest_nearby(at));
  return residual_.image().at<std::int16_t>(at) > config_.threshold_sd * noise;
}

std::vector<Detection> SpotFinder::find(const cv::Mat& gray) {
  constexpr int kLeastSide = 3 * kReach;
  std::vector<Detection> spots;
  cv::Mat level = gray;
  for (std::size_t i = 0; i < reduced_.size() + 1; ++i) {
    if (std::min(level.cols, level.rows) < kLeastSide) break;
    find_in(gray, level, 1 << i, spots);
    if (i == reduced_.size()) break;
    cv::pyrDown(level, reduced_[i]);
    level = reduced_[i];
  }
  return distinct(std::move(spots), config_.most);
}

}  // namespace ols::detector
