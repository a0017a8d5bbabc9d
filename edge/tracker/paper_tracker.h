// The tracker of the paper's section 5, without our additions (mode = "paper"). Some comments quote
// the paper.
#pragma once

#include <optional>
#include <vector>

#include "edge/tracker/paper_template.h"
#include "edge/tracker/particle_filter.h"
#include "edge/tracker/scene_motion.h"

namespace ols::tracker {

class PaperTracker {
 public:
  PaperTracker(const TrackerConfig& config, std::uint64_t seed, const TrackerInput& frame,
               const cv::Rect2d& box);
  TrackerOutput step(const TrackerInput& frame, StageTimer& timer);
  // The camera's motion from the previous frame to the newest one; nullopt without texture.
  const std::optional<ImageMotion>& image_motion() const { return scene_motion_.image_motion(); }
  // In the paper, the operator designates the target again. Here the particles move to the given
  // place.
  void search_near(const Eigen::Vector2d& pixel, double sd_px);

 private:
  EgoMotion transform_by_homography(const TrackerInput& frame, StageTimer& timer);
  void predict();
  void force_subset_onto_differences();
  void weigh(const cv::Mat& gray);
  std::vector<double> normalised(std::vector<double> weights);
  const Particle& maximum_a_posteriori() const;
  TrackerOutput output_of(const Particle& best) const;
  Eigen::Vector2d noise(double sd);

  TrackerConfig config_;
  Random random_;
  SceneMotion scene_motion_;
  PaperTemplate template_;
  ParticleFilter filter_;
  double greatest_objective_ = 0.0;  // value of eq. (5) for the best particle
  Particle last_;
  bool placed_ = false;  // search_near() has already placed the particles for the coming frame
};

}  // namespace ols::tracker
