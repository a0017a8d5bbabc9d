#include "land/scenery/scenery_ranges.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "land/scenery/epipolar_search.h"
#include "land/scenery/patch_fit.h"

namespace ols::scenery {
namespace {

constexpr int kLevels = 3;
// The finest level is searched only around places that coarser ones have found.
constexpr int kFinestSearched = 1;
constexpr double kLeastScore = 0.7, kLeastFitted = 0.75, kLeastGrown = 0.8;
// The best place lacks at most this share of what the next one lacks of a full correlation.
constexpr double kUnique = 0.85;
constexpr double kBack_px = 3.0;  // of the level
// 1-sigma over that of the fit, across and along the epipolar line. Along it, the depth of trees
// shifts what the patch shows; across it nothing does.
constexpr double kAcrossSd = 1.5, kLeastAcross_px = 0.12, kAlongSd = 5.0, kLeastAlong_px = 0.05;
constexpr double kAcrossSigmas = 2.5, kGrownAcrossSigmas = 3.0;
// Of what counts in the end.
constexpr double kSureFitted = 0.93, kSureSupport = 0.2;
constexpr double kConflictSigmas = 4.0;
// A place does not count if its own panorama has the like of it (a correlation above kRepeated)
// within kRepeat_m beside it: windows of a house.
constexpr double kRepeated = 0.85, kRepeat_m = 10.0;
constexpr int kLeastAlike = 2;                            // others nearby at the same range
constexpr double kDepth_m = 3.0;                          // of a tree or a house
constexpr double kNearest_px = 8.0, kFarthest_px = 60.0;  // of what is beside a place, in its level

struct Place {
  int level = 0;
  Eigen::Vector2d px, other_px, sd_px;   // centre of the patch; sd_px: by the fit
  Eigen::Vector2d own_px, own_other_px;  // the place in the patch to which the range belongs
  double range_m = 0.0, m_per_px = 0.0;
  double fitted = 0.0;     // correlation
  double across_px = 0.0;  // how much lower than its epipolar line
  double across_sigmas = 0.0;
  double support = 0.0;  // share of the corners around it that are found at its range
};

// What is above or below counts as farther: on a slope it has another range.
double distance_px(const Eigen::Vector2d& one, const Eigen::Vector2d& two) {
  return std::hypot(one.x() - two.x(), 2.0 * (one.y() - two.y()));
}
// Near, but the patches share less than half of their pixels.
bool is_beside(double distance_px) {
  return distance_px > kNearest_px && distance_px < kFarthest_px;
}

bool is_unique(const PatchPlace& place) {
  return 1.0 - place.score <= kUnique * (1.0 - place.second);
}

// Whether the patch about `at` reaches to where no picture shows anything.
bool reaches_unseen(const cv::Mat1f& image, const cv::Point& at) {
  constexpr int kReach_px = kPatchHalf + 2;
  double least = 0.0;
  const cv::Rect around(at.x - kReach_px, at.y - kReach_px, 2 * kReach_px + 1, 2 * kReach_px + 1);
  cv::minMaxLoc(image(around), &least);
  return least <= kUnseen;
}

// Corners: where the brightness changes in every direction. The strongest one of each cell.
std::vector<Eigen::Vector2d> corners_of(const cv::Mat1f& image, int cell_px, float least) {
  constexpr int kMargin_px = kPatchHalf + 3;
  cv::Mat1f smooth, strength;
  cv::GaussianBlur(image, smooth, {}, 0.8);
  cv::cornerMinEigenVal(smooth, strength, 9, 3);
  std::vector<Eigen::Vector2d> corners;
  for (int top = kMargin_px; top + cell_px < image.rows - kMargin_px; top += cell_px) {
    for (int left = kMargin_px; left + cell_px < image.cols - kMargin_px; left += cell_px) {
      const cv::Mat1f cell = strength(cv::Rect(left, top, cell_px, cell_px));
      double strongest = 0.0;
      cv::Point at;
      cv::minMaxLoc(cell, nullptr, &strongest, nullptr, &at);
      if (strongest < least || reaches_unseen(image, {left + at.x, top + at.y})) continue;
      double around = 0.0;
      cv::minMaxLoc(strength(cv::Rect(left + at.x - 2, top + at.y - 2, 5, 5)), nullptr, &around);
      if (around == strongest) corners.emplace_back(left + at.x, top + at.y);
    }
  }
  return corners;
}

// By how much the second panorama shows everything lower than the poses say [px]: a smooth function
// of the column, from the tilts, and of the inverse of the range, from the positions.
class Lowering {
 public:
  Lowering(const ScenePanorama& panorama, const ScenePanorama& other)
      : half_px_(0.5 * other.gray.cols) {
    const double tilt_px =
        std::hypot(panorama.sd.tilt_rad, other.sd.tilt_rad) / panorama.rad_per_px + 1e-3;
    const double place_px =
        std::hypot(panorama.sd.position_m, other.sd.position_m) / kUnit_m / panorama.rad_per_px +
        1e-3;
    sd_px_ << tilt_px, 0.5 * tilt_px, 0.1 * tilt_px, place_px;
  }

  double tilt_sd_px() const { return sd_px_(0); }
  double px(double x_px, double range_m) const { return terms(x_px, range_m).dot(share_px_); }

  void fit(const std::vector<Place>& places) {
    constexpr int kIterations = 40, kSharpFrom = 10;
    constexpr double kLeastFittedHere = 0.85;
    share_px_.setZero();
    for (int i = 0; i < kIterations; ++i) {
      Eigen::Matrix4d normal = sd_px_.cwiseAbs2().cwiseInverse().asDiagonal();
      Eigen::Vector4d right = Eigen::Vector4d::Zero();
      for (const Place& place : places) {
        if (place.fitted < kLeastFittedHere) continue;
        const Eigen::Vector4d by = terms(place.other_px.x(), place.range_m);
        const double sd = std::hypot(2.0 * place.sd_px.y(), 0.1 * (1 << place.level));
        const double off = (place.across_px - by.dot(share_px_)) / sd;
        // Half of the places may be wrong: these lose all weight as soon as it is clear which.
        const double weight = std::pow(1.0 + 0.25 * off * off, i < kSharpFrom ? -1 : -2);
        normal += weight / (sd * sd) * by * by.transpose();
        right += weight / (sd * sd) * place.across_px * by;
      }
      share_px_ = normal.ldlt().solve(right);
    }
  }

 private:
  static constexpr double kUnit_m = 1000.0;

  Eigen::Vector4d terms(double x_px, double range_m) const {
    const double u = (x_px - half_px_) / half_px_;
    return {1.0, u, u * u, kUnit_m / range_m};
  }

  double half_px_;
  Eigen::Vector4d sd_px_, share_px_ = Eigen::Vector4d::Zero();
};

class Matcher {
 public:
  Matcher(const ScenePanorama& panorama, const ScenePanorama& other, const PossibleRanges& possible,
          const PossibleRanges& possible_other)
      : panorama_(panorama),
        other_(other),
        possible_(possible),
        possible_other_(possible_other),
        pyramid_(pyramid_of(panorama, kLevels)),
        other_pyramid_(pyramid_of(other, kLevels)),
        lowering_(panorama, other) {}

  std::vector<Place> places() {
    std::vector<Place> found;
    for (int level = kLevels - 1; level >= kFinestSearched; --level) search_level(level, found);
    std::erase_if(found, [&](const Place& place) { return !is_across(place, kAcrossSigmas); });
    for (Place& place : found) place.across_sigmas = across_sigmas(place);
    std::vector<Place> sure = grown(found);
    for (const Place& place : found) {
      if (place.support >= kSureSupport) sure.push_back(place);
    }
    std::erase_if(sure, [&](const Place& place) {
      return place.fitted < kSureFitted || !is_across(place, kAcrossSigmas) || is_repeated(place);
    });
    return sure;
  }

 private:
  double across_sigmas(const Place& place) const {
    const double off_px = place.across_px - lowering_.px(place.other_px.x(), place.range_m);
    return off_px / std::hypot(kAcrossSd * place.sd_px.y(), kLeastAcross_px * (1 << place.level));
  }
  bool is_across(const Place& place, double sigmas) const {
    return std::abs(across_sigmas(place)) <= sigmas;
  }

  bool is_repeated(const Place& place) const {
    const double m_per_px = place.range_m * panorama_.rad_per_px * (1 << place.level);
    const double slope = epipolar_slope(panorama_, other_, place.px, place.range_m);
    return likest_beside(pyramid_, place.level, place.px, slope, kRepeat_m / m_per_px) > kRepeated;
  }

  void search_level(int level, std::vector<Place>& found) {
    constexpr int kCell_px = 14, kBeside_px = 2;
    constexpr float kStrong = 16.0F;
    const bool is_first = found.empty();
    const double tilt_px = is_first ? 3.0 * lowering_.tilt_sd_px() / (1 << level) : 0.0;
    const int beside_px = kBeside_px + static_cast<int>(std::ceil(tilt_px));
    for (const Eigen::Vector2d& corner :
         corners_of(pyramid_.levels[static_cast<std::size_t>(level)], kCell_px, kStrong)) {
      const Eigen::Vector2d px = from_level(corner, level);
      const auto ranges = possible_(direction_of(panorama_, px));
      if (!ranges) continue;
      if (const auto place = searched(level, px, *ranges, beside_px)) found.push_back(*place);
    }
    lowering_.fit(found);
  }

  std::optional<Place> searched(int level, const Eigen::Vector2d& px, const RangeInterval& ranges,
                                int beside_px) const {
    const double middle_m = 2.0 / (1.0 / ranges.near_m + 1.0 / ranges.far_m);
    const auto patch =
        find_patch(pyramid_, other_pyramid_, level, px,
                   {ranges, beside_px, [&](double x) { return lowering_.px(x, middle_m); }});
    if (!patch || patch->score < kLeastScore) return std::nullopt;
    if (!is_unique(*patch)) return std::nullopt;
    const auto place = fitted(level, px, *patch, kLeastFitted);
    if (!place || !leads_back(*place, beside_px)) return std::nullopt;
    return place;
  }
  std::optional<Place> fitted(int level, const Eigen::Vector2d& px, const PatchPlace& patch,
                              double least) const {
    const auto at = static_cast<std::size_t>(level);
    const double slope = epipolar_slope(panorama_, other_, px, patch.range_m);
    const auto fit = fit_patch(pyramid_.levels[at], to_level(px, level), slope,
                               other_pyramid_.levels[at], to_level(patch.px, level), patch.shape);
    if (!fit || fit->score < least) return std::nullopt;
    Place place{.level = level,
                .px = px,
                .other_px = from_level(fit->px, level),
                .sd_px = fit->sd_px * (1 << level),
                .fitted = fit->score};
    const double x = place.other_px.x();
    const auto found_m = range_m(panorama_, other_, px, x, patch.range_m);
    const auto beside_m = range_m(panorama_, other_, px, x + 1.0, patch.range_m);
    if (!found_m || !beside_m) return std::nullopt;
    place.range_m = *found_m;
    place.m_per_px = std::abs(*beside_m - *found_m);
    const Eigen::Vector3d p_ecef = point_ecef(panorama_, px, place.range_m);
    place.across_px = place.other_px.y() - pixel_of(other_, p_ecef).px.y();
    set_own(place, *fit, slope);
    return place;
  }
  void set_own(Place& place, const PatchFit& fit, double slope) const {
    const Eigen::Vector2d at = to_level(place.px, place.level);
    Eigen::Vector2d off =
        deciding_offset(pyramid_.levels[static_cast<std::size_t>(place.level)], at, slope);
    place.own_other_px = from_level(Eigen::Vector2d(fit.px + fit.shape * off), place.level);
    off.y() += slope * off.x();
    place.own_px = from_level(Eigen::Vector2d(at + off), place.level);
  }
  bool leads_back(const Place& place, int beside_px) const {
    const auto ranges = possible_other_(direction_of(other_, place.other_px));
    if (!ranges) return false;
    const double higher_px = lowering_.px(place.other_px.x(), place.range_m);
    const auto back = find_patch(other_pyramid_, pyramid_, place.level, place.other_px,
                                 {*ranges, beside_px, [&](double) { return -higher_px; }});
    return back && (back->px - place.px).norm() <= kBack_px * (1 << place.level);
  }

  // Sets the support of each place. Returns what was found around those that have enough of it.
  std::vector<Place> grown(std::vector<Place>& found) const {
    constexpr int kCell_px = 9, kFineCell_px = 12;
    constexpr float kStrong = 12.0F;
    std::vector<std::vector<Eigen::Vector2d>> corners;
    for (std::size_t level = 0; level < kLevels; ++level) {
      corners.push_back(
          corners_of(pyramid_.levels[level], level == 0 ? kFineCell_px : kCell_px, kStrong));
    }
    std::vector<Place> all;
    for (Place& place : found) {
      std::vector<Place> around;
      std::size_t tries = 0;
      for (int level = place.level; level >= place.level - 1; --level) {
        for (const Eigen::Vector2d& px :
             beside(place, corners[static_cast<std::size_t>(level)], level)) {
          ++tries;
          if (const auto one = at_same_range(place, level, px)) around.push_back(*one);
        }
      }
      if (tries == 0) continue;
      place.support = static_cast<double>(around.size()) / static_cast<double>(tries);
      if (place.support >= kSureSupport) all.insert(all.end(), around.begin(), around.end());
    }
    return all;
  }
  // The nearest ones.
  static std::vector<Eigen::Vector2d> beside(const Place& place,
                                             const std::vector<Eigen::Vector2d>& corners,
                                             int level) {
    constexpr std::size_t kMost = 14;
    std::vector<std::pair<double, Eigen::Vector2d>> near;
    for (const Eigen::Vector2d& corner : corners) {
      const double far_px = distance_px(corner, to_level(place.px, level));
      if (is_beside(far_px)) near.emplace_back(far_px, corner);
    }
    std::ranges::sort(near, {}, &std::pair<double, Eigen::Vector2d>::first);
    std::vector<Eigen::Vector2d> px;
    for (const auto& [far_px, corner] : near) {
      if (px.size() < kMost) px.push_back(from_level(corner, level));
    }
    return px;
  }
  std::optional<Place> at_same_range(const Place& place, int level,
                                     const Eigen::Vector2d& px) const {
    constexpr int kBeside_px = 2;
    const double depth_m = kDepth_m + 1.5 * place.m_per_px * (1 << place.level);
    if (depth_m > 0.5 * place.range_m) return std::nullopt;
    const RangeInterval ranges{place.range_m - depth_m, place.range_m + depth_m};
    const auto patch =
        find_patch(pyramid_, other_pyramid_, level, px,
                   {ranges, kBeside_px, [&](double x) { return lowering_.px(x, place.range_m); }});
    if (!patch || patch->score < kLeastScore) return std::nullopt;
    if (!is_unique(*patch)) return std::nullopt;
    const auto one = fitted(level, px, *patch, kLeastGrown);
    if (!one || !is_across(*one, kGrownAcrossSigmas)) return std::nullopt;
    if (std::abs(one->range_m - place.range_m) > 1.5 * depth_m) return std::nullopt;
    return one;
  }

  const ScenePanorama &panorama_, &other_;
  const PossibleRanges &possible_, &possible_other_;
  ScenePyramid pyramid_, other_pyramid_;
  Lowering lowering_;
};

double white_sd_m(const Place& place) {
  return place.m_per_px * std::max(kAlongSd * place.sd_px.x(), kLeastAlong_px);
}

// A corner may be found from several places. nullopt if the results contradict one another.
std::optional<Place> best_of(const std::vector<Place>& same) {
  const auto best = std::ranges::max_element(same, {}, &Place::fitted);
  for (const Place& place : same) {
    const double off_m = std::abs(place.range_m - best->range_m);
    if (off_m > kConflictSigmas * std::max(white_sd_m(place), white_sd_m(*best))) {
      return std::nullopt;
    }
  }
  return *best;
}

// Wrong places are alone.
bool is_supported(const Place& place, const std::vector<Place>& all) {
  const auto alike = std::ranges::count_if(all, [&](const Place& other) {
    const double scale = 1 << std::max(place.level, other.level);
    if (!is_beside(distance_px(place.px, other.px) / scale)) return false;
    const double sd_m = std::hypot(white_sd_m(place), white_sd_m(other));
    return std::abs(place.range_m - other.range_m) < std::max(kDepth_m, 3.0 * sd_m);
  });
  return alike >= kLeastAlike;
}

}  // namespace

std::vector<SceneryRange> scenery_ranges(const ScenePanorama& panorama, const ScenePanorama& other,
                                         const PossibleRanges& possible,
                                         const PossibleRanges& possible_other) {
  constexpr int kLeastSide_px = (2 * kPatchHalf + 1) << (kLevels - 1);  // one patch
  for (const cv::Mat1b* gray : {&panorama.gray, &other.gray}) {
    if (std::min(gray->cols, gray->rows) < kLeastSide_px) return {};
  }
  std::map<std::pair<double, double>, std::vector<Place>> by_px;
  for (const Place& place : Matcher(panorama, other, possible, possible_other).places()) {
    by_px[{place.px.y(), place.px.x()}].push_back(place);
  }
  std::vector<Place> places;
  for (const auto& [px, same] : by_px) {
    if (const auto best = best_of(same)) places.push_back(*best);
  }
  std::vector<SceneryRange> ranges;
  for (const Place& place : places) {
    if (!is_supported(place, places)) continue;
    const auto own_m =
        range_m(panorama, other, place.own_px, place.own_other_px.x(), place.range_m);
    if (!own_m) continue;
    ranges.push_back({direction_of(panorama, place.own_px), *own_m, white_sd_m(place),
                      range_sd_m(panorama, other, place.own_px, place.own_other_px.x(), *own_m),
                      place.own_px, place.own_other_px});
  }
  return ranges;
}

}  // namespace ols::scenery
