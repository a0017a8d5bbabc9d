#include "edge/detector/dim_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "edge/tracker/particle.h"

namespace ols::detector {
namespace {

using Stack = VelocityStack;
constexpr std::size_t kStacked = Stack::kImages;
constexpr double kToMiddle = 0.5 * (Stack::kImages - 1);  // [images] of a stack, from the newest
constexpr double kStep_px = 0.5;                          // velocity step of the stack, per image

// Nine tenths of a tile's extremes are below this in white noise, in standard deviations of the
// stack.
constexpr double kUsualExtreme = 3.34;
// The same in values, which are scaled by the noise of single images. A tile with more is no white
// noise: it is correlated along some velocity.
constexpr double kWhiteExtreme = 38.4;
constexpr double kMostExtreme = 1.2 * kWhiteExtreme;

// Of the deviations of the highest and the lowest values, interpolated between whole values.
double nine_tenths(const Stack& stack) {
  std::array<int, 256> histogram{};
  for (const std::uint8_t value : stack.highest()) ++histogram[std::max(0, value - Stack::kZero)];
  for (const std::uint8_t value : stack.lowest()) ++histogram[std::max(0, Stack::kZero - value)];
  const double wanted = 0.9 * 2.0 * static_cast<double>(stack.highest().size());
  double seen = 0.0;
  for (std::size_t value = 0; value < histogram.size(); ++value) {
    seen += histogram[value];
    if (seen > wanted) return static_cast<double>(value) + 1.0 - (seen - wanted) / histogram[value];
  }
  return 255.0;
}

// Number of tiles in a row and in a column of the image.
cv::Size tiles_of(const cv::Size& bins) {
  return {(bins.width + Stack::kWidth - 1) / Stack::kWidth,
          (bins.height + Stack::kHeight - 1) / Stack::kHeight};
}

// The corner of a tile; `tile` counts row by row. Tiles overlap if the image is no multiple of
// them.
cv::Point corner_of(std::size_t tile, const cv::Size& bins) {
  const cv::Size tiles = tiles_of(bins);
  const auto column = static_cast<int>(tile) % tiles.width,
             row = static_cast<int>(tile) / tiles.width;
  return {tiles.width == 1 ? 0 : column * (bins.width - Stack::kWidth) / (tiles.width - 1),
          tiles.height == 1 ? 0 : row * (bins.height - Stack::kHeight) / (tiles.height - 1)};
}

// The centroid of the highest part of a function of the place, within three pixels of zero.
std::optional<Eigen::Vector2d> offset_of_peak(
    const std::function<double(const Eigen::Vector2d&)>& height_at) {
  constexpr int kReach = 4, kPart = 2;  // steps: searched, and of the peak
  static constexpr double kSearchStep_px = 0.75;
  constexpr double kFoot = 0.6;  // of the peak's height
  cv::Mat_<double> heights(2 * kReach + 1, 2 * kReach + 1);
  const auto offset = [](int x, int y) -> Eigen::Vector2d {
    return kSearchStep_px * Eigen::Vector2d(x - kReach, y - kReach);
  };
  for (int y = 0; y < heights.rows; ++y) {
    for (int x = 0; x < heights.cols; ++x) heights(y, x) = height_at(offset(x, y));
  }
  double highest = 0.0;
  cv::Point peak;
  cv::minMaxLoc(heights, nullptr, &highest, nullptr, &peak);
  if (highest <= 0.0) return std::nullopt;
  double weights = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int y = std::max(0, peak.y - kPart); y <= std::min(2 * kReach, peak.y + kPart); ++y) {
    for (int x = std::max(0, peak.x - kPart); x <= std::min(2 * kReach, peak.x + kPart); ++x) {
      const double weight = std::max(0.0, heights(y, x) - kFoot * highest);
      weights += weight;
      sum += weight * offset(x, y);
    }
  }
  return sum / weights;
}

}  // namespace

void DimFinder::clear() {
  past_.clear();
  times_s_.clear();
  followed_.clear();
  uneven_ = 0;
}

bool DimFinder::is_inside(const Eigen::Vector2d& pixel) const {
  constexpr double kMargin_px = 8.0;  // of the filters
  const cv::Mat& residual = past_.residual(0);
  return pixel.minCoeff() > kMargin_px && pixel.x() < 2.0 * residual.cols - kMargin_px &&
         pixel.y() < 2.0 * residual.rows - kMargin_px;
}

bool DimFinder::is_followed(const Eigen::Vector2d& pixel) const {
  constexpr double kNear_px = 8.0;
  return std::ranges::any_of(
      followed_, [&](const Point& point) { return (point.pixel - pixel).norm() < kNear_px; });
}

void DimFinder::remember(const cv::Mat& gray, double time_s,
                         const std::optional<Eigen::Matrix3d>& motion) {
  constexpr double kPause_s = 1.0;  // what is there after it may be anything else
  if (!times_s_.empty() && time_s - times_s_.back() > kPause_s) clear();
  const Eigen::Matrix3d known = motion.value_or(Eigen::Matrix3d::Identity());
  past_.add(residual_.measure(gray), known);
  times_s_.push_back(time_s);
  if (times_s_.size() > ResidualPast::kImages) times_s_.erase(times_s_.begin());
  for (Point& point : followed_) {
    point.pixel = tracker::transform(known, point.pixel) + point.velocity_px;
    ++point.unmeasured;
  }
}

Detection DimFinder::detection(const Point& point) const {
  constexpr double kSize_px = 4.0;  // what is summed; a stack does not show a size
  const double interval_s =
      (times_s_.back() - times_s_.front()) / static_cast<double>(times_s_.size() - 1);
  Detection found;
  found.pixel = point.pixel;
  found.size_px.setConstant(kSize_px);
  found.signal_to_noise = point.signal_to_noise / std::sqrt(static_cast<double>(kStacked));
  found.brighter = point.brighter;
  found.evidence = Evidence::kStack;
  found.path = Path{point.id, point.velocity_px / interval_s};
  return found;
}

// Looks for a followed point in the newest images, near where it should be in the middle of them.
bool DimFinder::measure(Point& point) const {
  constexpr double kGain = 0.8 / kStacked;  // of the velocity, by the deviation
  const LineSum line(past_, point.pixel);
  const double sign = point.brighter ? 1.0 : -1.0;
  const auto off = offset_of_peak([&](const Eigen::Vector2d& place) {
    return sign * line.along(point.pixel + place, point.velocity_px, kStacked);
  });
  if (!off) return false;
  const double sum =
      sign * line.along_without_texture(point.pixel + *off, point.velocity_px, kStacked);
  if (!(sum >= config_.next_sd)) return false;
  point.signal_to_noise = sum;
  // `off` is the deviation in the middle of the images; the velocity's part grows until the newest.
  point.velocity_px += kGain * *off;
  point.pixel += *off + kToMiddle * kGain * *off;
  return point.velocity_px.norm() >= config_.least_px;
}

void DimFinder::follow(std::vector<Detection>& found) {
  constexpr int kMostMisses = 2;
  for (Point& point : followed_) {
    if (point.unmeasured < Stack::kImages) continue;
    point.unmeasured = 0;
    if (is_inside(point.pixel) && measure(point)) {
      point.misses = 0;
      found.push_back(detection(point));
    } else {
      ++point.misses;
    }
  }
  std::erase_if(followed_, [](const Point& point) { return point.misses >= kMostMisses; });
}

DimFinder::Point DimFinder::point_at(const cv::Point& peak, const cv::Point& corner, bool brighter,
                                     double unit) const {
  const int sign = brighter ? 1 : -1;
  const auto height = [&](const cv::Point& steps) {
    return sign * (stack_.mean(peak, steps) - Stack::kZero);
  };
  int highest = 0;
  for (int y = -Stack::kSteps; y <= Stack::kSteps; ++y) {
    for (int x = -Stack::kSteps; x <= Stack::kSteps; ++x)
      highest = std::max(highest, height({x, y}));
  }
  double weights = 0.0;
  Eigen::Vector2d steps = Eigen::Vector2d::Zero();
  for (int y = -Stack::kSteps; y <= Stack::kSteps; ++y) {
    for (int x = -Stack::kSteps; x <= Stack::kSteps; ++x) {
      const double weight = std::max(0.0, height({x, y}) - (highest - unit));
      weights += weight;
      steps += weight * Eigen::Vector2d(x, y);
    }
  }
  const Eigen::Vector2d bin(corner.x + peak.x, corner.y + peak.y);
  return {2.0 * bin.array() + 0.5, kStep_px * steps / weights, highest / unit, brighter};
}

// The highest peaks of the tile, of each polarity.
void DimFinder::take_peaks(const cv::Point& corner) {
  constexpr int kMost = 3, kApart = 6;  // kApart: [bins], the half side of one peak
  const double usual = nine_tenths(stack_);
  if (usual > kMostExtreme) return;
  const double unit = usual / kUsualExtreme;
  for (const bool brighter : {true, false}) {
    cv::Mat heights(Stack::kHeight, Stack::kWidth, CV_8U);
    for (std::size_t i = 0; i < stack_.highest().size(); ++i) {
      heights.data[i] = cv::saturate_cast<std::uint8_t>(
          brighter ? stack_.highest()[i] - Stack::kZero : Stack::kZero - stack_.lowest()[i]);
    }
    for (int count = 0; count < kMost; ++count) {
      double height = 0.0;
      cv::Point peak;
      cv::minMaxLoc(heights, nullptr, &height, nullptr, &peak);
      if (height < config_.peak_sd * unit) break;
      peaks_.push_back(point_at(peak, corner, brighter, unit));
      const cv::Rect around(peak.x - kApart, peak.y - kApart, 2 * kApart + 1, 2 * kApart + 1);
      heights(around & cv::Rect({}, heights.size())).setTo(0);
    }
  }
}

void DimFinder::stack_next_tile() {
  const cv::Size bins = past_.residual(0).size();
  const std::size_t tile = next_tile_++ % static_cast<std::size_t>(tiles_of(bins).area());
  const cv::Point corner = corner_of(tile, bins);
  ++uneven_;
  if (!tile_.prepare(past_, corner, stack_)) return;
  uneven_ = 0;
  stack_.run();
  take_peaks(corner);
}

// The best straight path through sixteen images, near that of a peak: the stack's rounding and its
// eight images leave the velocity open by half a pixel per image.
bool DimFinder::confirm(Point& point) const {
  const LineSum line(past_, point.pixel);
  const double sign = point.brighter ? 1.0 : -1.0;
  const Eigen::Vector2d middle = point.pixel - kToMiddle * point.velocity_px;
  Eigen::Vector2d best_middle = middle, best_velocity = point.velocity_px;
  double highest = -1.0;
  const auto search = [&](double place_px, double velocity_px, int reach) {
    const Eigen::Vector2d from = best_middle, velocity = best_velocity;
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const Eigen::Vector2d step(x, y);
        const Eigen::Vector2d place = from + place_px * step, v = velocity + velocity_px * step;
        const double sum = sign * line.along(place + kToMiddle * v, v, ResidualPast::kImages);
        if (sum <= highest) continue;
        highest = sum;
        best_middle = place;
        best_velocity = v;
      }
    }
  };
  search(0.0, 0.25, 2);
  search(0.0, 0.125, 1);
  search(0.5, 0.0, 2);
  if (highest < config_.line_sd || best_velocity.norm() < config_.least_px) return false;
  point.velocity_px = best_velocity;
  point.pixel = best_middle + kToMiddle * best_velocity;
  point.signal_to_noise = sign * line.along_without_scene(point.pixel, point.velocity_px, kStacked);
  const double sum =
      sign * line.along_without_texture(point.pixel, point.velocity_px, ResidualPast::kImages);
  return sum >= config_.line_sd && is_inside(point.pixel) && is_alone(line, point, sum);
}

// Whether parallel paths around it show little. An edge, of a cloud for instance, looks like a
// point that moves along it.
bool DimFinder::is_alone(const LineSum& line, const Point& point, double sum) {
  constexpr int kDirections = 12;
  constexpr double kAround_px = 7.0, kMost = 0.5;
  for (int i = 0; i < kDirections; ++i) {
    const double direction = 2.0 * std::numbers::pi * i / kDirections;
    const Eigen::Vector2d off(std::cos(direction), std::sin(direction));
    const double other =
        line.along(point.pixel + kAround_px * off, point.velocity_px, ResidualPast::kImages);
    if (std::abs(other) > kMost * sum) return false;
  }
  return true;
}

void DimFinder::search(std::vector<Detection>& found) {
  peaks_.clear();
  // Earlier than after eight images, a tile would show the same noise again.
  const cv::Size tiles = tiles_of(past_.residual(0).size());
  const std::size_t count = (static_cast<std::size_t>(tiles.area()) + kStacked - 1) / kStacked;
  for (std::size_t i = 0; i < std::min(count, config_.tiles); ++i) stack_next_tile();
  for (Point& peak : peaks_) {
    if (followed_.size() >= config_.most) return;
    if (is_followed(peak.pixel) || !confirm(peak) || is_followed(peak.pixel)) continue;
    peak.id = next_id_++;
    followed_.push_back(peak);
    found.push_back(detection(peak));
  }
}

std::vector<Detection> DimFinder::find(const cv::Mat& gray, double time_s,
                                       const std::optional<Eigen::Matrix3d>& motion) {
  std::vector<Detection> found;
  if (rest_ > 0) {
    --rest_;
    return found;
  }
  remember(gray, time_s, motion);
  const cv::Size bins = past_.residual(0).size();
  if (!past_.complete() || bins.width < Stack::kWidth || bins.height < Stack::kHeight) return found;
  follow(found);
  search(found);
  if (followed_.empty() && uneven_ >= static_cast<std::size_t>(tiles_of(bins).area())) {
    constexpr int kRest = 60;
    clear();
    rest_ = kRest;
  }
  return found;
}

}  // namespace ols::detector
