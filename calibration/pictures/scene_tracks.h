// Finds points of the scenery again in the overlapping pictures of a sweep. Pure.
//
// The chain predicts the position of a point in another picture to some tens of pixels. First the
// offset that all points of a pair of pictures share is found; then each point to a fraction of a
// pixel, by least-squares matching. Points that move against the others (cars, branches, clouds)
// are left out.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "calibration/pictures/patch_matching.h"
#include "geometry/sight.h"

namespace ols::calibration {

struct SceneTrackOptions {
  double reach_px = 40.0;     // max error of the chain from picture to picture
  int points_a_picture = 40;  // max number
  int patch_half_px = 9;
  double agree_px = 1.0;  // max distance of a point from the common motion of its pair
};

struct SceneSighting {
  int track = 0;            // running number
  std::size_t picture = 0;  // in the order of add()
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
};

struct ScenePair {
  std::size_t first = 0, second = 0;
  int matched = 0, moved = 0;                           // points that agree, and that do not
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();  // found minus predicted, the median
};

class SceneTracks {
 public:
  explicit SceneTracks(const StationGeometry& geometry, const SceneTrackOptions& options = {})
      : geometry_(geometry), options_(options) {}

  // Adds a picture with the angles at its exposure.
  void add(const cv::Mat& gray, const PanTilt& angles);

  // Tracks seen in at least two pictures, sorted by picture.
  std::vector<SceneSighting> sightings() const;
  const std::vector<ScenePair>& pairs() const { return pairs_; }
  // Number of pairs in which more points have moved than stayed: the scene is not still.
  int moving_pairs() const;

 private:
  struct Picture {
    cv::Mat gray;
    PanTilt angles;
  };
  struct Track {
    std::vector<SceneSighting> seen;
  };
  struct Candidate {
    std::size_t track = 0;
    Patch patch;
    Eigen::Vector2d predicted = Eigen::Vector2d::Zero();
    PatchMatch match;
  };

  std::optional<Eigen::Vector2d> predicted(const Eigen::Vector2d& pixel, const PanTilt& from,
                                           const PanTilt& to) const;
  std::optional<Eigen::Matrix2d> turned(const Eigen::Vector2d& pixel, const PanTilt& from,
                                        const PanTilt& to) const;
  std::vector<std::size_t> neighbours(std::size_t picture) const;
  std::vector<Candidate> candidates(std::size_t from, std::size_t to) const;
  void match_pair(std::size_t from, std::size_t to);
  std::optional<Eigen::Vector2d> common_offset(const std::vector<Candidate>& all,
                                               const cv::Mat& gray) const;
  void keep_agreeing(std::vector<Candidate>& all, std::size_t from, std::size_t to);
  void add_points(std::size_t picture);

  StationGeometry geometry_;
  SceneTrackOptions options_;
  std::vector<Picture> pictures_;
  std::vector<Track> tracks_;
  std::vector<ScenePair> pairs_;
};

}  // namespace ols::calibration
