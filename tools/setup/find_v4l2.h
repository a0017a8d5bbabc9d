// Finds the cameras that Linux drives (Video4Linux2), with the sizes and rates of their pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edge/camera/v4l2/v4l2_config.h"
#include "tools/setup/finders.h"

namespace ols::setup {

// Pictures that a camera offers.
struct V4l2Mode {
  camera::V4l2Format format = camera::V4l2Format::kRaw;
  int width_px = 0, height_px = 0;
  double frame_rate_hz = 0.0;
};

// The largest pictures that a station can process in time: at most 1920 x 1080, at 15 Hz or more
// if there are such, at most 30 Hz. Of the same size, raw ones. nullopt: there are none. Pure.
std::optional<V4l2Mode> best_mode(const std::vector<V4l2Mode>& modes);

// The video devices, by stable names where there are any (/dev/v4l/by-id/*), otherwise /dev/video*.
std::vector<std::string> v4l2_devices();

// Those of the devices that are cameras with pictures that a station can use.
std::vector<Found> find_v4l2(const std::vector<std::string>& devices);

}  // namespace ols::setup
