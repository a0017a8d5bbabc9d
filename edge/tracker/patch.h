// Sampling of normalised 24x24 patches, and the template made of one.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "edge/tracker/particle.h"

namespace ols::tracker {

inline constexpr int kPatchSide = 24;
inline constexpr int kPatchArea = kPatchSide * kPatchSide;
using Patch = std::array<float, kPatchArea>;             // grey values 0..255
using MaskPatch = std::array<std::uint8_t, kPatchArea>;  // foreground, 255 is certain

// A part of a frame, reduced where the target is much larger than a patch, so that patches are
// sampled without aliasing. Positions asked for are pixels of the full frame.
struct FrameView {
  cv::Mat image;  // 8-bit, one channel
  cv::Point origin{0, 0};
  int reduction = 1;

  double x_of(double x_px) const { return (x_px - origin.x + 0.5) / reduction - 0.5; }
  double y_of(double y_px) const { return (y_px - origin.y + 0.5) / reduction - 0.5; }
};

// How much a target of this size is reduced.
int reduction_for(const Eigen::Vector2d& size_px);
// The part of `frame` inside `area`; shares the frame's memory where nothing is reduced.
FrameView make_view(const cv::Mat& frame, const cv::Rect& area, int reduction);

// The part of the view inside `area` of the full frame, smoothed by a pixel of the patch that a
// target of this size is sampled to: small changes of its shape, and half a pixel between the
// particles, then cost little.
FrameView smoothed(const FrameView& view, const cv::Rect& area, const Eigen::Vector2d& size_px);

// Grey value between the pixels, the border continued outside; image coordinates.
float bilinear(const cv::Mat& image, double x, double y);

// Eq. (5)'s I: the box, brought to 24x24. Bilinear.
Patch sample_patch(const FrameView& view, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);
// The same of a foreground mask. Nearest neighbour; nothing is foreground outside the mask.
MaskPatch sample_mask(const FrameView& mask, const Eigen::Vector2d& pixel,
                      const Eigen::Vector2d& size_px);

// The target's appearance, made once at initialisation.
struct Template {
  Patch gray{};
  float contrast = 1.0F;  // [grey levels] how far the target stands out of what surrounds it
  float noise = 1.0F;     // [grey levels] standard deviation of what surrounds it
  bool empty = false;     // noise and nothing else: any patch of sky is as much like it
};

// Standard deviation of the noise [grey levels], from what a plane leaves over in 3x3 pixels; the
// median, so that edges do not count.
double pixel_noise(const cv::Mat& image);

// Median grey level around a box.
float level_around(const FrameView& view, const Eigen::Vector2d& pixel,
                   const Eigen::Vector2d& size_px);

Template make_template(const FrameView& view, const Eigen::Vector2d& pixel,
                       const Eigen::Vector2d& size_px);

}  // namespace ols::tracker
