// Finds the same points of the scenery in overlapping pictures of a sweep. Pure.
//
// From the PTU's angles, the kinematic chain predicts where a point appears in another picture, to
// within some tens of pixels. For each pair of pictures, the offset that is common to all points is
// found first. Then least-squares matching locates each point to a fraction of a pixel. Points that
// move relative to the others (cars, branches, clouds) are left out.
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
  double reach_px = 40.0;     // largest error of the prediction
  int points_a_picture = 40;  // largest number of points in a picture
  int patch_half_px = 9;
  double agree_px = 1.0;  // largest deviation of a point from the common offset of a pair
};

struct SceneSighting {
  int track = 0;            // number of the point
  std::size_t picture = 0;  // index, in the order of add()
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double sd_px = 0.0;
};

struct ScenePair {
  std::size_t first = 0, second = 0;
  int matched = 0, moved = 0;  // numbers of points with and without the common offset
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();  // median of found minus predicted position
};

class SceneTracks {
 public:
  explicit SceneTracks(const StationGeometry& geometry, const SceneTrackOptions& options = {})
      : geometry_(geometry), options_(options) {}

  // Adds a picture with the PTU's angles at its exposure.
  void add(const cv::Mat& gray, const PanTilt& angles);

  // The sightings of points seen in at least two pictures, sorted by picture.
  std::vector<SceneSighting> sightings() const;
  const std::vector<ScenePair>& pairs() const { return pairs_; }
  // The number of pairs in which more points moved than stayed. In these, the scene is not still.
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
