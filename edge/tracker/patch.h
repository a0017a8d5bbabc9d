// Samples normalised 24x24 patches, and makes a template from one.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "edge/tracker/particle.h"

namespace ols::tracker {

inline constexpr int kPatchSide = 24;
inline constexpr int kPatchArea = kPatchSide * kPatchSide;
using Patch = std::array<float, kPatchArea>;             // grey values 0..255
using MaskPatch = std::array<std::uint8_t, kPatchArea>;  // foreground; 255 is certain

// A part of a frame. It is reduced if the target is much larger than a patch, so that patches are
// sampled without aliasing. Positions are in full-frame pixels.
struct FrameView {
  cv::Mat image;  // 8-bit, one channel
  cv::Point origin{0, 0};
  int reduction = 1;

  double x_of(double x_px) const { return (x_px - origin.x + 0.5) / reduction - 0.5; }
  double y_of(double y_px) const { return (y_px - origin.y + 0.5) / reduction - 0.5; }
};

// The reduction factor for a target of this size.
int reduction_for(const Eigen::Vector2d& size_px);
// The part of `frame` inside `area`. With a reduction of 1, the result is the whole frame, and
// shares the frame's memory.
FrameView make_view(const cv::Mat& frame, const cv::Rect& area, int reduction);

// The part of the view inside `area` of the full frame, smoothed with a sigma of one pixel of a
// patch, for a target of this size. Small changes of the target's shape, or an offset of half a
// pixel, then have little effect.
FrameView smoothed(const FrameView& view, const cv::Rect& area, const Eigen::Vector2d& size_px);

// The interpolated grey value, in image coordinates; outside the image, its outermost pixels are
// repeated.
float bilinear(const cv::Mat& image, double x, double y);

// I in eq. (5): the box resampled to 24x24. The interpolation is bilinear.
Patch sample_patch(const FrameView& view, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);
// A box of a foreground mask, resampled to 24x24 by nearest neighbour. Outside the mask there is no
// foreground.
MaskPatch sample_mask(const FrameView& mask, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px);

// The target's appearance, made once at the start.
struct Template {
  Patch gray{};
  float contrast = 1.0F;  // [grey levels] of the target relative to its surroundings
  float noise = 1.0F;     // [grey levels] standard deviation of the surroundings
  bool empty = false;     // it contains only noise, so it resembles any patch of sky
};

// Standard deviation of the noise [grey levels], from a 3x3 filter whose response to any plane is
// zero. The median over the image is used, so that edges do not count.
double pixel_noise(const cv::Mat& image);

// The median grey level around a box.
float level_around(const FrameView& view, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);

Template make_template(const FrameView& view, const Eigen::Vector2d& pixel,
                       const Eigen::Vector2d& size_px);

}  // namespace ols::tracker
