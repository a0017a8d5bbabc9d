// Sums the last images along the straight path of a point. Unlike a shift and stack, it does not
// round places to whole bins.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "edge/detector/residual_past.h"

namespace ols::detector {

class LineSum {
 public:
  // `near_by`: a pixel of the newest image, close to all paths that will be summed. The scene's
  // motion and the noise are taken at this pixel. `past` must be complete, and must outlive this
  // object.
  LineSum(const ResidualPast& past, const Eigen::Vector2d& near_by);

  // The sum over the newest `images` images, divided by the standard deviation that it would have
  // in white noise. The point is at `pixel` in the newest image, and moves by `velocity_px` per
  // image relative to the scene. Each image contributes at most four of its own standard
  // deviations; places outside an image contribute 0.
  double along(const Eigen::Vector2d& pixel, const Eigen::Vector2d& velocity_px,
               std::size_t images) const;
  // Like along(), but first subtracts the scene at each place: the mean of the images in which the
  // point is elsewhere. Takes ten times as long.
  double along_without_scene(const Eigen::Vector2d& pixel, const Eigen::Vector2d& velocity_px,
                             std::size_t images) const;
  // Like along_without_scene(), but for a texture that moves along with the point, such as a
  // cloud's. In such a texture, the sums along parallel paths nearby vary more than in white noise.
  // If these sums show this, the result is divided by their root mean square.
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
