// Measures the target's sub-pixel position, by least squares between its first image and this one.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/patch.h"

namespace ols::tracker {

struct RefinedPosition {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // centre of the box that fits the first image
  Eigen::Vector2d size_px = Eigen::Vector2d::Ones();
  // Covariance of centre and size [px] that image noise causes.
  Eigen::Matrix4d covariance_px2 = Eigen::Matrix4d::Identity();
  double correlation = 0.0;  // -1..1
  // Factor by which correlated residuals of neighbouring pixels raise the uncertainty above that of
  // independent noise. Causes are a background that moves differently, the lens, or a changed
  // appearance.
  double shared_noise = 1.0;

  // The position of a point of the target. `place`: the point relative to the box's centre, in
  // sizes of the box.
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
  // Keeps the target's image on the pixel grid of the sampled view, with a margin around the box.
  PositionRefiner(const FrameView& view, const Eigen::Vector2d& pixel,
                  const Eigen::Vector2d& size_px);

  // Sets M_t. Pixels that are not foreground move differently, so they get little weight from now
  // on.
  void set_mask(const MaskPatch& mask);

  // `start`: the centre of a box, wrong by at most about a third of the target's size. nullopt if
  // the fit does not converge, if the target has too little structure, or if half of the target is
  // outside the image. The size is kept at `size_px`. If a likely size is given, the size is
  // estimated too, starting from it.
  std::optional<RefinedPosition> refine(
      const FrameView& view, const Eigen::Vector2d& start, const Eigen::Vector2d& size_px,
      const std::optional<Eigen::Vector2d>& likely_size_px = std::nullopt) const;

 private:
  struct Sample {
    double u, v;  // position relative to the box; -0.5..0.5 inside
    double gray;
    double gradient_u, gradient_v;  // grey levels per unit of u, v
    double weight;
    int block;  // number of the block of neighbours; samples are sorted by block
  };
  // Shifts along u and v, growths along u and v, gain, offset.
  using Parameters = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  struct Normal;
  struct State {
    Eigen::Vector2d anchor;  // position of the anchor [px]
    Eigen::Vector2d size_px;
    double gain = 1.0;    // grey levels of this image over those of the first
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
  // The centre, in sizes of the box, of the samples that determine the position.
  Eigen::Vector2d anchor_ = Eigen::Vector2d::Zero();
};

}  // namespace ols::tracker
