// Prepares a tile of the last images for a shift and stack. Refuses the tile if its noise is not a
// camera's noise.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "edge/detector/residual_past.h"
#include "edge/detector/velocity_stack.h"

namespace ols::detector {

class StackTile {
 public:
  static constexpr int kScale = 28;  // values per standard deviation of the noise

  // Aligns eight images at the tile's centre, subtracts their median from each of them, divides by
  // the noise, and puts the result into `stack`. `corner`: the tile's top-left corner [bins].
  // Returns false if the false alarm rate of a stack would be unknown there, for one of these
  // reasons:
  // - the noise is lost in the rounding to whole grey levels;
  // - the median varies from bin to bin as much as the noise: a texture, or an encoder's frozen
  //   noise;
  // - large deviations are more frequent than in normal noise: something large moves there.
  bool prepare(const ResidualPast& past, const cv::Point& corner, VelocityStack& stack);

 private:
  using Plane = std::array<std::int16_t, VelocityStack::kStride * VelocityStack::kRows>;
  void load(const ResidualPast& past, const cv::Point& corner);
  void find_median();
  // [units of the residual] Standard deviation of the noise; 0 if it is not a camera's noise.
  double noise() const;

  std::array<Plane, VelocityStack::kImages> images_{};
  Plane median_{};
};

}  // namespace ols::detector
