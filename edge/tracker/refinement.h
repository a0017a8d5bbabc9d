// Measures the target's sub-pixel position, by least squares between its first image and this one.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "edge/tracker/patch.h"

namespace ols::tracker {

struct RefinedPosition {
  // Centre of the box that matches the first image.
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d size_px = Eigen::Vector2d::Ones();
  // Covariance of (centre, size), as far as image noise causes it.
  Eigen::Matrix4d covariance_px2 = Eigen::Matrix4d::Identity();
  double correlation = 0.0;  // -1..1
  // The residuals of neighbouring pixels may be correlated: the background moves differently, the
  // lens distorts, or the appearance has changed. The centre's variance is then greater, by this
  // factor, than with independent noise.
  double shared_noise = 1.0;

  // The position of a point of the target. `place`: the point relative to the box's centre, in
  // units of the box's width and height.
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
  // Stores the target's image: the pixels of `view` in the box and in a margin around it.
  PositionRefiner(const FrameView& view, const Eigen::Vector2d& pixel,
                  const Eigen::Vector2d& size_px);

  // Sets the template's foreground mask, M_t of eq. (5). From now on, pixels that are not
  // foreground have little weight, because they move differently.
  void set_mask(const MaskPatch& mask);

  // Fits the stored image to `view`. `start`: the approximate centre; its error may be up to about
  // a third of the target's size. Without `likely_size_px`, the size stays at `size_px`. With it,
  // the size is estimated too, starting from `likely_size_px`. Returns nullopt if the fit does not
  // converge, if the target has too little structure, or if half of the target is outside the
  // image.
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
  // In this order: shifts along u and v, growths along u and v, gain, offset.
  using Parameters = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;
  struct Normal;
  struct State {
    Eigen::Vector2d anchor;  // position of the anchor [px]
    Eigen::Vector2d size_px;
    double gain = 1.0;    // contrast of this image divided by that of the first
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
  // The weighted mean position of the samples, in units of the box's width and height. The weights
  // are the samples' contributions to the measured position.
  Eigen::Vector2d anchor_ = Eigen::Vector2d::Zero();
};

}  // namespace ols::tracker
