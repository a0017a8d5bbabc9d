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
constexpr int kUnits = 16;      // of a grey level, in the residual
constexpr double kFloor = 0.5;  // [grey levels] a smooth sky's noise hides in the rounding

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
  // Of the lower three quarters of the deviations. Their median would be a whole grey level: a
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

// The connected pixels beyond two fifths of the peak. Empty where they reach the ring's outer edge:
// the end of a branch or a mast hangs on what is larger.
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

// The mean of 3x3 pixels minus that of the surrounding ones: the matched filter of a small spot.
void SpotFinder::residual(const cv::Mat& level) {
  const auto sum = [&](cv::Mat& sums, int side) {
    cv::boxFilter(level, sums, CV_16U, {side, side}, {-1, -1}, false, cv::BORDER_REPLICATE);
  };
  sum(small_sum_, 3);
  sum(inner_sum_, 7);
  sum(outer_sum_, 13);
  residual_.create(level.size(), CV_16U);
  for (int y = 0; y < level.rows; ++y) {
    const auto* small = small_sum_.ptr<std::uint16_t>(y);
    const auto* inner = inner_sum_.ptr<std::uint16_t>(y);
    const auto* outer = outer_sum_.ptr<std::uint16_t>(y);
    auto* out = residual_.ptr<std::uint16_t>(y);
    for (int x = 0; x < level.cols; ++x) {
      const float difference = static_cast<float>(small[x]) * (kUnits / 9.0F) -
                               static_cast<float>(outer[x] - inner[x]) * (kUnits / 120.0F);
      out[x] = static_cast<std::uint16_t>(static_cast<std::int32_t>(std::abs(difference)));
    }
  }
  cv::dilate(residual_, greatest_, cv::Mat::ones(5, 5, CV_8U));
}

void SpotFinder::measure_surroundings() {
  constexpr int kTile = 24;
  const int columns = std::max(1, residual_.cols / kTile);
  const int rows = std::max(1, residual_.rows / kTile);
  cv::Mat medians(rows, columns, CV_16U);
  std::vector<std::uint16_t> values;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      values.clear();
      for (int y = j * residual_.rows / rows; y < (j + 1) * residual_.rows / rows; y += 3) {
        const auto* row = residual_.ptr<std::uint16_t>(y);
        for (int x = i * residual_.cols / columns; x < (i + 1) * residual_.cols / columns; x += 3) {
          values.push_back(row[x]);
        }
      }
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
      std::nth_element(values.begin(), middle, values.end());
      medians.at<std::uint16_t>(j, i) = *middle;
    }
  }
  cv::dilate(medians, usual_, cv::Mat::ones(3, 3, CV_8U));
}

void SpotFinder::find_in(const cv::Mat& gray, const cv::Mat& level, int reduction,
                         std::vector<Detection>& spots) {
  residual(level);
  measure_surroundings();
  const auto least = static_cast<std::uint16_t>(kUnits * config_.least_levels);
  for (int y = kMargin; y < level.rows - kMargin; ++y) {
    const auto* here = residual_.ptr<std::uint16_t>(y);
    const auto* nearby = greatest_.ptr<std::uint16_t>(y);
    for (int x = kMargin; x < level.cols - kMargin; ++x) {
      if (here[x] < least || here[x] < nearby[x]) continue;
      if (auto spot = spot_at(gray, level, {x, y}, reduction)) spots.push_back(*spot);
    }
  }
}

std::optional<Detection> SpotFinder::spot_at(const cv::Mat& gray, const cv::Mat& level,
                                             const cv::Point& at, int reduction) const {
  const int sum = small_sum_.at<std::uint16_t>(at);
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

bool SpotFinder::exceeds_surroundings(const cv::Point& at) const {
  const double usual = usual_.at<std::uint16_t>(at.y * usual_.rows / residual_.rows,
                                                at.x * usual_.cols / residual_.cols);
  const double noise = std::max(kFloor * kUnits, 1.4826 * usual);
  return residual_.at<std::uint16_t>(at) > config_.threshold_sd * noise;
}

std::vector<Detection> SpotFinder::find(const cv::Mat& gray) {
  constexpr int kLeastSide = 3 * kReach;
  std::vector<Detection> spots;
  cv::Mat level = gray;
  for (int i = 0; i < config_.levels && std::min(level.cols, level.rows) >= kLeastSide; ++i) {
    find_in(gray, level, 1 << i, spots);
    cv::Mat reduced;
    cv::pyrDown(level, reduced);
    level = reduced;
  }
  return distinct(std::move(spots), config_.most);
}

}  // namespace ols::detector
