#include "calibration/pictures/scene_tracks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "geometry/median.h"

namespace ols::calibration {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const SceneSighting* sighting_in(const std::vector<SceneSighting>& seen, std::size_t picture) {
  const auto found = std::ranges::find(seen, picture, &SceneSighting::picture);
  return found == seen.end() ? nullptr : &*found;
}

// A motion that all points of a pair share: an offset, and how it grows over the picture.
using Affine = Eigen::Matrix<double, 3, 2>;

Affine fitted(const std::vector<Vector2d>& places, const std::vector<Vector2d>& offsets,
              const std::vector<bool>& used) {
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  Affine b = Affine::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!used[i]) continue;
    const Vector3d row(1.0, places[i].x(), places[i].y());
    N += row * row.transpose();
    b += row * offsets[i].transpose();
  }
  constexpr double kStiff = 1e4;  // few points or a row of them: no growth across it
  N(1, 1) += kStiff;
  N(2, 2) += kStiff;
  return N.ldlt().solve(b);
}

}  // namespace

std::optional<Vector2d> SceneTracks::predicted(const Vector2d& pixel, const PanTilt& from,
                                               const PanTilt& to) const {
  const auto ray = unproject(geometry_.camera, pixel);
  if (!ray) return std::nullopt;
  const Eigen::Matrix3d R_from = enu_from_camera(geometry_.chain, from).linear();
  const Eigen::Matrix3d R_to = enu_from_camera(geometry_.chain, to).linear();
  const Vector3d there = R_to.transpose() * R_from * *ray;
  if (there.z() <= 0.0) return std::nullopt;
  return project(geometry_.camera, there);
}

// How a patch of the one picture stands in the other: takes the other's pixels to its own.
std::optional<Matrix2d> SceneTracks::turned(const Vector2d& pixel, const PanTilt& from,
                                            const PanTilt& to) const {
  const auto place = predicted(pixel, from, to);
  const auto right = predicted(pixel + Vector2d(1.0, 0.0), from, to);
  const auto down = predicted(pixel + Vector2d(0.0, 1.0), from, to);
  if (!place || !right || !down) return std::nullopt;
  Matrix2d forward;
  forward << *right - *place, *down - *place;
  return forward.inverse();
}

// Earlier pictures that share at least a third of their width and height, the nearest first.
std::vector<std::size_t> SceneTracks::neighbours(std::size_t picture) const {
  constexpr std::size_t kMost = 6;
  constexpr double kShared = 2.0 / 3.0;
  const CameraIntrinsics& camera = geometry_.camera;
  const Vector2d middle(0.5 * camera.width_px, 0.5 * camera.height_px);
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < picture; ++i) {
    const auto place = predicted(middle, pictures_[i].angles, pictures_[picture].angles);
    if (!place) continue;
    const Vector2d away = (*place - middle).cwiseAbs();
    if (away.x() < kShared * camera.width_px && away.y() < kShared * camera.height_px) {
      near.emplace_back(away.norm(), i);
    }
  }
  std::ranges::sort(near);
  std::vector<std::size_t> result;
  for (const auto& one : near) result.push_back(one.second);
  if (result.size() > kMost) result.resize(kMost);
  return result;
}

std::vector<SceneTracks::Candidate> SceneTracks::candidates(std::size_t from,
                                                            std::size_t to) const {
  const Picture& now = pictures_[to];
  const double margin = options_.patch_half_px + 1.0;
  const cv::Rect2d inner(margin, margin, now.gray.cols - 1 - 2 * margin,
                         now.gray.rows - 1 - 2 * margin);
  std::vector<Candidate> result;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const SceneSighting* seen = sighting_in(tracks_[i].seen, from);
    if (seen == nullptr || sighting_in(tracks_[i].seen, to) != nullptr) continue;
    const auto place = predicted(seen->pixel, pictures_[from].angles, now.angles);
    if (!place || !inner.contains({place->x(), place->y()})) continue;
    // Always the patch in which the point was found: it does not drift from picture to picture.
    const SceneSighting& first = tracks_[i].seen.front();
    const Picture& source = pictures_[first.picture];
    const auto turn = turned(first.pixel, source.angles, now.angles);
    if (!turn) continue;
    auto patch = cut_patch(source.gray, first.pixel, options_.patch_half_px, *turn);
    if (patch) result.push_back({i, std::move(*patch), *place, {}});
  }
  return result;
}

// Of some points within the whole reach; nothing where they do not agree.
std::optional<Vector2d> SceneTracks::common_offset(const std::vector<Candidate>& all,
                                                   const cv::Mat& gray) const {
  constexpr std::size_t kTried = 16, kLeast = 3;
  constexpr double kAlike_px = 4.0;
  std::vector<Vector2d> offsets;
  const std::size_t every = std::max<std::size_t>(1, all.size() / kTried);
  for (std::size_t i = 0; i < all.size(); i += every) {
    const PatchMatch match = find_patch(all[i].patch, gray, all[i].predicted, options_.reach_px);
    if (match) offsets.push_back(match.centre_px - all[i].predicted);
  }
  if (offsets.size() < kLeast) return std::nullopt;
  // The offset that most others are near to.
  const auto votes = [&](const Vector2d& one) {
    return std::ranges::count_if(
        offsets, [&](const Vector2d& o) { return (o - one).cwiseAbs().maxCoeff() < kAlike_px; });
  };
  const auto best = std::ranges::max_element(offsets, {}, votes);
  const auto n = static_cast<std::size_t>(votes(*best));
  if (n < kLeast || 2 * n < offsets.size()) return std::nullopt;
  return *best;
}

void SceneTracks::match_pair(std::size_t from, std::size_t to) {
  constexpr double kFine_px = 6.0;
  std::vector<Candidate> all = candidates(from, to);
  if (all.empty()) return;
  const cv::Mat& gray = pictures_[to].gray;
  const auto offset = common_offset(all, gray);
  if (!offset) return;
  for (Candidate& one : all) {
    one.match = find_patch(one.patch, gray, one.predicted + *offset, kFine_px);
  }
  std::erase_if(all, [](const Candidate& one) { return !one.match; });
  keep_agreeing(all, from, to);
}

void SceneTracks::keep_agreeing(std::vector<Candidate>& all, std::size_t from, std::size_t to) {
  constexpr std::size_t kLeast = 3;
  if (all.size() < kLeast) return;
  std::vector<Vector2d> places, offsets;
  for (const Candidate& one : all) {
    places.push_back(one.predicted -
                     Vector2d(0.5 * geometry_.camera.width_px, 0.5 * geometry_.camera.height_px));
    offsets.push_back(one.match.centre_px - one.predicted);
  }
  const Vector2d middle = median(offsets);
  std::vector<bool> agrees(all.size());
  const auto select = [&](const Affine& motion, double within_px) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vector3d row(1.0, places[i].x(), places[i].y());
      const Vector2d miss = offsets[i] - motion.transpose() * row;
      agrees[i] = miss.cwiseAbs().maxCoeff() <= within_px;
    }
  };
  Affine motion = Affine::Zero();
  motion.row(0) = middle.transpose();
  constexpr double kFirst = 3.0;  // before it is known how the offset grows over the picture
  select(motion, kFirst * options_.agree_px);
  for (int round = 0; round < 3; ++round) {
    motion = fitted(places, offsets, agrees);
    select(motion, options_.agree_px);
  }
  ScenePair pair{from, to, 0, 0, middle};
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!agrees[i]) {
      ++pair.moved;
      continue;
    }
    ++pair.matched;
    tracks_[all[i].track].seen.push_back(
        {static_cast<int>(all[i].track), to, all[i].match.centre_px, all[i].match.sd_px});
  }
  pairs_.push_back(pair);
}

// New points where there are none yet.
void SceneTracks::add_points(std::size_t picture) {
  constexpr double kQuality = 0.02, kSpacing = 0.08;  // of the strongest; of the width
  constexpr double kOfCut_px =
      0.02;  // the point is where the patch is cut; its noise is the patch's
  const cv::Mat& gray = pictures_[picture].gray;
  const int spacing = std::max(8, static_cast<int>(kSpacing * gray.cols));
  cv::Mat free(gray.size(), CV_8U, cv::Scalar(0));
  const int margin = options_.patch_half_px + 5;
  free(cv::Rect(margin, margin, gray.cols - 2 * margin, gray.rows - 2 * margin)).setTo(255);
  int missing = options_.points_a_picture;
  for (const Track& track : tracks_) {
    const SceneSighting* seen = sighting_in(track.seen, picture);
    if (seen == nullptr) continue;
    --missing;
    cv::circle(free, {static_cast<int>(seen->pixel.x()), static_cast<int>(seen->pixel.y())},
               spacing, 0, cv::FILLED);
  }
  if (missing <= 0) return;
  std::vector<cv::Point2f> corners;
  cv::Mat smooth;
  cv::GaussianBlur(gray, smooth, {}, 1.0);
  cv::goodFeaturesToTrack(smooth, corners, missing, kQuality, spacing, free, 7);
  for (const cv::Point2f& corner : corners) {
    const int number = static_cast<int>(tracks_.size());
    tracks_.push_back({{{number, picture, Vector2d(corner.x, corner.y), kOfCut_px}}});
  }
}

void SceneTracks::add(const cv::Mat& gray, const PanTilt& angles) {
  const std::size_t picture = pictures_.size();
  pictures_.push_back({gray, angles});
  for (const std::size_t before : neighbours(picture)) match_pair(before, picture);
  add_points(picture);
}

std::vector<SceneSighting> SceneTracks::sightings() const {
  std::vector<SceneSighting> result;
  for (const Track& track : tracks_) {
    if (track.seen.size() < 2) continue;
    result.insert(result.end(), track.seen.begin(), track.seen.end());
  }
  std::ranges::stable_sort(result, {}, &SceneSighting::picture);
  return result;
}

int SceneTracks::moving_pairs() const {
  return static_cast<int>(std::ranges::count_if(
      pairs_, [](const ScenePair& pair) { return pair.moved > pair.matched; }));
}

}  // namespace ols::calibration
