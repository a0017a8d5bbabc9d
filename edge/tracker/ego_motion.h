// Estimates the camera's own motion: a homography between adjacent frames, by KLT and RANSAC.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "edge/tracker/corner_flow.h"
#include "edge/tracker/image_motion.h"
#include "edge/tracker/tracker_config.h"

namespace ols::tracker {

// A frame, reduced once for all parts of the tracker that process the whole image.
struct ReducedFrame {
  cv::Mat image;
  double reduction = 1.0;  // full-frame pixels per reduced pixel

  Eigen::Matrix3d to_full() const;  // maps reduced pixels to full-frame pixels
};

ReducedFrame reduce_frame(const cv::Mat& gray, int most_width_px);

// The same corners in the previous frame and in this one, in reduced pixels.
struct CornerMatches {
  std::vector<cv::Point2f> previous;
  std::vector<cv::Point2f> current;
};

enum class HomographyFit {
  kRansac,        // RANSAC's result alone
  kLeastSquares,  // least squares over all corners that agree with one homography
};

class EgoMotionEstimator {
 public:
  EgoMotionEstimator(const TrackerConfig& config, HomographyFit fit) : config_(config), fit_(fit) {}

  struct Estimate {
    std::optional<ImageMotion> motion;  // from the previous frame to this one
    bool featureless = false;           // too few corners to determine a motion, as in a blank sky
  };

  // Takes the first frame, for which there is no motion.
  void start(const ReducedFrame& frame);
  // `predicted`: maps the previous frame's full-frame pixels to this frame's. The search for each
  // corner starts at its predicted place. Where the corners do not determine the estimate, it stays
  // near the prediction. Corners in or near `target_box` (of the previous frame) are ignored,
  // because they may move with the target.
  Estimate step(const ReducedFrame& frame, const cv::Rect2d& target_box,
                const std::optional<Eigen::Matrix3d>& predicted);

 private:
  void provide_corners(const cv::Rect2d& target_box);
  std::vector<cv::Point2f> detect_corners(const cv::Rect2d& target);
  CornerMatches follow(const Eigen::Matrix3d& guess) const;
  // The corners that fit one homography, and that homography.
  struct Agreement {
    CornerMatches corners;  // empty if there are too few to be trusted
    Eigen::Matrix3d homography = Eigen::Matrix3d::Identity();
  };
  Agreement agreeing(const CornerMatches& matches, const Eigen::Matrix3d& guess) const;

  TrackerConfig config_;
  HomographyFit fit_;
  ReducedFrame previous_;
  ImagePyramid previous_pyramid_;
  ImagePyramid pyramid_;
  std::vector<cv::Point2f> corners_;                    // in the previous frame, reduced pixels
  std::size_t detected_ = 0;                            // number of corners at the last detection
  int followed_ = 0;                                    // number of frames since then
  Eigen::Matrix3d last_ = Eigen::Matrix3d::Identity();  // last homography, in reduced pixels
  int corner_threshold_ = 15;                           // threshold of FAST [grey levels]
};

// Whether a homography can be a small camera rotation: finite, no mirror image, little change of
// scale, and a large part of the image still visible.
bool plausible_homography(const Eigen::Matrix3d& homography, const cv::Size& image);

// Whether an accumulated homography can be inverted: finite, not nearly singular.
bool aligns(const Eigen::Matrix3d& homography);

// The homography that maps `previous` to `current`, by least squares. A prior pulls the correction
// of `guess` towards a pure shift, because corners on a strip of ground say little about the motion
// of the sky above it.
Eigen::Matrix3d fit_homography(const std::vector<cv::Point2f>& previous,
                               const std::vector<cv::Point2f>& current,
                               const Eigen::Matrix3d& guess, const cv::Size& image);

}  // namespace ols::tracker
