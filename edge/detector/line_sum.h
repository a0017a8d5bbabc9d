// Sums the past images along the straight path of a point, without the rounding of a shift and
// stack.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "edge/detector/residual_past.h"

namespace ols::detector {

class LineSum {
 public:
  // `near_by`: a pixel of the newest image, close to all places that will be asked for. The scene's
  // motion and the noise are those at this pixel. `past` must be complete, and outlive this object.
  LineSum(const ResidualPast& past, const Eigen::Vector2d& near_by);

  // The sum over the `images` newest images, in standard deviations of that sum in white noise. In
  // the newest image the point is at `pixel`; it moves by `velocity_px` per image relative to the
  // scene. One image counts at most four standard deviations. 0 outside the image.
  double along(const Eigen::Vector2d& pixel, const Eigen::Vector2d& velocity_px,
               std::size_t images) const;
  // The same, without what is at those places before and after the point has passed. Takes ten
  // times as long.
  double along_without_scene(const Eigen::Vector2d& pixel, const Eigen::Vector2d& velocity_px,
                             std::size_t images) const;
  // The same in standard deviations of such sums along parallel paths around it, if these differ
  // more than in white noise: texture, of a cloud for instance, that moves along with the point.
  double along_without_texture(const Eigen::Vector2d& pixel, const Eigen::Vector2d& velocity_px,
                               std::size_t images) const;

 private:
  std::optional<double> value(std::size_t age, const Eigen::Vector2d& pixel) const;
  std::optional<double> scene(std::size_t age, const Eigen::Vector2d& pixel) const;

  const ResidualPast* past_;
  std::array<Eigen::Vector2d, ResidualPast::kImages> shifts_px_;
  double noise_;  // [units of the residual]
};

}  // namespace ols::detector
