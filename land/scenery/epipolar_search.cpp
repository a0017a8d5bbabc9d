#include "land/scenery/epipolar_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "land/scenery/sample.h"

namespace ols::scenery {
namespace {

constexpr int kSide = 2 * kPatchHalf + 1;
// Of the patch in the other panorama. A wall that one station sees at 30 degrees and the other at
// 60 differs by 1.7.
constexpr std::array kWidths{0.6, 0.77, 1.0, 1.3, 1.67};
constexpr float kLeastPeak = 0.5F;
constexpr double kOtherPlace_px = 5.0;

// A place on the line, in pixels of the level.
struct Node {
  double nearness = 0.0;  // 1 / range
  double x = 0.0, y = 0.0;
  double height = 1.0;  // of the patch there

  Node towards(const Node& other, double share) const {
    return {nearness + share * (other.nearness - nearness), x + share * (other.x - x),
            y + share * (other.y - y), height + share * (other.height - height)};
  }
};

// Between its nodes the line is straight. Nodes have ascending columns.
class Line {
 public:
  Line(const ScenePanorama& panorama, const ScenePanorama& other, const Eigen::Vector2d& px,
       const SearchLine& search, int level) {
    constexpr double kNodes_px = 48.0;
    const double farthest = 1.0 / search.ranges.far_m, nearest = 1.0 / search.ranges.near_m;
    const auto node = [&](double nearness) {
      const ScenePixel there = pixel_of(other, point_ecef(panorama, px, 1.0 / nearness));
      const double y = there.px.y() + search.lower_px(there.px.x());
      return Node{nearness, to_level(there.px.x(), level), to_level(y, level),
                  1.0 / (nearness * there.range_m)};
    };
    const double long_px = std::abs(node(nearest).x - node(farthest).x) * (1 << level);
    const int count = std::clamp(static_cast<int>(long_px / kNodes_px) + 2, 3, 400);
    for (int i = 0; i <= count; ++i) {
      nodes_.push_back(node(farthest + (nearest - farthest) * i / count));
    }
    if (nodes_.front().x > nodes_.back().x) std::ranges::reverse(nodes_);
  }

  double first_x() const { return nodes_.front().x; }
  double last_x() const { return nodes_.back().x; }
  Node at(double x) const {
    const std::size_t i = before(x);
    return nodes_[i].towards(nodes_[i + 1], (x - nodes_[i].x) / (nodes_[i + 1].x - nodes_[i].x));
  }
  double slope(double x) const {
    const std::size_t i = before(x);
    return (nodes_[i + 1].y - nodes_[i].y) / (nodes_[i + 1].x - nodes_[i].x);
  }

 private:
  std::size_t before(double x) const {
    const auto next = std::ranges::lower_bound(nodes_, x, {}, &Node::x);
    const auto i = next == nodes_.begin() ? 0 : next - nodes_.begin() - 1;
    return std::min(static_cast<std::size_t>(i), nodes_.size() - 2);
  }

  std::vector<Node> nodes_;
};

std::optional<cv::Mat1f> patch_at(const cv::Mat1f& image, const Eigen::Vector2d& px, double slope) {
  cv::Mat1f patch(kSide, kSide);
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double right = i - kPatchHalf;
      patch(j, i) = sample(image, px.x() + right, px.y() + j - kPatchHalf + slope * right);
      if (std::isnan(patch(j, i))) return std::nullopt;
    }
  }
  return patch;
}

// The other panorama along the line, so wide that the patch fits unchanged.
cv::Mat1f strip_of(const cv::Mat1f& image, const Line& line, double first_x, double last_x,
                   double width, int beside_px) {
  cv::Mat1f strip(kSide + 2 * beside_px, static_cast<int>((last_x - first_x) / width) + kSide);
  for (int i = 0; i < strip.cols; ++i) {
    const double x = first_x + (i - kPatchHalf) * width;
    const Node node = line.at(x);
    for (int j = 0; j < strip.rows; ++j) {
      const float value = sample(image, x, node.y + (j - kPatchHalf - beside_px) * node.height);
      strip(j, i) = std::isnan(value) ? 0.0F : value;
    }
  }
  return strip;
}

struct Peak {
  float score = 0.0F;
  int row = 0;  // from the line
  double x = 0.0, width = 1.0;
};

void add_peaks(const cv::Mat1f& scores, double first_x, double width, int beside_px,
               std::vector<Peak>& peaks) {
  cv::Mat1f best;
  cv::reduce(scores, best, 0, cv::REDUCE_MAX);
  for (int i = 0; i < best.cols; ++i) {
    const float score = best(0, i);
    if (!(score > kLeastPeak) || score > 1.01F) continue;  // a flat strip has no correlation
    if (i > 0 && best(0, i - 1) > score) continue;
    if (i + 1 < best.cols && best(0, i + 1) >= score) continue;
    int row = 0;
    while (scores(row, i) != score) ++row;
    peaks.push_back({score, row - beside_px, first_x + i * width, width});
  }
}

}  // namespace

double to_level(double px, int level) { return (px + 0.5) / (1 << level) - 0.5; }
double from_level(double px, int level) { return (px + 0.5) * (1 << level) - 0.5; }
Eigen::Vector2d to_level(const Eigen::Vector2d& px, int level) {
  return {to_level(px.x(), level), to_level(px.y(), level)};
}
Eigen::Vector2d from_level(const Eigen::Vector2d& px, int level) {
  return {from_level(px.x(), level), from_level(px.y(), level)};
}

ScenePyramid pyramid_of(const ScenePanorama& panorama, int levels) {
  ScenePyramid pyramid{&panorama, {}};
  cv::Mat1f image;
  panorama.gray.convertTo(image, CV_32F);
  for (int level = 0; level < levels; ++level) {
    pyramid.levels.push_back(image);
    // An odd last row or column is left out: the others keep their scale.
    const cv::Mat1f even = image(cv::Rect(0, 0, image.cols & ~1, image.rows & ~1));
    cv::Mat1f half;
    cv::resize(even, half, even.size() / 2, 0.0, 0.0, cv::INTER_AREA);
    image = half;
  }
  return pyramid;
}

double epipolar_slope(const ScenePanorama& panorama, const ScenePanorama& other,
                      const Eigen::Vector2d& px, double range_m) {
  // Towards the other station it stays in the epipolar plane.
  constexpr double kStep = 1e-3;
  const Eigen::Vector3d p_ecef = point_ecef(panorama, px, range_m);
  const Eigen::Vector3d step = kStep * range_m * (other.centre_ecef - p_ecef).normalized();
  const Eigen::Vector2d moved_px =
      pixel_of(panorama, p_ecef + step).px - pixel_of(panorama, p_ecef).px;
  return std::abs(moved_px.x()) > 1e-6 ? moved_px.y() / moved_px.x() : 0.0;
}

std::optional<PatchPlace> find_patch(const ScenePyramid& pyramid, const ScenePyramid& other,
                                     int level, const Eigen::Vector2d& px,
                                     const SearchLine& search) {
  const auto at = static_cast<std::size_t>(level);
  const cv::Mat1f& image = other.levels[at];
  const Line line(*pyramid.panorama, *other.panorama, px, search, level);
  constexpr double kMargin_px = kWidths.back() * kPatchHalf + 1.0, kBeyond_px = 3.0;
  const double first_x = std::max(line.first_x() - kBeyond_px, kMargin_px);
  const double last_x = std::min(line.last_x() + kBeyond_px, image.cols - 1 - kMargin_px);
  if (last_x - first_x < 2.0) return std::nullopt;
  const double middle_m = 2.0 / (1.0 / search.ranges.near_m + 1.0 / search.ranges.far_m);
  const auto patch = patch_at(pyramid.levels[at], to_level(px, level),
                              epipolar_slope(*pyramid.panorama, *other.panorama, px, middle_m));
  if (!patch) return std::nullopt;
  std::vector<Peak> peaks;
  for (const double width : kWidths) {
    cv::Mat1f scores;
    cv::matchTemplate(strip_of(image, line, first_x, last_x, width, search.beside_px), *patch,
                      scores, cv::TM_CCOEFF_NORMED);
    add_peaks(scores, first_x, width, search.beside_px, peaks);
  }
  if (peaks.empty()) return std::nullopt;
  const Peak best = *std::ranges::max_element(peaks, {}, &Peak::score);
  PatchPlace place{.score = best.score};
  for (const Peak& peak : peaks) {
    if (std::abs(peak.x - best.x) <= kOtherPlace_px) continue;
    place.second = std::max(place.second, static_cast<double>(peak.score));
  }
  const Node node = line.at(best.x);
  place.px = from_level(Eigen::Vector2d(best.x, node.y + best.row * node.height), level);
  place.range_m = 1.0 / node.nearness;
  place.shape << best.width, 0.0, best.width * line.slope(best.x), node.height;
  return place;
}

double likest_beside(const ScenePyramid& pyramid, int level, const Eigen::Vector2d& px,
                     double slope, double reach_px) {
  const cv::Mat1f& image = pyramid.levels[static_cast<std::size_t>(level)];
  const Eigen::Vector2d middle = to_level(px, level);
  const auto patch = patch_at(image, middle, slope);
  if (!patch) return 0.0;
  const int reach = static_cast<int>(reach_px);
  cv::Mat1f strip(kSide + 2, 2 * reach + kSide);  // a row above and one below the line
  for (int i = 0; i < strip.cols; ++i) {
    const double right = i - reach - kPatchHalf;
    for (int j = 0; j < strip.rows; ++j) {
      const float value =
          sample(image, middle.x() + right, middle.y() + slope * right + j - kPatchHalf - 1);
      strip(j, i) = std::isnan(value) ? 0.0F : value;
    }
  }
  cv::Mat1f scores;
  cv::matchTemplate(strip, *patch, scores, cv::TM_CCOEFF_NORMED);
  double likest = 0.0;
  for (int i = 0; i < scores.cols; ++i) {
    if (std::abs(i - reach) <= kOtherPlace_px) continue;
    for (int j = 0; j < scores.rows; ++j) {
      if (scores(j, i) <= 1.01F) likest = std::max(likest, static_cast<double>(scores(j, i)));
    }
  }
  return likest;
}

}  // namespace ols::scenery
