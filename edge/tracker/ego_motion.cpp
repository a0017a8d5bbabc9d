#include "edge/tracker/ego_motion.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "edge/tracker/median.h"
#include "edge/tracker/patch.h"

namespace ols::tracker {
namespace {

constexpr double kAlike = 0.7;   // minimum correlation of a corner's surroundings
constexpr double kInlier = 1.5;  // reduced pixels

// The strongest corners of each cell of a grid, so that they cover the image.
std::vector<cv::Point2f> spread(const std::vector<cv::KeyPoint>& corners, const cv::Size& image,
                                int wanted) {
  constexpr int kColumns = 12;
  constexpr int kRows = 9;
  const auto a_cell = static_cast<std::size_t>(std::max(1, 2 * wanted / (kColumns * kRows)));
  std::vector<std::vector<const cv::KeyPoint*>> cells(kColumns * kRows);
  for (const cv::KeyPoint& corner : corners) {
    const int column = static_cast<int>(corner.pt.x) * kColumns / image.width;
    const int row = static_cast<int>(corner.pt.y) * kRows / image.height;
    cells[static_cast<std::size_t>(row * kColumns + column)].push_back(&corner);
  }
  std::vector<cv::Point2f> chosen;
  for (auto& cell : cells) {
    std::stable_sort(cell.begin(), cell.end(),
                     [](const auto* a, const auto* b) { return a->response > b->response; });
    for (std::size_t i = 0; i < std::min(a_cell, cell.size()); ++i) chosen.push_back(cell[i]->pt);
  }
  return chosen;
}

Eigen::Vector2d vector_of(const cv::Point2f& point) {
  return {static_cast<double>(point.x), static_cast<double>(point.y)};
}

// The guess, shifted by the offset of most of the corners.
Eigen::Matrix3d shifted(const Eigen::Matrix3d& guess, const CornerMatches& matches) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < matches.previous.size(); ++i) {
    const Eigen::Vector2d off =
        vector_of(matches.current[i]) - transform(guess, vector_of(matches.previous[i]));
    x.push_back(off.x());
    y.push_back(off.y());
  }
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift(0, 2) = median(std::move(x));
  shift(1, 2) = median(std::move(y));
  return shift * guess;
}

// The corners whose motion matches the homography.
CornerMatches explained(const CornerMatches& matches, const Eigen::Matrix3d& homography) {
  CornerMatches kept;
  for (std::size_t i = 0; i < matches.previous.size(); ++i) {
    const Eigen::Vector2d there = transform(homography, vector_of(matches.previous[i]));
    const double off_px = (vector_of(matches.current[i]) - there).norm();
    if (!(off_px <= kInlier)) continue;
    kept.previous.push_back(matches.previous[i]);
    kept.current.push_back(matches.current[i]);
  }
  return kept;
}

// The middle of the corners in the previous frame, and the 1-sigma of a mean over all corners, by
// their distances from the homography.
std::pair<Eigen::Vector2d, double> middle_of(const CornerMatches& matches,
                                             const Eigen::Matrix3d& homography) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double squares = 0.0;
  const auto count = static_cast<double>(matches.previous.size());
  for (std::size_t i = 0; i < matches.previous.size(); ++i) {
    const Eigen::Vector2d from = vector_of(matches.previous[i]);
    middle += from / count;
    squares += (vector_of(matches.current[i]) - transform(homography, from)).squaredNorm();
  }
  return {middle, std::sqrt(squares / 2.0) / count};
}

// Least squares for a homography near the identity: the 3x3 difference from it, row by row, without
// the last element.
class CorrectionFit {
 public:
  explicit CorrectionFit(double corner_sd) : corner_sd_(corner_sd) {}

  void add_corner(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d d = to - from;
    const double u = from.x(), v = from.y();
    Vector8 x_row;
    x_row << u, v, 1.0, 0.0, 0.0, 0.0, -u * to.x(), -v * to.x();
    Vector8 y_row;
    y_row << 0.0, 0.0, 0.0, u, v, 1.0, -u * to.y(), -v * to.y();
    add(x_row, d.x(), corner_sd_);
    add(y_row, d.y(), corner_sd_);
  }

  // Between two frames a camera rolls and zooms a little; it hardly shears.
  void hold_rigid() {
    hold(3, 1, -1.0, 0.02);   // twice the roll
    hold(0, 4, 1.0, 0.01);    // twice the scale
    hold(3, 1, 1.0, 0.002);   // shear
    hold(0, 4, -1.0, 0.002);  // stretch
    hold(6, 6, 0.0, 0.005);   // perspective
    hold(7, 7, 0.0, 0.005);
    hold(2, 2, 0.0, 1e3 * corner_sd_);  // a shift is practically free
    hold(5, 5, 0.0, 1e3 * corner_sd_);
  }

  Eigen::Matrix3d correction() const {
    const Vector8 found = normal_.ldlt().solve(right_);
    Eigen::Matrix3d correction = Eigen::Matrix3d::Identity();
    correction.row(0) += found.segment<3>(0).transpose();
    correction.row(1) += found.segment<3>(3).transpose();
    correction(2, 0) += found(6);
    correction(2, 1) += found(7);
    return correction;
  }

 private:
  using Vector8 = Eigen::Matrix<double, 8, 1>;

  void add(const Vector8& row, double value, double sd) {
    normal_ += row * row.transpose() / (sd * sd);
    right_ += row * value / (sd * sd);
  }
  // Prior: element i, plus `sign` times element j, is near zero.
  void hold(int i, int j, double sign, double sd) {
    Vector8 row = Vector8::Zero();
    row(i) = 1.0;
    if (j != i) row(j) = sign;
    add(row, 0.0, sd);
  }

  double corner_sd_;
  Eigen::Matrix<double, 8, 8> normal_ = Eigen::Matrix<double, 8, 8>::Zero();
  Vector8 right_ = Vector8::Zero();
};

}  // namespace

Eigen::Matrix3d ReducedFrame::to_full() const {
  // Pixel centres: full = (reduced + 0.5) * reduction - 0.5.
  Eigen::Matrix3d scale = Eigen::Matrix3d::Identity();
  scale(0, 0) = scale(1, 1) = reduction;
  scale(0, 2) = scale(1, 2) = (reduction - 1.0) / 2.0;
  return scale;
}

ReducedFrame reduce_frame(const cv::Mat& gray, int most_width_px) {
  const int reduction = (gray.cols + most_width_px - 1) / most_width_px;
  const int width = gray.cols / reduction;
  const int height = gray.rows / reduction;
  if (reduction <= 1 || width == 0 || height == 0) return {gray.clone(), 1.0};
  ReducedFrame reduced{cv::Mat(), static_cast<double>(reduction)};
  cv::resize(gray(cv::Rect(0, 0, width * reduction, height * reduction)), reduced.image,
             cv::Size(width, height), 0, 0, cv::INTER_AREA);
  return reduced;
}

bool plausible_homography(const Eigen::Matrix3d& homography, const cv::Size& image) {
  if (!homography.allFinite() || std::abs(homography(2, 2)) < 1e-9) return false;
  const Eigen::Matrix3d h = homography / homography(2, 2);
  const double scale = h.topLeftCorner<2, 2>().determinant();
  if (scale < 0.7 || scale > 1.4) return false;
  if (std::abs(h(2, 0)) * image.width + std::abs(h(2, 1)) * image.height > 0.3) return false;
  const Eigen::Vector2d centre(image.width / 2.0, image.height / 2.0);
  const Eigen::Vector2d moved = transform(h, centre) - centre;
  return std::abs(moved.x()) < 0.6 * image.width && std::abs(moved.y()) < 0.6 * image.height;
}

bool aligns(const Eigen::Matrix3d& homography) {
  constexpr double kMost = 100.0;  // factor of scale
  const double scale = std::abs(homography.determinant());
  return homography.allFinite() && scale > 1.0 / kMost && scale < kMost;
}

Eigen::Matrix3d fit_homography(const std::vector<cv::Point2f>& previous,
                               const std::vector<cv::Point2f>& current,
                               const Eigen::Matrix3d& guess, const cv::Size& image) {
  // Coordinates relative to the image centre, in units of half its width.
  const double unit = image.width / 2.0;
  Eigen::Matrix3d to_unit;
  to_unit << 1.0 / unit, 0.0, -1.0, 0.0, 1.0 / unit, -image.height / (2.0 * unit), 0.0, 0.0, 1.0;
  CorrectionFit fit(0.3 / unit);
  for (std::size_t i = 0; i < previous.size(); ++i) {
    fit.add_corner(transform(to_unit * guess, vector_of(previous[i])),
                   transform(to_unit, vector_of(current[i])));
  }
  fit.hold_rigid();
  const Eigen::Matrix3d full = to_unit.inverse() * fit.correction() * to_unit * guess;
  return full / full(2, 2);
}

void EgoMotionEstimator::start(const ReducedFrame& frame) {
  previous_ = frame;
  previous_pyramid_.build(frame.image);
  corners_.clear();
  last_.setIdentity();
}

std::vector<cv::Point2f> EgoMotionEstimator::detect_corners(const cv::Rect2d& target) {
  constexpr int kGreatestThreshold = 60;
  const int least = std::max(6, static_cast<int>(std::ceil(5.0 * pixel_noise(previous_.image))));
  corner_threshold_ = std::clamp(corner_threshold_, least, std::max(least, kGreatestThreshold));
  std::vector<cv::KeyPoint> corners;
  cv::FAST(previous_.image, corners, corner_threshold_, true);
  // The next threshold, for enough corners but not too many to sort.
  const auto found = static_cast<int>(corners.size());
  if (found < 4 * config_.ego_motion_corners) --corner_threshold_;
  if (found < config_.ego_motion_corners) corner_threshold_ -= 2;
  if (found > 12 * config_.ego_motion_corners) corner_threshold_ += 2;
  std::erase_if(
      corners, [&](const cv::KeyPoint& corner) { return target.contains(cv::Point2d(corner.pt)); });
  return spread(corners, previous_.image.size(), config_.ego_motion_corners);
}

// The corners followed so far, or new ones if these are few or old.
void EgoMotionEstimator::provide_corners(const cv::Rect2d& target_box) {
  constexpr int kLongest = 5;  // [frames] the camera turns to where there are none
  constexpr double kEnough = 0.7;
  const double scale = previous_.reduction;
  const cv::Rect2d target((target_box.x - target_box.width * 0.25) / scale,
                          (target_box.y - target_box.height * 0.25) / scale,
                          1.5 * target_box.width / scale, 1.5 * target_box.height / scale);
  std::erase_if(corners_,
                [&](const cv::Point2f& corner) { return target.contains(cv::Point2d(corner)); });
  const double enough = std::max(kEnough * static_cast<double>(detected_),
                                 static_cast<double>(config_.ego_motion_least_inliers));
  if (++followed_ <= kLongest && static_cast<double>(corners_.size()) >= enough) return;
  corners_ = detect_corners(target);
  detected_ = corners_.size();
  followed_ = 0;
}

CornerMatches EgoMotionEstimator::follow(const Eigen::Matrix3d& guess) const {
  CornerMatches matches;
  for (const cv::Point2f& corner : corners_) {
    const Eigen::Vector2d moved = transform(guess, vector_of(corner));
    const cv::Point2f near(static_cast<float>(moved.x()), static_cast<float>(moved.y()));
    const FollowedCorner followed = follow_corner(previous_pyramid_, pyramid_, corner, near);
    // A corner of noise stays at the start of its search, and would agree with any guess.
    if (followed.correlation < kAlike) continue;
    matches.previous.push_back(corner);
    matches.current.push_back(followed.at);
  }
  return matches;
}

EgoMotionEstimator::Agreement EgoMotionEstimator::agreeing(const CornerMatches& matches,
                                                           const Eigen::Matrix3d& guess) const {
  const bool only_ransac = fit_ == HomographyFit::kRansac;
  const auto fitted = [&](const CornerMatches& kept) {
    return fit_homography(kept.previous, kept.current, guess, previous_.image.size());
  };
  const auto count = static_cast<double>(matches.previous.size());
  const double least = std::max({4.0, static_cast<double>(config_.ego_motion_least_inliers),
                                 config_.ego_motion_least_inlier_fraction * count});
  if (count < least) return {};
  const auto enough = [](const CornerMatches& kept, double wanted) {
    return static_cast<double>(kept.previous.size()) >= wanted;
  };
  // Usually the camera turned as guessed except for a shift, and nearly all corners agree: RANSAC
  // would find no others.
  const double clear = std::max(least, 0.8 * count);
  CornerMatches kept = explained(matches, shifted(guess, matches));
  if (!only_ransac && enough(kept, clear)) {
    kept = explained(matches, fitted(kept));
    if (enough(kept, clear)) return {kept, fitted(kept)};
  }
  // RANSAC has its own random numbers, seeded equally each time.
  const cv::Mat found = cv::findHomography(matches.previous, matches.current, cv::RANSAC, kInlier,
                                           cv::noArray(), 500, 0.995);
  if (found.empty()) return {};
  Eigen::Matrix3d homography;
  cv::cv2eigen(found, homography);
  kept = explained(matches, homography);
  if (!enough(kept, least)) return {};
  return {kept, only_ransac ? homography : fitted(kept)};
}

EgoMotionEstimator::Estimate EgoMotionEstimator::step(
    const ReducedFrame& frame, const cv::Rect2d& target_box,
    const std::optional<Eigen::Matrix3d>& predicted) {
  const Eigen::Matrix3d to_full = frame.to_full();
  const Eigen::Matrix3d from_full = to_full.inverse();
  const Eigen::Matrix3d guess = predicted ? from_full * *predicted * to_full : last_;
  provide_corners(target_box);
  pyramid_.build(frame.image);
  Estimate estimate;
  estimate.featureless = static_cast<int>(corners_.size()) < config_.ego_motion_least_inliers;
  Agreement agreed = agreeing(follow(guess), guess);
  // The angles are off by more than the corner search reaches: start from the previous motion.
  if (predicted && agreed.corners.previous.empty()) agreed = agreeing(follow(last_), last_);
  last_ = predicted ? guess : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  corners_.clear();
  if (!agreed.corners.previous.empty() &&
      plausible_homography(agreed.homography, frame.image.size())) {
    const auto [middle, sd] = middle_of(agreed.corners, agreed.homography);
    estimate.motion = ImageMotion{to_full * agreed.homography * from_full,
                                  transform(to_full, middle), sd * frame.reduction};
    last_ = agreed.homography;
    corners_ = agreed.corners.current;
  }
  previous_ = frame;
  std::swap(previous_pyramid_, pyramid_);
  return estimate;
}

}  // namespace ols::tracker
