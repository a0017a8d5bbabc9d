#include "edge/camera/camera_config.h"

namespace ols::camera {

bool is_timed(TriggerMode trigger) {
  return trigger == TriggerMode::kFixedRate || trigger == TriggerMode::kFreeRun;
}

std::vector<config::Row> picture_rows(CameraConfig& c) {
  // GigE Vision has 32 bits for a size; no sensor in use comes near 16384.
  return {
      config::integer("width_px", c.width_px, 16, 16384, "px", "Width of the image."),
      config::integer("height_px", c.height_px, 16, 16384, "px", "Height of the image."),
      config::choice("pixel_format", c.pixel_format,
                     {"Mono8", "BayerRG8", "BayerGR8", "BayerGB8", "BayerBG8", "RGB8", "BGR8"},
                     "Pixel format, by its GenICam name."),
      config::number("frame_rate_hz", c.frame_rate_hz, {0.1, 1000.0}, "Hz",
                     "Frame rate; with a trigger, the maximum to expect."),
  };
}

}  // namespace ols::camera
