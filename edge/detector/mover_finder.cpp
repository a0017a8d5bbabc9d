#include "edge/detector/mover_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace ols::detector {
namespace {

constexpr int kTile = 32;  // [px of the reduced image]

// The usual difference of a tile: the root mean square of its lower nine tenths. A target that
// fills less than a tenth does not raise it.
float usual_difference(const cv::Mat& tile) {
  std::array<int, 256> histogram{};
  for (int y = 0; y < tile.rows; ++y) {
    const auto* row = tile.ptr<std::uint8_t>(y);
    for (int x = 0; x < tile.cols; ++x) ++histogram[row[x]];
  }
  const double wanted = 0.9 * static_cast<double>(tile.total());
  double count = 0.0, squares = 0.0;
  for (std::size_t value = 0; value < histogram.size() && count < wanted; ++value) {
    count += histogram[value];
    squares += histogram[value] * static_cast<double>(value * value);
  }
  return static_cast<float>(std::max(1.0, std::sqrt(squares / std::max(1.0, count))));
}

// The noise of each tile. A tile takes the median of itself and its neighbours, so that a mover
// that fills it does not hide itself.
cv::Mat tile_noise(const cv::Mat& difference) {
  const int columns = std::max(1, difference.cols / kTile);
  const int rows = std::max(1, difference.rows / kTile);
  cv::Mat noise(rows, columns, CV_32F);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const cv::Point from(i * difference.cols / columns, j * difference.rows / rows);
      const cv::Point to((i + 1) * difference.cols / columns, (j + 1) * difference.rows / rows);
      noise.at<float>(j, i) = usual_difference(difference(cv::Rect(from, to)));
    }
  }
  cv::Mat smooth;
  cv::medianBlur(noise, smooth, 3);
  return smooth;
}

// [grey levels] By how much the image is brighter or darker than the range.
cv::Mat outside(const cv::Mat& image, const SceneBackground::Range& range) {
  cv::Mat brighter, darker, difference;
  cv::subtract(image, range.high, brighter);  // saturates at zero
  cv::subtract(range.low, image, darker);
  cv::max(brighter, darker, difference);
  return difference;
}

}  // namespace

// Whether half of the tiles usually differ by more than a mover has to.
bool MoverFinder::everything_changed(const cv::Mat& noise) const {
  std::vector<float> tiles(noise.begin<float>(), noise.end<float>());
  const auto middle = tiles.begin() + static_cast<std::ptrdiff_t>(tiles.size() / 2);
  std::nth_element(tiles.begin(), middle, tiles.end());
  return *middle > config_.least_levels;
}

cv::Mat MoverFinder::exceedances(const cv::Mat& difference, const cv::Mat& noise) const {
  cv::Mat threshold;
  cv::resize(noise, threshold, difference.size(), 0, 0, cv::INTER_LINEAR);
  cv::Mat levels, mask;
  threshold.convertTo(levels, CV_8U, config_.threshold_sd);
  cv::max(levels, config_.least_levels, levels);
  cv::compare(difference, levels, mask, cv::CMP_GT);
  return mask;
}

// If a mover was in one place in most of the earlier images, the median shows it and the present
// image does not: a ghost. `fresh` marks where the present image differs from each earlier one; a
// ghost has no such pixels.
std::vector<Detection> MoverFinder::parts(const cv::Mat& mask, const cv::Mat& fresh,
                                          const cv::Mat& difference,
                                          const tracker::ReducedFrame& frame) const {
  // Legs, trunk and head of a walker are one.
  cv::Mat joined, labels, statistics, centroids;
  cv::morphologyEx(mask, joined, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 11}));
  const int count = cv::connectedComponentsWithStats(joined, labels, statistics, centroids);
  std::vector<Detection> found;
  for (int part = 1; part < count; ++part) {
    const cv::Rect box(
        statistics.at<int>(part, cv::CC_STAT_LEFT), statistics.at<int>(part, cv::CC_STAT_TOP),
        statistics.at<int>(part, cv::CC_STAT_WIDTH), statistics.at<int>(part, cv::CC_STAT_HEIGHT));
    if (statistics.at<int>(part, cv::CC_STAT_AREA) < config_.least_area_px) continue;
    if (cv::countNonZero(fresh(box) & (labels(box) == part)) < config_.least_area_px) continue;
    if (box.width > config_.most_side_fraction * mask.cols) continue;
    if (box.height > config_.most_side_fraction * mask.rows) continue;
    double greatest = 0.0;
    cv::minMaxLoc(difference(box), nullptr, &greatest);
    const Eigen::Vector2d centre(box.x + (box.width - 1) / 2.0, box.y + (box.height - 1) / 2.0);
    found.push_back({(centre.array() + 0.5) * frame.reduction - 0.5,
                     Eigen::Vector2d(box.width, box.height) * frame.reduction,
                     greatest / config_.least_levels * config_.threshold_sd, false,
                     Evidence::kMover, false});
  }
  std::stable_sort(found.begin(), found.end(), [](const Detection& a, const Detection& b) {
    return a.size_px.prod() > b.size_px.prod();
  });
  found.resize(std::min(found.size(), config_.most));
  return found;
}

std::optional<std::vector<Detection>> MoverFinder::find(
    const tracker::ReducedFrame& frame, double time_s,
    const std::optional<Eigen::Matrix3d>& motion) {
  if (motion) {
    background_.advance(*motion);
  } else {
    background_.clear();
  }
  std::vector<Detection> found;
  if (background_.ready(time_s)) {
    const SceneBackground::Scene scene = background_.scene(time_s);
    const cv::Mat difference = outside(frame.image, scene.usual) & scene.seen;
    const cv::Mat noise = tile_noise(difference);
    if (everything_changed(noise)) {
      background_.clear();
      background_.remember(frame.image, time_s);
      return std::nullopt;
    }
    const cv::Mat fresh = exceedances(outside(frame.image, scene.ever) & scene.seen, noise);
    found = parts(exceedances(difference, noise), fresh, difference, frame);
  }
  background_.remember(frame.image, time_s);
  return found;
}

}  // namespace ols::detector
