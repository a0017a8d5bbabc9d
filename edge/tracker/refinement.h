// Sub-pixel position of the target, by least squares between its first image and this one.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/patch.h"

namespace ols::tracker {

struct RefinedPosition {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // of the box that fits the first image
  Eigen::Vector2d size_px = Eigen::Vector2d::Ones();
  // Of centre and size [px], due to image noise.
  Eigen::Matrix4d covariance_px2 = Eigen::Matrix4d::Identity();
  double correlation = 0.0;  // -1..1
  // Factor by which correlated residuals of neighbouring pixels raise the uncertainty above that of
  // independent noise: a background with another motion, a lens, a changed appearance.
  double shared_noise = 1.0;

  // A point of the target. `place`: its position in the box, in sizes from the centre.
  Eigen::Vector2d point(const Eigen::Vector2d& place) const {
    return centre + place.cwiseProduct(size_px);
  }
  Eigen::Matrix2d point_covariance_px2(const Eigen::Vector2d& place) const {
    Eigen::Matrix<double, 2, 4> by = Eigen::Matrix<double, 2, 4>::Identity();
    by.rightCols<2>() = place.asDiagonal();
    return by * covariance_px2 * by.transpose();
  }
};

class PositionRefiner {
 public:
  // Keeps the target's image on the sampling view's own pixel grid, slightly beyond the box.
  PositionRefiner(const FrameView& view, const Eigen::Vector2d& pixel,
                  const Eigen::Vector2d& size_px);

  // Sets M_t: pixels that are not foreground have another motion, and get little weight from now
  // on.
  void set_mask(const MaskPatch& mask);

  // Starts from the centre of a box within about a third of the target. nullopt: it does not
  // converge there, the target has too little structure, or half of it is outside the image. The
  // size is that of the box. If a likely size is given, the size is estimated, starting from that.
  std::optional<RefinedPosition> refine(
      const FrameView& view, const Eigen::Vector2d& start, const Eigen::Vector2d& size_px,
      const std::optional<Eigen::Vector2d>& likely_size_px = std::nullopt) const;

 private:
  struct Sample {
    double u, v;  // position relative to the box, -0.5..0.5 inside
    double gray;
    double gradient_u, gradient_v;  // grey levels for each unit of u, v
    double weight;
    int block;  // of neighbours; the samples are in block order
  };
  // Shift along u and v, growth along u and v, gain, offset.
  using Parameters = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  struct Normal;
  struct State {
    Eigen::Vector2d anchor;  // its place [px]
    Eigen::Vector2d size_px;
    double gain = 1.0;    // ratio of this image's grey levels to the first one's
    double offset = 0.0;  // [grey levels]

    void step_back(const Parameters& change);
  };

  void keep_steepest(const Eigen::Vector2d& size_px);
  void sort_by_blocks();
  void find_anchor();
  static Sample sample_of(const cv::Mat& image, const cv::Point& at, const Eigen::Vector2d& place,
                          const Eigen::Vector2d& size);
  Normal accumulate(const FrameView& view, const State& state, double scale) const;
  std::optional<Normal> normal_at(const FrameView& view, const State& state, double scale,
                                  const std::optional<Eigen::Vector2d>& likely_size_px) const;
  std::optional<RefinedPosition> position_of(const State& state, const Normal& normal,
                                             const Eigen::Vector2d& shift) const;

  std::vector<Sample> samples_;
  double all_weight_ = 0.0;
  // The centre, in sizes, of the samples that determine the position.
  Eigen::Vector2d anchor_ = Eigen::Vector2d::Zero();
};

}  // namespace ols::tracker
